#include "keenline/detect/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/synth/synth.h"

#include "support/cancelled_progress.h"
#include "support/motion.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

PointCloud shape(const std::string& name, double noise_h = 0, Sampling sampling = Sampling::Random,
                 std::uint64_t points = 10000) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  options.sampling = sampling;
  return synthesize(options).cloud;
}

double noise_of(const PointCloud& cloud) { return estimate_noise(cloud, NeighborSearch(cloud.positions)); }

TEST(Noise, IsTheStandardDeviationInSpacings) {
  for (const double level : {0.05, 0.1, 0.2, 0.35, 0.5})
    EXPECT_NEAR(noise_of(shape("plane", level)) / level, 1, 0.15) << level;
  for (const char* const name : {"cube", "sphere"})
    for (const double level : {0.1, 0.2, 0.35, 0.5})
      EXPECT_NEAR(noise_of(shape(name, level)) / level, 1, 0.25) << name << ' ' << level;
}

TEST(Noise, IsNotCurvatureOrEdges) {
  for (const char* const name : {"plane", "sphere", "cube", "cylinder", "torus", "fandisk"})
    for (const Sampling sampling : {Sampling::Random, Sampling::Grid, Sampling::Mesh, Sampling::Scan})
      EXPECT_LT(noise_of(shape(name, 0, sampling)), 0.1) << name;
}

TEST(Noise, IsNotASecondSheetCloseBy) {
  PointCloud cloud = shape("plane", 0, Sampling::Random, 4000);
  PointCloud other = shape("plane", 0, Sampling::Random, 4000);
  std::shuffle(other.positions.begin(), other.positions.end(), std::mt19937(1));
  const double h = std::sqrt(1.0 / 4000);
  for (const Point& p : other.positions) cloud.positions.push_back({p[1], p[0], p[2] + 0.7 * h});
  EXPECT_LT(noise_of(cloud), 0.1);
}

TEST(Noise, DoesNotDependOnScalePlaceOrDirection) {
  const PointCloud cloud = shape("torus", 0.2);
  const double noise = noise_of(cloud);
  EXPECT_NEAR(noise_of(test::moved(cloud, 1, {0, 0, 0})) / noise, 1, 1e-3);
  EXPECT_NEAR(noise_of(test::moved(cloud, 10, {1e7, -3e6, 1e7})) / noise, 1, 1e-3);  // spacing of centimetres
}

TEST(Noise, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = shape("sphere", 0.1, Sampling::Random, 20000);
  const NeighborSearch search(cloud.positions);
  const double noise = estimate_noise(cloud, search);
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(estimate_noise(cloud, search), noise);
  }
}

TEST(Noise, IsZeroWhereThereIsNothingToMeasure) {
  PointCloud cloud;
  EXPECT_EQ(noise_of(cloud), 0);
  cloud.positions.assign(1000, {1, 2, 3});
  EXPECT_EQ(noise_of(cloud), 0);
  cloud.positions.assign(30, {nan, nan, nan});
  EXPECT_EQ(noise_of(cloud), 0);
  cloud.positions.clear();
  for (int i = 0; i < 100; ++i) cloud.positions.push_back({0.1 * i, 0.025 * i, -0.2 * i});
  EXPECT_EQ(noise_of(cloud), 0) << "a line";
}

TEST(Noise, PassesOverWhatIsNotFiniteOrFarAway) {
  PointCloud cloud = shape("plane", 0.2);
  const double noise = noise_of(cloud);
  for (int i = 0; i < 20; ++i) cloud.positions.push_back({nan, 0, 0});
  cloud.positions.push_back({1e308, -1e308, 1e308});
  EXPECT_NEAR(noise_of(cloud), noise, 0.01);
}

TEST(Noise, CanBeCancelled) {
  const PointCloud cloud = shape("plane", 0.1, Sampling::Random, 500);
  test::CancelledProgress progress;
  EXPECT_THROW((void)estimate_noise(cloud, NeighborSearch(cloud.positions), progress), Cancelled);
}

}  // namespace
}  // namespace keenline
