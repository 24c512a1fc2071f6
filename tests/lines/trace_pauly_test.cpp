#include "keenline/lines/trace_pauly.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/detect/pauly.h"
#include "keenline/errors.h"
#include "keenline/evaluate/compare_graphs.h"
#include "keenline/feature_graph.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"
#include "keenline/synth/true_lines.h"

#include "support/expect_error.h"
#include "support/motion.h"

namespace keenline {
namespace {

SynthCloud shape(const std::string& name, std::uint64_t points, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

/// The method from its own labels to its own lines.
FeatureGraph traced(const PointCloud& cloud, const TracePaulyOptions& options = {}) {
  const NeighborSearch search(cloud.positions);
  const FeatureLabels labels = detect_pauly(cloud, search);
  const double spacing = estimate_spacing(cloud, search);
  FeatureGraph graph = trace_pauly(cloud, search, labels, spacing, options);
  validate(graph);
  return graph;
}

double length_of_all(const FeatureGraph& graph) {
  double length = 0;
  for (const Polyline& line : graph.polylines) length += length_of(line);
  return length;
}

std::size_t loose_ends(const FeatureGraph& graph) {
  std::size_t ends = 0;
  for (const Polyline& line : graph.polylines)
    if (!line.closed) ends += (line.start_corner ? 0U : 1U) + (line.end_corner ? 0U : 1U);
  return ends;
}

TEST(TracePauly, CubeIsTwelveLinesBetweenEightCorners) {
  const SynthCloud cube = shape("cube", 12000);
  const FeatureGraph graph = traced(cube.cloud);
  EXPECT_EQ(graph.corners.size(), 8U);
  EXPECT_EQ(graph.polylines.size(), 12U);
  EXPECT_EQ(loose_ends(graph), 0U);
  EXPECT_NEAR(length_of_all(graph), 12, 0.3);
  const double h = std::sqrt(6.0 / 12000);
  GraphComparisonOptions comparison;
  comparison.spacing = h;
  EXPECT_LT(compare_graphs(graph, true_lines(cube), comparison).found_to_truth.mean, 0.6 * h);
}

TEST(TracePauly, CylinderIsTwoLoops) {
  const FeatureGraph graph = traced(shape("cylinder", 12000).cloud);
  ASSERT_EQ(graph.polylines.size(), 2U);
  EXPECT_TRUE(graph.polylines[0].closed);
  EXPECT_TRUE(graph.polylines[1].closed);
  EXPECT_TRUE(graph.corners.empty());
  EXPECT_NEAR(length_of_all(graph) / 2, 6.4, 0.2);  // 2 pi = 6.28
}

TEST(TracePauly, SnakesAreShorterThanThePattern) {
  const PointCloud cloud = shape("cube", 8000).cloud;
  TracePaulyOptions options;
  options.snake.duration = 0;
  EXPECT_GT(length_of_all(traced(cloud, options)), 1.05 * length_of_all(traced(cloud)));
}

TEST(TracePauly, SmoothSurfacesHaveNoLines) {
  for (const char* const name : {"sphere", "torus"}) {
    const FeatureGraph graph = traced(shape(name, 12000).cloud);
    EXPECT_TRUE(graph.polylines.empty()) << name;
    EXPECT_TRUE(graph.corners.empty()) << name;
  }
}

TEST(TracePauly, RimsAreBorders) {
  const FeatureGraph graph = traced(shape("plane", 10000).cloud);
  ASSERT_FALSE(graph.polylines.empty());
  for (const Polyline& line : graph.polylines) EXPECT_EQ(line.kind, LineKind::Border);
  EXPECT_NEAR(length_of_all(graph), 4, 0.7);
}

TEST(TracePauly, MovesWithTheCloud) {
  const PointCloud cloud = shape("cube", 6000).cloud;
  const FeatureGraph here = traced(cloud);
  const Point shift{1e6, -2e6, 3e6};
  const FeatureGraph there = traced(test::moved(cloud, 100, shift));
  EXPECT_EQ(here.corners.size(), there.corners.size());
  EXPECT_NEAR(length_of_all(there) / length_of_all(here), 100, 1);
}

TEST(TracePauly, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = shape("fandisk", 6000, 0.05).cloud;
  const FeatureGraph graph = traced(cloud);
  EXPECT_FALSE(graph.polylines.empty());
  for (const std::size_t threads : {1U, 4U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const FeatureGraph again = traced(cloud);
    ASSERT_EQ(again.polylines.size(), graph.polylines.size());
    for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
      EXPECT_EQ(again.polylines[i].vertices, graph.polylines[i].vertices);
      EXPECT_EQ(again.polylines[i].support, graph.polylines[i].support);
    }
  }
}

TEST(TracePauly, NothingToTraceIsAnEmptyGraph) {
  PointCloud cloud;
  const auto is_empty = [&](Kind kind, double spacing) {
    FeatureLabels labels;
    labels.kind.assign(cloud.size(), kind);
    labels.score.assign(cloud.size(), 0);
    const NeighborSearch search(cloud.positions);
    const FeatureGraph graph = trace_pauly(cloud, search, labels, spacing);
    return graph.polylines.empty() && graph.corners.empty();
  };
  EXPECT_TRUE(is_empty(Kind::Edge, 1));
  cloud.positions.assign(1, {1, 2, 3});
  EXPECT_TRUE(is_empty(Kind::Edge, 1));
  cloud.positions.assign(200, {1, 2, 3});
  EXPECT_TRUE(is_empty(Kind::Edge, 1));
  EXPECT_TRUE(is_empty(Kind::Edge, 0));
  cloud.positions.push_back({std::nan(""), 0, 0});
  cloud.positions.push_back({1e300, 0, 0});
  EXPECT_TRUE(is_empty(Kind::Border, 1));
  cloud = shape("cube", 1000).cloud;
  EXPECT_TRUE(is_empty(Kind::Flat, 0.1));
}

TEST(TracePauly, RefusesWhatIsOutOfRange) {
  const PointCloud cloud = shape("cube", 100).cloud;
  const NeighborSearch search(cloud.positions);
  FeatureLabels labels;
  labels.kind.assign(100, Kind::Edge);
  TracePaulyOptions options;
  options.shortest_cycle = 0;
  test::expect_error<InvalidArgument>([&] { (void)trace_pauly(cloud, search, labels, 0.1, options); },
                                      "shortest_cycle");
  options = {};
  options.length_weight = 1.1;
  EXPECT_THROW((void)trace_pauly(cloud, search, labels, 0.1, options), InvalidArgument);
  options = {};
  options.snake.pull = -1;
  EXPECT_THROW((void)trace_pauly(cloud, search, labels, 0.1, options), InvalidArgument);
  labels.kind.pop_back();
  EXPECT_THROW((void)trace_pauly(cloud, search, labels, 0.1), InvalidArgument);
}

class Stopped : public Progress {
 public:
  [[nodiscard]] bool cancelled() const override { return true; }
};

TEST(TracePauly, CanBeCancelled) {
  const PointCloud cloud = shape("cube", 1000).cloud;
  const NeighborSearch search(cloud.positions);
  FeatureLabels labels;
  labels.kind.assign(1000, Kind::Edge);
  labels.score.assign(1000, 1);
  Stopped progress;
  EXPECT_THROW((void)trace_pauly(cloud, search, labels, 0.1, {}, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
