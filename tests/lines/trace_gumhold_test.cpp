#include "keenline/lines/trace_gumhold.h"

#include <cmath>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/detect/gumhold.h"
#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"

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

TEST(TraceGumhold, CubeIsTwelveLinesBetweenEightCorners) {
  for (const double noise_h : {0.0, 0.05}) {
    const SynthCloud cube = shape("cube", 12000, noise_h);
    const FeatureGraph graph = traced(cube.cloud, noise_h > 0 ? 1.3 : 1.4);
    EXPECT_EQ(graph.corners.size(), 8U);
    EXPECT_EQ(graph.polylines.size(), 12U);
    EXPECT_EQ(counts_of(graph).loose_ends, 0U);
    EXPECT_NEAR(counts_of(graph).length, 13.9, 0.3);  // vertices are points beside the edges
  }
}

TEST(TraceGumhold, CylinderIsTwoLoops) {
  const FeatureGraph graph = traced(shape("cylinder", 12000).cloud);
  ASSERT_EQ(graph.polylines.size(), 2U);
  EXPECT_TRUE(graph.polylines[0].closed);
  EXPECT_TRUE(graph.polylines[1].closed);
  EXPECT_TRUE(graph.corners.empty());
  EXPECT_NEAR(counts_of(graph).length / 2, 7.3, 0.2);  // 2 pi = 6.28
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

TEST(TraceGumhold, RimsAreBorders) {
  const FeatureGraph graph = traced(shape("plane", 10000).cloud);
  ASSERT_FALSE(graph.polylines.empty());
  for (const Polyline& line : graph.polylines) EXPECT_EQ(line.kind, LineKind::Border);
  EXPECT_NEAR(counts_of(graph).length, 4, 0.7);
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

}  // namespace
}  // namespace keenline
