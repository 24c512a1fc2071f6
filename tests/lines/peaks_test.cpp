#include "keenline/lines/peaks.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

#include "support/cancelled_progress.h"
#include "support/traced_shapes.h"

namespace keenline {
namespace {

using test::labelled_shape;
using test::LabelledShape;

LabelledShape cone(double noise, std::uint64_t seed, double angle_deg = 60) {
  SynthOptions options;
  options.shape = "cone";
  options.points = 3000;
  options.noise.amount = noise;
  options.seed = seed;
  options.angle_deg = angle_deg;
  LabelledShape shape = labelled_shape(options);
  shape.labels.kind.assign(shape.labels.size(), Kind::Flat);
  return shape;
}

/// Calls all points within so many spacings of a place the same.
void label_around(LabelledShape& shape, const Point& place, double reach, Kind kind) {
  for (std::size_t i = 0; i < shape.labels.size(); ++i)
    if (distance(shape.synth.cloud.positions[i], place) < reach * shape.spacing) shape.labels.kind[i] = kind;
}

void add(FeatureGraph& graph, const LabelledShape& shape) {
  const NeighborSearch search(shape.synth.cloud.positions);
  const TraceFrame frame{shape.synth.cloud.positions[0], shape.spacing};
  add_peaks(graph, shape.synth.cloud, search, shape.labels, frame);
}

FeatureGraph peaks_of(const LabelledShape& shape) {
  FeatureGraph graph;
  add(graph, shape);
  validate(graph);
  return graph;
}

TEST(Peaks, AreApexesThatNoPointLiesIn) {
  for (const double angle : {40.0, 60.0, 90.0, 120.0}) {
    LabelledShape shape = cone(0, 1, angle);
    const Point apex = shape.synth.peaks.at(0);
    label_around(shape, apex, 2.5, Kind::Peak);  // several samples of one apex
    const FeatureGraph graph = peaks_of(shape);
    ASSERT_EQ(graph.corners.size(), 1U) << angle;
    EXPECT_LT(distance(graph.corners[0].position, apex), 1e-4 * shape.spacing) << angle;
    EXPECT_LT(graph.corners[0].residual.value(), 1e-4 * shape.spacing) << angle;
  }
}

TEST(Peaks, AreFoundWhereNoiseHidesThemFromTheDetector) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    LabelledShape shape = cone(0.05, seed);
    const Point apex = shape.synth.peaks.at(0);
    label_around(shape, apex, 3, Kind::Edge);
    const FeatureGraph graph = peaks_of(shape);
    ASSERT_EQ(graph.corners.size(), 1U) << seed;
    EXPECT_LT(distance(graph.corners[0].position, apex), 0.2 * shape.spacing) << seed;
    EXPECT_NEAR(graph.corners[0].residual.value(), 0.05 * shape.spacing, 0.015 * shape.spacing) << seed;
  }
}

TEST(Peaks, OnlyWhereTheSurfaceHasATip) {
  for (const char* const name : {"plane", "sphere", "cylinder", "torus", "vase"}) {
    LabelledShape shape = labelled_shape(name, 2000, 0.05);
    for (std::size_t i = 0; i < shape.labels.size(); ++i)
      shape.labels.kind[i] = i % 20 == 0 ? Kind::Edge : Kind::Flat;
    EXPECT_TRUE(peaks_of(shape).corners.empty()) << name;
  }
  LabelledShape blunt = cone(0, 1);
  const Point apex = blunt.synth.peaks.at(0);
  label_around(blunt, apex, 6, Kind::Edge);
  std::vector<Point>& positions = blunt.synth.cloud.positions;
  for (std::size_t i = positions.size(); i-- > 0;) {
    if (distance(positions[i], apex) > 4 * blunt.spacing) continue;
    const auto place = static_cast<std::ptrdiff_t>(i);
    positions.erase(positions.begin() + place);
    blunt.labels.kind.erase(blunt.labels.kind.begin() + place);
    blunt.labels.score.erase(blunt.labels.score.begin() + place);
  }
  EXPECT_TRUE(peaks_of(blunt).corners.empty());
}

