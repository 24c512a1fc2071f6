#include "keenline/neighborhood/spacing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"
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

double spacing_of(const PointCloud& cloud) { return estimate_spacing(cloud, find_neighborhoods(cloud, 16)); }
double noise_of(const PointCloud& cloud) { return estimate_noise(cloud, find_neighborhoods(cloud, 16)); }

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

TEST(Spacing, UsesTheSixteenNearestOfMore) {
  const PointCloud cloud = shape("torus").cloud;
  EXPECT_EQ(estimate_spacing(cloud, find_neighborhoods(cloud, 40)), spacing_of(cloud));
  EXPECT_EQ(estimate_noise(cloud, find_neighborhoods(cloud, 40)), noise_of(cloud));
}

TEST(Noise, IsTheStandardDeviationInSpacings) {
  for (const char* const name : {"plane", "sphere", "cube"}) {
    for (const Sampling sampling : {Sampling::Random, Sampling::Grid}) {
      for (const double level : {0.05, 0.1, 0.2, 0.35, 0.5})
        EXPECT_NEAR(noise_of(shape(name, level, sampling).cloud) / level, 1, 0.15) << name << ' ' << level;
    }
  }
}

TEST(Noise, IsNotCurvatureOrEdges) {
  for (const char* const name : {"plane", "sphere", "cube", "cylinder", "torus"}) {
    for (const Sampling sampling : {Sampling::Random, Sampling::Grid, Sampling::Mesh, Sampling::Scan})
      EXPECT_LT(noise_of(shape(name, 0, sampling).cloud), 0.02) << name;
  }
}

/// What spacing.h says, of every point, with Eigen's solvers.
double reference_noise(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  using Vector = Eigen::Vector3d;
  std::vector<double> levels;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto neighbors = neighborhoods.of(i).first(16);
    Eigen::Matrix<double, 17, 3> near;
    near.row(0) = Vector(cloud.positions[i].data());
    for (int k = 0; k < 16; ++k)
      near.row(k + 1) = Vector(cloud.positions[neighbors[static_cast<std::size_t>(k)]].data());
    const double radius = (near.row(16) - near.row(0)).norm();
    const Eigen::Matrix<double, 17, 3> centred = near.rowwise() - near.colwise().mean();
    const Eigen::Matrix3d frame =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred).eigenvectors();
    const Eigen::Matrix<double, 17, 3> local = centred * frame / radius;  // first column: the normal
    Eigen::Matrix<double, 17, 6> terms;
    for (int k = 0; k < 17; ++k) {
      const double x = local(k, 1);
      const double y = local(k, 2);
      terms.row(k) << 1, x, y, x * x, x * y, y * y;
    }
    const Eigen::VectorXd heights = local.col(0);
    const Eigen::VectorXd residual = heights - terms * terms.colPivHouseholderQr().solve(heights);
    levels.push_back(residual.norm() / std::sqrt(11.0) / std::sqrt(std::numbers::pi / 16.5));
  }
  std::sort(levels.begin(), levels.end());
  return levels[(levels.size() - 1) / 2];
}

TEST(Noise, EqualsAnObviousImplementation) {
  for (const char* const name : {"torus", "cube"}) {
    const PointCloud cloud = shape(name, 0.2, Sampling::Random, 2000).cloud;
    const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);
    const double expected = reference_noise(cloud, neighborhoods);
    EXPECT_NEAR(estimate_noise(cloud, neighborhoods) / expected, 1, 1e-9) << name;
  }
}

TEST(SpacingAndNoise, DoNotDependOnScalePlaceOrDirection) {
  const PointCloud cloud = shape("torus", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  const double noise = noise_of(cloud);
  const PointCloud turned = test::moved(cloud, 1, {0, 0, 0});
  EXPECT_NEAR(spacing_of(turned) / spacing, 1, 1e-12);
  EXPECT_NEAR(noise_of(turned) / noise, 1, 1e-9);
  const PointCloud georeferenced = test::moved(cloud, 10, {1e7, -3e6, 1e7});  // spacing of centimetres
  EXPECT_NEAR(spacing_of(georeferenced) / spacing, 10, 1e-5);
  EXPECT_NEAR(noise_of(georeferenced) / noise, 1, 1e-5);
  for (const int exponent : {-1000, -500, 500, 1020}) {
    PointCloud scaled = cloud;
    for (Point& p : scaled.positions)
      for (double& c : p) c = std::ldexp(c, exponent);
    const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);  // the same, if nothing is rounded
    EXPECT_NEAR(noise_of(scaled) / noise, 1, 1e-9) << exponent;
    EXPECT_EQ(estimate_spacing(scaled, neighborhoods), std::ldexp(spacing, exponent)) << exponent;
  }
}

