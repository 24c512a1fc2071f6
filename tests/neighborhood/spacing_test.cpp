#include "keenline/neighborhood/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/synth/synth.h"

#include "support/motion.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SynthCloud shape(const std::string& name, double noise_h = 0, Sampling sampling = Sampling::Random,
                 std::uint64_t points = 10000) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  options.sampling = sampling;
  return synthesize(options);
}

double spacing_of(const PointCloud& cloud) {
  return estimate_spacing(cloud, NeighborSearch(cloud.positions));
}

TEST(Spacing, IsTheRootOfTheAreaPerPoint) {
  for (const char* const name : {"plane", "cube", "sphere"}) {
    for (const Sampling sampling : {Sampling::Random, Sampling::Grid, Sampling::Mesh}) {
      const SynthCloud synth = shape(name, 0, sampling);
      EXPECT_NEAR(spacing_of(synth.cloud) / synth.spacing, 1, 0.06) << name;
    }
  }
}

TEST(Spacing, FollowsItsFormulaToTheLowerMiddle) {
  // Points on a line; three neighbours each, the third at 3, 2, 2, 3: the lower middle is 2.
  PointCloud cloud;
  for (int i = 0; i < 4; ++i) cloud.positions.push_back({static_cast<double>(i), 0, 0});
  EXPECT_DOUBLE_EQ(spacing_of(cloud), 2 * std::sqrt(std::numbers::pi / 3.5));
  cloud.positions.resize(3);
  EXPECT_EQ(spacing_of(cloud), 0) << "two neighbours say nothing";
}

TEST(Spacing, DoNotDependOnScalePlaceOrDirection) {
  const PointCloud cloud = shape("torus", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  const PointCloud turned = test::moved(cloud, 1, {0, 0, 0});
  EXPECT_NEAR(spacing_of(turned) / spacing, 1, 1e-12);
  const PointCloud georeferenced = test::moved(cloud, 10, {1e7, -3e6, 1e7});  // spacing of centimetres
  EXPECT_NEAR(spacing_of(georeferenced) / spacing, 10, 1e-5);
  for (const int exponent : {-1000, -500, 500, 1020}) {
    PointCloud scaled = cloud;
    for (Point& p : scaled.positions)
      for (double& c : p) c = std::ldexp(c, exponent);
    EXPECT_EQ(spacing_of(scaled), std::ldexp(spacing, exponent)) << exponent;
  }
}

TEST(Spacing, DoNotDependOnTheOrderOfThePoints) {
  PointCloud cloud = shape("torus", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), std::mt19937(5));
  EXPECT_EQ(spacing_of(cloud), spacing);
}

TEST(Spacing, AreTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = shape("sphere", 0.1, Sampling::Random, 40000).cloud;
  const NeighborSearch search(cloud.positions);
  const double spacing = estimate_spacing(cloud, search);
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(estimate_spacing(cloud, search), spacing);
  }
}

TEST(Spacing, OfManyPointsASampleIsEnough) {
  const SynthCloud plane = shape("plane", 0, Sampling::Random, 300000);
  EXPECT_NEAR(spacing_of(plane.cloud) / plane.spacing, 1, 0.04);
}

TEST(Spacing, AreZeroWhereThereIsNothingToMeasure) {
  PointCloud cloud;
  EXPECT_EQ(spacing_of(cloud), 0);
  cloud.positions.assign(1000, {1, 2, 3});
  EXPECT_EQ(spacing_of(cloud), 0);
  cloud.positions.assign(30, {nan, nan, nan});
  EXPECT_EQ(spacing_of(cloud), 0);
}

TEST(Spacing, PassOverWhatIsNotFiniteOrFarAway) {
  PointCloud cloud = shape("plane", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  for (int i = 0; i < 20; ++i) cloud.positions.push_back({nan, 0, 0});
  EXPECT_EQ(spacing_of(cloud), spacing);
  cloud.positions.push_back({1e308, -1e308, 1e308});
  cloud.positions.push_back({-1e308, 1e308, 1e308});
  EXPECT_NEAR(spacing_of(cloud) / spacing, 1, 1e-3);
}

}  // namespace
}  // namespace keenline
