#include "keenline/detect/gumhold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"
#include "support/motion.h"
#include "support/shapes.h"

namespace keenline {
namespace {

using test::expect_error;
using test::shape;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

FeatureLabels labels_of(const PointCloud& cloud, const GumholdOptions& options = {}) {
  return detect_gumhold(cloud, NeighborSearch(cloud.positions), options);
}

std::size_t count(const FeatureLabels& labels, Kind kind) {
  return static_cast<std::size_t>(std::count(labels.kind.begin(), labels.kind.end(), kind));
}

std::size_t features(const FeatureLabels& labels) {
  return static_cast<std::size_t>(std::count_if(labels.kind.begin(), labels.kind.end(), is_feature));
}

/// How far a point of the unit cube about the origin is from each pair of faces, nearest first.
std::array<double, 3> depths_in_cube(const Point& p) {
  std::array<double, 3> depths{};
  for (std::size_t axis = 0; axis < 3; ++axis) depths[axis] = 0.5 - std::abs(p[axis]);
  std::sort(depths.begin(), depths.end());
  return depths;
}

TEST(Gumhold, CubeIsTwelveLinesAndEightJunctions) {
  GumholdOptions options;
  for (const double noise_h : {0.0, 0.05}) {
    options.crease_limit = noise_h > 0 ? 1.3 : 1.4;  // what the registry makes of the noise
    const PointCloud cloud = shape("cube", 12000, noise_h);
    const double h = std::sqrt(6.0 / 12000);
    const FeatureLabels labels = labels_of(cloud, options);
    std::array<bool, 8> has_junction{};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Point& p = cloud.positions[i];
      const auto depths = depths_in_cube(p);
      EXPECT_FALSE(is_feature(labels.kind[i]) && std::hypot(depths[0], depths[1]) > 2.5 * h);
      if (labels.kind[i] != Kind::Corner) continue;
      EXPECT_LT(depths[2], 4 * h) << "a junction away from the corners";
      has_junction[(p[0] > 0 ? 1U : 0U) + (p[1] > 0 ? 2U : 0U) + (p[2] > 0 ? 4U : 0U)] = true;
    }
    EXPECT_EQ(std::count(has_junction.begin(), has_junction.end(), true), 8);
    // One point thin: an edge is 45 spacings long, and points that are next to each other about one apart.
    EXPECT_GT(features(labels), 500U);
    EXPECT_LT(features(labels), 850U);
  }
}

TEST(Gumhold, CylinderIsTwoLoops) {
  const FeatureLabels labels = labels_of(shape("cylinder", 12000));
  EXPECT_EQ(count(labels, Kind::Corner), 0U);
  EXPECT_GT(count(labels, Kind::Edge), 300U);
}

TEST(Gumhold, NothingIsSharpOnSmoothSurfaces) {
  for (const char* const name : {"sphere", "torus", "plane"})
    EXPECT_EQ(features(labels_of(shape(name, 12000))), 0U) << name;
}

TEST(Gumhold, ObtuseEdgesNeedAHigherLimit) {
  const PointCloud cloud = shape("icosahedron", 12000);
  GumholdOptions options;
  options.crease_limit = 1;
  const std::size_t few = features(labels_of(cloud, options));
  options.crease_limit = 1.4;
  EXPECT_GT(features(labels_of(cloud, options)), 3 * few);
}

TEST(Gumhold, BorderIsALoop) {
  const PointCloud cloud = shape("plane", 10000);
  const FeatureLabels labels = labels_of(cloud);
  Extent extent;
  for (const Point& p : cloud.positions) extent.include(p);
  std::array<std::size_t, 4> at_side{};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (labels.kind[i] != Kind::Border) continue;
    const Point& p = cloud.positions[i];
    const std::array<double, 4> depths{p[0] - extent.low[0], extent.high[0] - p[0], p[1] - extent.low[1],
                                       extent.high[1] - p[1]};
    const auto nearest = std::min_element(depths.begin(), depths.end());
    EXPECT_LT(*nearest, 0.03);
    ++at_side[static_cast<std::size_t>(nearest - depths.begin())];
  }
  for (const std::size_t points : at_side) EXPECT_GT(points, 60U);
  GumholdOptions options;
  options.border_gap_deg = 360;
  EXPECT_EQ(count(labels_of(cloud, options), Kind::Border), 0U);
}

