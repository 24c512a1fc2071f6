#include "keenline/detect/pauly.h"

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

FeatureLabels labels_of(const PointCloud& cloud, const PaulyOptions& options = {}) {
  return detect_pauly(cloud, NeighborSearch(cloud.positions), options);
}

/// Of the unit cube about the origin: how far the point is from the nearest edge.
double distance_to_cube_edge(const Point& p) {
  std::array<double, 3> to_face{};
  for (std::size_t axis = 0; axis < 3; ++axis) to_face[axis] = 0.5 - std::abs(p[axis]);
  std::sort(to_face.begin(), to_face.end());
  return std::hypot(to_face[0], to_face[1]);
}

double share(std::size_t part, std::size_t whole) {
  return static_cast<double>(part) / static_cast<double>(whole);
}

std::size_t count(const FeatureLabels& labels, Kind kind) {
  return static_cast<std::size_t>(std::count(labels.kind.begin(), labels.kind.end(), kind));
}

std::size_t features(const FeatureLabels& labels) {
  return static_cast<std::size_t>(std::count_if(labels.kind.begin(), labels.kind.end(), is_feature));
}

/// What the paper calls omega, read off the labels: a point is a feature from its own share on.
TEST(Pauly, PersistenceFallsFromEdgesToFaces) {
  const PointCloud cloud = shape("cube", 20000);
  const double h = std::sqrt(6.0 / 20000);
  PaulyOptions options;
  options.smallest_scale = options.scale_step = 10;
  options.largest_scale = 200;
  options.variation = 0.05;
  options.seed_share = options.grow_share = 0.9;
  const FeatureLabels labels = labels_of(cloud, options);
  std::array<std::size_t, 3> found{};
  std::array<std::size_t, 3> all{};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double d = distance_to_cube_edge(cloud.positions[i]) / h;
    const std::size_t zone = d < 0.5 ? 0 : d > 9 ? 2 : d > 3 && d < 6 ? 1 : 3;
    if (zone == 3) continue;
    all[zone]++;
    if (is_feature(labels.kind[i])) found[zone]++;
  }
  EXPECT_GT(share(found[0], all[0]), 0.6);
  EXPECT_LT(share(found[1], all[1]), 0.02);
  EXPECT_EQ(found[2], 0U);
}

TEST(Pauly, FindsTheEdgesOfTheCubeByItself) {
  for (const double noise_h : {0.0, 0.05}) {
    const PointCloud cloud = shape("cube", 12000, noise_h);
    const double h = std::sqrt(6.0 / 12000);
    const FeatureLabels labels = labels_of(cloud);
    std::size_t near = 0;
    std::size_t near_found = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const double d = distance_to_cube_edge(cloud.positions[i]) / h;
      EXPECT_FALSE(d > 2.5 && is_feature(labels.kind[i])) << d;
      if (d > 0.5) continue;
      ++near;
      if (is_feature(labels.kind[i])) ++near_found;
    }
    EXPECT_GT(share(near_found, near), 0.9);
  }
}

TEST(Pauly, CornersLieAtCorners) {
  std::size_t corners = 0;
  std::size_t at_corners = 0;
  const double h = std::sqrt(6.0 / 6000);
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    SynthOptions synth;
    synth.shape = "cube";
    synth.points = 6000;
    synth.seed = seed;
    const PointCloud cloud = synthesize(synth).cloud;
    const FeatureLabels labels = labels_of(cloud);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (labels.kind[i] != Kind::Corner) continue;
      ++corners;
      const Point& p = cloud.positions[i];
      if (0.5 - std::min({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) < 2 * h) ++at_corners;
    }
  }
  EXPECT_GE(corners, 30U);  // 40 corners; those parts of the edges are a tenth of their length
  EXPECT_GT(share(at_corners, corners), 0.75);
}

TEST(Pauly, ObtuseEdgesNeedASmallerLimit) {
  const PointCloud cloud = shape("icosahedron", 12000);
  PaulyOptions options;
  options.smallest_scale = 10;
  options.largest_scale = 100;
  options.scale_step = 10;
  options.variation = 0.03;
  EXPECT_LT(features(labels_of(cloud, options)), 100U);  // its twelve corners
  options.variation = 0.01;
  EXPECT_GT(features(labels_of(cloud, options)), 1000U);
}

TEST(Pauly, NothingIsSharpOnSmoothSurfaces) {
  for (const char* const name : {"sphere", "torus", "plane"})
    for (const double noise_h : {0.0, 0.05})
      EXPECT_EQ(features(labels_of(shape(name, 12000, noise_h))), 0U) << name;
}

TEST(Pauly, FlatIsToldFromCurved) {
  PaulyOptions options;
  options.largest_scale = 128;
  const FeatureLabels plane = labels_of(shape("plane", 4000), options);
  EXPECT_EQ(count(plane, Kind::Curved), 0U);
  EXPECT_GT(share(count(labels_of(shape("sphere", 4000), options), Kind::Curved), 4000), 0.99);
}