TEST(SpacingAndNoise, DoNotDependOnTheOrderOfThePoints) {
  PointCloud cloud = shape("torus", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  const double noise = noise_of(cloud);
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), std::mt19937(5));
  EXPECT_EQ(spacing_of(cloud), spacing);
  EXPECT_EQ(noise_of(cloud), noise);
}

TEST(SpacingAndNoise, AreTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = shape("sphere", 0.1, Sampling::Random, 40000).cloud;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);
  const double spacing = estimate_spacing(cloud, neighborhoods);
  const double noise = estimate_noise(cloud, neighborhoods);
  EXPECT_NEAR(noise, 0.1, 0.015) << "of a sample: every third point";
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(estimate_spacing(cloud, neighborhoods), spacing);
    EXPECT_EQ(estimate_noise(cloud, neighborhoods), noise);
  }
}

TEST(SpacingAndNoise, AreZeroWhereThereIsNothingToMeasure) {
  PointCloud cloud;
  EXPECT_EQ(spacing_of(cloud), 0);
  EXPECT_EQ(noise_of(cloud), 0);
  cloud.positions.assign(1000, {1, 2, 3});
  EXPECT_EQ(spacing_of(cloud), 0);
  EXPECT_EQ(noise_of(cloud), 0);
  cloud.positions.assign(30, {nan, nan, nan});
  EXPECT_EQ(spacing_of(cloud), 0);
  EXPECT_EQ(noise_of(cloud), 0);
}

TEST(Noise, IsZeroWhereNoQuadricIsDetermined) {
  std::mt19937 generator(3);
  const auto number = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  PointCloud line;
  PointCloud two_lines;
  PointCloud nine;  // eight neighbours each
  for (int i = 0; i < 500; ++i) {
    const double t = number();
    line.positions.push_back({t, 0.25 * t, -2 * t});
    two_lines.positions.push_back({t, i % 2 == 0 ? 0.0 : 0.002, 0});
  }
  for (int i = 0; i < 9; ++i) nine.positions.push_back({number(), number(), number()});
  EXPECT_EQ(noise_of(line), 0);
  EXPECT_GT(spacing_of(line), 0);
  EXPECT_EQ(noise_of(two_lines), 0);
  EXPECT_EQ(noise_of(nine), 0);
  nine.positions.push_back({number(), number(), number()});
  EXPECT_GT(noise_of(nine), 0) << "ten points are enough";
}

TEST(SpacingAndNoise, PassOverWhatIsNotFiniteOrFarAway) {
  PointCloud cloud = shape("plane", 0.2).cloud;
  const double spacing = spacing_of(cloud);
  const double noise = noise_of(cloud);
  for (int i = 0; i < 20; ++i) cloud.positions.push_back({nan, 0, 0});
  EXPECT_EQ(spacing_of(cloud), spacing);
  EXPECT_NEAR(noise_of(cloud), noise, 0.001);
  cloud.positions.push_back({1e308, -1e308, 1e308});
  cloud.positions.push_back({-1e308, 1e308, 1e308});
  EXPECT_NEAR(spacing_of(cloud) / spacing, 1, 1e-3);
  EXPECT_NEAR(noise_of(cloud), noise, 0.001);
}

TEST(SpacingAndNoise, RefuseNeighborhoodsOfAnotherCloud) {
  const PointCloud cloud = shape("plane", 0, Sampling::Random, 100).cloud;
  EXPECT_THROW((void)estimate_spacing(cloud, Neighborhoods{}), InvalidArgument);
  EXPECT_THROW((void)estimate_noise(cloud, Neighborhoods{}), InvalidArgument);
}

}  // namespace
}  // namespace keenline
