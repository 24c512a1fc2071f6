#include "keenline/lines/trace.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "keenline/detect/gauss.h"
#include "keenline/evaluate/compare_graphs.h"
#include "keenline/synth/true_lines.h"
#include "keenline/vectors.h"

#include "support/traced_shapes.h"

namespace keenline {
namespace {

using test::labelled_shape;
using test::LabelledShape;

FeatureGraph traced(const LabelledShape& shape) {
  const NeighborSearch search(shape.synth.cloud.positions);
  FeatureGraph graph = trace_lines(shape.synth.cloud, search, shape.labels, shape.spacing);
  validate(graph);
  return graph;
}

GraphComparison compare(const FeatureGraph& graph, const LabelledShape& shape) {
  return compare_graphs(graph, true_lines(shape.synth), {shape.spacing});
}

TEST(TraceLines, ACubeAsTheDefaultMethodSeesIt) {
  LabelledShape shape = labelled_shape("cube", 6000, 0.05);
  shape.labels = detect_gauss(shape.synth.cloud, find_neighborhoods(shape.synth.cloud, 18));
  const GraphComparison found = compare(traced(shape), shape);
  EXPECT_EQ(found.found.corners, 8U);
  EXPECT_EQ(found.missed_corners, 0U);
  EXPECT_EQ(found.found.polylines, 12U);
  EXPECT_EQ(found.found.loose_ends, 0U);
  EXPECT_NEAR(found.length_ratio, 1, 0.01);
  EXPECT_LT(found.found_to_truth.mean, 0.1 * shape.spacing);
  EXPECT_LT(found.corners.largest, 0.3 * shape.spacing);
}

void expect_true_graph(const GraphComparison& found, const char* name) {
  EXPECT_EQ(found.found.corners, found.truth.corners) << name;
  EXPECT_EQ(found.found.polylines, found.truth.polylines) << name;
  EXPECT_EQ(found.found.loops, found.truth.loops) << name;
  EXPECT_EQ(found.found.loose_ends, 0U) << name;
}

TEST(TraceLines, TheRightGraphFromPerfectLabels) {
  for (const char* const name : {"box", "cylinder", "through-hole", "icosahedron"}) {
    const LabelledShape shape = labelled_shape(name, 6000, 0.02);
    const GraphComparison found = compare(traced(shape), shape);
    expect_true_graph(found, name);
    EXPECT_NEAR(found.length_ratio, 1, 0.01) << name;
    EXPECT_LT(found.found_to_truth.mean, 0.2 * shape.spacing) << name;
  }
}

TEST(TraceLines, TheRightGraphInNoise) {
  struct Case {
    const char* name;
    double noise;
  };
  for (const auto& [name, noise] : {Case{"icosahedron", 0.1}, Case{"box", 0.2}, Case{"cylinder", 0.2}}) {
    const LabelledShape shape = labelled_shape(name, 6000, noise);
    const GraphComparison found = compare(traced(shape), shape);
    expect_true_graph(found, name);
    EXPECT_NEAR(found.length_ratio, 1, 0.03) << name;
  }
}

TEST(TraceLines, NothingOnSmoothShapesEvenWhereTheDetectorErrs) {
  for (const double noise : {0.05, 0.1, 0.2}) {
    for (const char* const name : {"sphere", "torus"}) {
      LabelledShape shape = labelled_shape(name, 5000, noise);
      for (std::size_t i = 0; i < shape.labels.size(); i += 50) shape.labels.kind[i] = Kind::Edge;
      EXPECT_TRUE(traced(shape).polylines.empty()) << name << noise;
    }
  }
}

Point moved_point(const Point& p) { return {5e5 + p[0] / 1024, 4e6 - p[1] / 1024, p[2] / 1024}; }

TEST(TraceLines, DoesNotDependOnPlaceAndScale) {
  LabelledShape shape = labelled_shape("cube", 3000);
  const FeatureGraph graph = traced(shape);
  for (Point& p : shape.synth.cloud.positions) p = moved_point(p);
  shape.spacing /= 1024;
  const FeatureGraph moved = traced(shape);
  ASSERT_EQ(moved.polylines.size(), graph.polylines.size());
  ASSERT_EQ(moved.corners.size(), graph.corners.size());
  for (std::size_t i = 0; i < graph.corners.size(); ++i) {
    const Point& p = graph.corners[i].position;
    EXPECT_LT(distance(moved.corners[i].position, moved_point(p)), 1e-6);
  }
}

TEST(TraceLines, ALabelledStrayFarOutCostsTheOthersNoDigits) {
  LabelledShape shape = labelled_shape("cube", 3000);
  const FeatureGraph graph = traced(shape);
  // The first of the candidates, and the farthest.
  std::vector<Point>& positions = shape.synth.cloud.positions;
  positions.insert(positions.begin(), {1e20, -1e20, 1e20});
  shape.labels.kind.insert(shape.labels.kind.begin(), Kind::Edge);
  shape.labels.score.insert(shape.labels.score.begin(), 1.0F);
  const NeighborSearch search(positions);
  PointCloud cloud;
  cloud.positions = positions;
  const FeatureGraph with_stray = trace_lines(cloud, search, shape.labels, shape.spacing);
  ASSERT_EQ(with_stray.polylines.size(), graph.polylines.size());
  ASSERT_EQ(with_stray.corners.size(), graph.corners.size());
  for (std::size_t i = 0; i < graph.corners.size(); ++i)
    EXPECT_LT(distance(with_stray.corners[i].position, graph.corners[i].position), 1e-9 * shape.spacing);
}

TEST(TraceLines, DegenerateCloudsHaveNoLines) {
  PointCloud cloud;
  FeatureLabels labels;
  const auto lines = [&] {
    const NeighborSearch search(cloud.positions);
    return trace_lines(cloud, search, labels, 1);
  };
  EXPECT_TRUE(lines().polylines.empty());
  const double nan = std::nan("");
  for (int i = 0; i < 100; ++i) {
    cloud.positions.push_back(i % 3 == 0 ? Point{nan, 0, 0} : Point{1, 2, 3});
    labels.kind.push_back(i % 2 == 0 ? Kind::Edge : Kind::Border);
    labels.score.push_back(1);
  }
  EXPECT_TRUE(lines().polylines.empty());
  for (std::size_t i = 0; i < 100; ++i) cloud.positions[i] = {static_cast<double>(i), 0, 0};
  const FeatureGraph graph = lines();  // borders on a line: no surface
  validate(graph);
}

}  // namespace
}  // namespace keenline