TEST(Pauly, BordersAreWhereTheNeighborsLeaveASectorEmpty) {
  const PointCloud cloud = shape("plane", 10000);  // the unit square
  const FeatureLabels labels = labels_of(cloud);
  Point low = cloud.positions[0];
  Point high = low;
  for (const Point& p : cloud.positions)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  std::size_t near = 0;
  std::size_t near_found = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point& p = cloud.positions[i];
    const double d = 100 * std::min({p[0] - low[0], high[0] - p[0], p[1] - low[1], high[1] - p[1]});
    EXPECT_FALSE(d > 2 && labels.kind[i] == Kind::Border) << d;
    if (d > 0.3) continue;
    ++near;
    if (labels.kind[i] == Kind::Border) ++near_found;
  }
  EXPECT_GT(share(near_found, near), 0.9);
  PaulyOptions options;
  options.border_gap_deg = 360;
  EXPECT_EQ(count(labels_of(cloud, options), Kind::Border), 0U);
}

/// Two sheets as near as three spacings: large neighbourhoods hold both, and would be features.
TEST(Pauly, ScalesAtWhichAnotherSheetComesInAreLeftOut) {
  PointCloud cloud = shape("plane", 6000);
  const PointCloud other = shape("plane", 5000);
  const double h = std::sqrt(1.0 / 6000);
  for (const Point& p : other.positions) cloud.positions.push_back({p[1], p[0], p[2] + 2.5 * h});
  PaulyOptions options;
  options.largest_scale = 120;
  options.variation = 0.04;
  options.seed_share = options.grow_share = 0.6;
  options.border_gap_deg = 360;
  const std::size_t with_rule = features(labels_of(cloud, options));
  options.turn_deg = 90;
  const std::size_t without = features(labels_of(cloud, options));
  EXPECT_LE(with_rule, without);
}

TEST(Pauly, HysteresisGrowsFromSeedsOnly) {
  const PointCloud cloud = shape("cube", 6000);
  PaulyOptions options;
  options.variation = 0.04;
  const auto with = [&](double seed, double grow) {
    options.seed_share = seed;
    options.grow_share = grow;
    return features(labels_of(cloud, options));
  };
  const std::size_t seeds = with(1, 1);
  const std::size_t all = with(0.5, 0.5);
  const std::size_t grown = with(1, 0.5);
  EXPECT_LT(seeds, grown);
  EXPECT_LE(grown, all);
  // No feature is without a seed within reach.
  options.seed_share = options.grow_share = 1;
  options.variation = 0.3;
  const FeatureLabels none = labels_of(cloud, options);
  options.grow_share = 0;
  EXPECT_EQ(features(labels_of(cloud, options)), features(none));
}

TEST(Pauly, DoesNotDependOnScalePlaceOrDirection) {
  const PointCloud cloud = shape("fandisk", 6000);
  const FeatureLabels labels = labels_of(cloud);
  for (const PointCloud& other :
       {test::moved(cloud, 1e-3, {0, 0, 0}), test::moved(cloud, 1, {1e6, -3e6, 1e6})}) {
    const FeatureLabels found = labels_of(other);
    std::size_t different = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (found.kind[i] != labels.kind[i]) ++different;
      EXPECT_NEAR(found.score[i], labels.score[i], 1e-5F);
    }
    EXPECT_LE(different, 6U);  // rounding of the coordinates, where a share or a limit is just met
  }
  PointCloud huge = cloud;
  for (Point& p : huge.positions)
    for (double& c : p) c *= 0x1p900;
  EXPECT_EQ(labels_of(huge).kind, labels.kind);
  EXPECT_EQ(labels_of(huge).score, labels.score);
}

TEST(Pauly, WhatCannotBeToldIsUndecided) {
  PointCloud cloud;
  EXPECT_EQ(labels_of(cloud).size(), 0U);
  cloud.positions.assign(100, {1, 2, 3});
  cloud.positions.push_back({nan, 0, 0});
  EXPECT_EQ(count(labels_of(cloud), Kind::Undecided), 101U);
  cloud = shape("cube", 8);  // one neighbour short of the smallest scale
  EXPECT_EQ(count(labels_of(cloud), Kind::Undecided), 8U);
  cloud.positions.clear();
  for (int i = 0; i < 100; ++i) cloud.positions.push_back({0.1 * i, 0.025 * i, -0.2 * i});
  EXPECT_EQ(features(labels_of(cloud)), 0U) << "a line";
  cloud.positions.push_back({1e308, -1e308, 1e308});
  EXPECT_EQ(features(labels_of(cloud)), 0U);
}

TEST(Pauly, RefusesWhatIsOutOfRange) {
  const PointCloud cloud = shape("cube", 100);
  const NeighborSearch search(cloud.positions);
  const auto refuses = [&](const auto& change, std::string_view name) {
    PaulyOptions options;
    change(options);
    expect_error<InvalidArgument>([&] { (void)detect_pauly(cloud, search, options); }, name);
  };
  refuses([](PaulyOptions& o) { o.smallest_scale = 2; }, "smallest_scale");
  refuses([](PaulyOptions& o) { o.largest_scale = 7; }, "largest_scale");
  refuses([](PaulyOptions& o) { o.largest_scale = 256; }, "largest_scale");
  refuses([](PaulyOptions& o) { o.scale_step = 0; }, "scale_step");
  refuses([](PaulyOptions& o) { o.variation = 0; }, "variation");
  refuses([](PaulyOptions& o) { o.variation = 0.34; }, "variation");
  refuses([](PaulyOptions& o) { o.seed_share = nan; }, "seed_share");
  refuses([](PaulyOptions& o) { o.grow_share = 0.96; }, "grow_share");
  refuses([](PaulyOptions& o) { o.turn_deg = 91; }, "turn_deg");
  refuses([](PaulyOptions& o) { o.border_gap_deg = 361; }, "border_gap_deg");
}

}  // namespace
}  // namespace keenline
