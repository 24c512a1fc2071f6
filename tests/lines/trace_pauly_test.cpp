#include "keenline/lines/trace_pauly.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

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

TEST(TracePauly, CubeIsTwelveLinesBetweenEightCorners) {
  const SynthCloud cube = shape("cube", 12000);
  const FeatureGraph graph = traced(cube.cloud);
  EXPECT_EQ(graph.corners.size(), 8U);
  EXPECT_EQ(graph.polylines.size(), 12U);
  EXPECT_EQ(counts_of(graph).loose_ends, 0U);
  EXPECT_NEAR(counts_of(graph).length, 12, 0.3);
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
  EXPECT_NEAR(counts_of(graph).length / 2, 6.4, 0.2);  // 2 pi = 6.28
}

TEST(TracePauly, SnakesAreShorterThanThePattern) {
  const PointCloud cloud = shape("cube", 8000).cloud;
  TracePaulyOptions options;
  options.snake.duration = 0;
  EXPECT_GT(counts_of(traced(cloud, options)).length, 1.05 * counts_of(traced(cloud)).length);
}

TEST(TracePauly, RimsAreBorders) {
  const FeatureGraph graph = traced(shape("plane", 10000).cloud);
  ASSERT_FALSE(graph.polylines.empty());
  for (const Polyline& line : graph.polylines) EXPECT_EQ(line.kind, LineKind::Border);
  EXPECT_NEAR(counts_of(graph).length, 4, 0.7);
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

}  // namespace
}  // namespace keenline