TEST(Peaks, StayWhereTheyWereLabelledIfNoConeFits) {
  LabelledShape shape = labelled_shape("plane", 1000);
  shape.labels.kind.assign(1000, Kind::Flat);
  shape.labels.kind[123] = Kind::Peak;
  const FeatureGraph graph = peaks_of(shape);
  ASSERT_EQ(graph.corners.size(), 1U);
  EXPECT_EQ(graph.corners[0].position, shape.synth.cloud.positions[123]);
  EXPECT_FALSE(graph.corners[0].residual.has_value());
}

TEST(Peaks, NotWhereALineIsNear) {
  LabelledShape shape = cone(0, 1);
  const Point apex = shape.synth.peaks.at(0);
  label_around(shape, apex, 5, Kind::Edge);
  FeatureGraph graph;
  graph.polylines.push_back({.vertices = {apex, sum(apex, {0, 0, 40 * shape.spacing})}});
  add(graph, shape);
  EXPECT_TRUE(graph.corners.empty());
}

TEST(Peaks, OfLikePlacesTheSharpest) {
  LabelledShape shape = labelled_shape("plane", 4000);
  shape.labels.kind.assign(4000, Kind::Flat);
  label_around(shape, shape.synth.cloud.positions[7], 2, Kind::Peak);
  shape.labels.score[7] = 2;
  const FeatureGraph graph = peaks_of(shape);
  ASSERT_EQ(graph.corners.size(), 1U);
  EXPECT_EQ(graph.corners[0].position, shape.synth.cloud.positions[7]);
}

TEST(Peaks, DoNotDependOnPlaceAndScale) {
  LabelledShape shape = cone(0.05, 2);
  label_around(shape, shape.synth.peaks.at(0), 2, Kind::Corner);
  const FeatureGraph graph = peaks_of(shape);
  const auto moved = [](const Point& p) { return Point{5e5 + p[0] / 1024, 4e6 - p[1] / 1024, p[2] / 1024}; };
  for (Point& p : shape.synth.cloud.positions) p = moved(p);
  shape.spacing /= 1024;
  const FeatureGraph far = peaks_of(shape);
  ASSERT_EQ(graph.corners.size(), 1U);
  ASSERT_EQ(far.corners.size(), 1U);
  EXPECT_LT(distance(far.corners[0].position, moved(graph.corners[0].position)), 0.001 * shape.spacing);
}

TEST(Peaks, OfDegenerateCloudsAreAnAnswer) {
  LabelledShape shape;
  shape.spacing = 1;
  const double huge = std::numeric_limits<double>::max();
  for (int i = 0; i < 200; ++i) {
    shape.synth.cloud.positions.push_back(i < 100 ? Point{1, 2, 3} : Point{huge, -huge, 1.0 * i});
    shape.labels.kind.push_back(i % 2 == 0 ? Kind::Edge : Kind::Corner);
  }
  EXPECT_TRUE(peaks_of(shape).corners.empty());
  for (std::size_t i = 0; i < 200; ++i) shape.synth.cloud.positions[i] = {static_cast<double>(i), 0, 0};
  EXPECT_TRUE(peaks_of(shape).corners.empty());
}

TEST(Peaks, CanBeCancelled) {
  LabelledShape shape = cone(0, 1);
  label_around(shape, shape.synth.peaks.at(0), 2, Kind::Peak);
  const NeighborSearch search(shape.synth.cloud.positions);
  FeatureGraph graph;
  const test::CancelledProgress cancelled;
  EXPECT_THROW(
      add_peaks(graph, shape.synth.cloud, search, shape.labels, {{0, 0, 0}, shape.spacing}, cancelled),
      Cancelled);
}

}  // namespace
}  // namespace keenline