TEST(Gumhold, ScoreIsLargerTheSharperTheEdge) {
  const auto median_on_edge = [](double angle_deg) {
    SynthOptions synth;
    synth.shape = "crease";
    synth.points = 8000;
    synth.angle_deg = angle_deg;
    const PointCloud cloud = synthesize(synth).cloud;
    const FeatureLabels labels = labels_of(cloud);
    std::vector<float> scores;
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (labels.kind[i] == Kind::Edge) scores.push_back(labels.score[i]);
    EXPECT_GT(scores.size(), 40U) << angle_deg;
    std::sort(scores.begin(), scores.end());
    return scores.empty() ? 0 : scores[scores.size() / 2];
  };
  const float at_90 = median_on_edge(90);
  const float at_120 = median_on_edge(120);
  EXPECT_GT(at_90, at_120);
  EXPECT_GT(at_120, median_on_edge(140));
}

/// The paper's penalties on this: a curvature share of 0.2 leaves creases out of reach of what noise is.
TEST(Gumhold, PlainTakesFlatSurfacesForFeatures) {
  GumholdOptions options;
  options.plain = true;
  options.crease_limit = 1.7;
  EXPECT_GT(features(labels_of(shape("sphere", 3000), options)), 300U);
}

TEST(Gumhold, DoesNotDependOnScalePlaceOrDirection) {
  const PointCloud cloud = shape("fandisk", 6000);
  const FeatureLabels labels = labels_of(cloud);
  for (const PointCloud& other :
       {test::moved(cloud, 1e-3, {0, 0, 0}), test::moved(cloud, 1, {1e6, -3e6, 1e6})}) {
    const FeatureLabels found = labels_of(other);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (found.kind[i] != labels.kind[i]) ++different;
      EXPECT_NEAR(found.score[i], labels.score[i], 1e-4F);
    }
    EXPECT_LE(different, 12U);  // coordinates are rounded, and which of two equal ways is taken is chance
  }
  PointCloud huge = cloud;
  for (Point& p : huge.positions)
    for (double& c : p) c *= 0x1p900;
  EXPECT_EQ(labels_of(huge).kind, labels.kind);
  EXPECT_EQ(labels_of(huge).score, labels.score);
}

TEST(Gumhold, WhatCannotBeToldIsUndecided) {
  PointCloud cloud;
  EXPECT_EQ(labels_of(cloud).size(), 0U);
  cloud.positions.assign(100, {1, 2, 3});
  cloud.positions.push_back({nan, 0, 0});
  EXPECT_EQ(count(labels_of(cloud), Kind::Undecided), 101U);
  cloud = shape("cube", 16);  // one neighbour short
  EXPECT_EQ(count(labels_of(cloud), Kind::Undecided), 16U);
  cloud.positions.clear();
  for (int i = 0; i < 100; ++i) cloud.positions.push_back({0.1 * i, 0.025 * i, -0.2 * i});
  EXPECT_EQ(count(labels_of(cloud), Kind::Undecided), 0U) << "a line";
  cloud.positions.push_back({1e308, -1e308, 1e308});
  cloud.positions.push_back({1e-308, -1e-308, 1e-308});
  EXPECT_EQ(labels_of(cloud).size(), 102U);
}

TEST(Gumhold, PointsThatCoincideAreOneOfThePattern) {
  PointCloud cloud = shape("cube", 3000);
  const Point place = cloud.positions[0];
  cloud.positions.insert(cloud.positions.end(), 20000, place);
  const FeatureLabels labels = labels_of(cloud);
  for (std::size_t i = 3000; i < cloud.size(); ++i) EXPECT_EQ(labels.kind[i], labels.kind[0]);
}

TEST(Gumhold, RefusesWhatIsOutOfRange) {
  const PointCloud cloud = shape("cube", 100);
  const NeighborSearch search(cloud.positions);
  const auto refuses = [&](const auto& change, std::string_view name) {
    GumholdOptions options;
    change(options);
    expect_error<InvalidArgument>([&] { (void)detect_gumhold(cloud, search, options); }, name);
  };
  refuses([](GumholdOptions& o) { o.neighbors = 2; }, "neighbors");
  refuses([](GumholdOptions& o) { o.crease_limit = 2.1; }, "crease_limit");
  refuses([](GumholdOptions& o) { o.crease_limit = nan; }, "crease_limit");
  refuses([](GumholdOptions& o) { o.border_gap_deg = -1; }, "border_gap_deg");
  refuses([](GumholdOptions& o) { o.shortest_cycle = 0; }, "shortest_cycle");
}

}  // namespace
}  // namespace keenline
