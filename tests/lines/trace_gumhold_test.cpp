#include "keenline/lines/trace_gumhold.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/detect/gumhold.h"
#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"

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
FeatureGraph traced(const PointCloud& cloud, double crease_limit = 1.4,
                    const TraceGumholdOptions& options = {}) {
  const NeighborSearch search(cloud.positions);
  GumholdOptions detection;
  detection.crease_limit = crease_limit;
  const FeatureLabels labels = detect_gumhold(cloud, search, detection);
  const double spacing = estimate_spacing(cloud, search);
  FeatureGraph graph = trace_gumhold(cloud, search, labels, spacing, options);
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

TEST(TraceGumhold, CubeIsTwelveLinesBetweenEightCorners) {
  for (const double noise_h : {0.0, 0.05}) {
    const SynthCloud cube = shape("cube", 12000, noise_h);
    const FeatureGraph graph = traced(cube.cloud, noise_h > 0 ? 1.3 : 1.4);
    EXPECT_EQ(graph.corners.size(), 8U);
    EXPECT_EQ(graph.polylines.size(), 12U);
    EXPECT_EQ(loose_ends(graph), 0U);
    EXPECT_NEAR(length_of_all(graph), 13.9, 0.3);  // vertices are points beside the edges
  }
}

TEST(TraceGumhold, CylinderIsTwoLoops) {
  const FeatureGraph graph = traced(shape("cylinder", 12000).cloud);
  ASSERT_EQ(graph.polylines.size(), 2U);
  EXPECT_TRUE(graph.polylines[0].closed);
  EXPECT_TRUE(graph.polylines[1].closed);
  EXPECT_TRUE(graph.corners.empty());
  EXPECT_NEAR(length_of_all(graph) / 2, 7.3, 0.2);  // 2 pi = 6.28
}

TEST(TraceGumhold, VerticesArePointsOfTheCloud) {
  const PointCloud cloud = shape("cylinder", 6000).cloud;
  const NeighborSearch search(cloud.positions);
  const FeatureGraph graph = traced(cloud);
  ASSERT_FALSE(graph.polylines.empty());
  for (const Polyline& line : graph.polylines) {
    EXPECT_GE(line.support, line.vertices.size());
    for (const Point& vertex : line.vertices) {
      const Point& nearest = cloud.positions[search.nearest_to(vertex, 1)[0]];
      EXPECT_NEAR(vertex[0], nearest[0], 1e-12);
      EXPECT_NEAR(vertex[1], nearest[1], 1e-12);
    }
  }
}

TEST(TraceGumhold, SmoothSurfacesHaveNoLines) {
  for (const char* const name : {"sphere", "torus"}) {
    const FeatureGraph graph = traced(shape(name, 12000).cloud);
    EXPECT_TRUE(graph.polylines.empty()) << name;
    EXPECT_TRUE(graph.corners.empty()) << name;
  }
}

TEST(TraceGumhold, RimsAreBorders) {
  const FeatureGraph graph = traced(shape("plane", 10000).cloud);
  ASSERT_FALSE(graph.polylines.empty());
  for (const Polyline& line : graph.polylines) EXPECT_EQ(line.kind, LineKind::Border);
  EXPECT_NEAR(length_of_all(graph), 4, 0.7);
}

TEST(TraceGumhold, MovesWithTheCloud) {
  const PointCloud cloud = shape("cube", 6000).cloud;
  const FeatureGraph here = traced(cloud);
  const Point shift{1e6, -2e6, 3e6};
  const FeatureGraph there = traced(test::moved(cloud, 100, shift));
  EXPECT_EQ(here.corners.size(), there.corners.size());
  EXPECT_NEAR(length_of_all(there) / length_of_all(here), 100, 1);
}

TEST(TraceGumhold, IsTheSameForAnyNumberOfThreads) {
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

TEST(TraceGumhold, NothingToTraceIsAnEmptyGraph) {
  PointCloud cloud;
  const auto is_empty = [&](Kind kind, double spacing) {
    FeatureLabels labels;
    labels.kind.assign(cloud.size(), kind);
    labels.score.assign(cloud.size(), 0);
    const NeighborSearch search(cloud.positions);
    const FeatureGraph graph = trace_gumhold(cloud, search, labels, spacing);
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

TEST(TraceGumhold, RefusesWhatIsOutOfRange) {
  const PointCloud cloud = shape("cube", 100).cloud;
  const NeighborSearch search(cloud.positions);
  FeatureLabels labels;
  labels.kind.assign(100, Kind::Edge);
  TraceGumholdOptions options;
  options.shortest_cycle = 0;
  test::expect_error<InvalidArgument>([&] { (void)trace_gumhold(cloud, search, labels, 0.1, options); },
                                      "shortest_cycle");
  options = {};
  options.neighbors = 2;
  EXPECT_THROW((void)trace_gumhold(cloud, search, labels, 0.1, options), InvalidArgument);
  labels.kind.pop_back();
  EXPECT_THROW((void)trace_gumhold(cloud, search, labels, 0.1), InvalidArgument);
}

class Stopped : public Progress {
 public:
  [[nodiscard]] bool cancelled() const override { return true; }
};

TEST(TraceGumhold, CanBeCancelled) {
  const PointCloud cloud = shape("cube", 1000).cloud;
  const NeighborSearch search(cloud.positions);
  FeatureLabels labels;
  labels.kind.assign(1000, Kind::Edge);
  labels.score.assign(1000, 1);
  Stopped progress;
  EXPECT_THROW((void)trace_gumhold(cloud, search, labels, 0.1, {}, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
