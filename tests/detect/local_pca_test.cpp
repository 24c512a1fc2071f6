#include "keenline/detect/local_pca.h"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/ideal_neighborhoods.h"
#include "support/motion.h"
#include "support/uneven_clouds.h"

namespace keenline {
namespace {

PrincipalComponents components_of(const std::vector<Point>& points) {
  GrowingCovariance sums;
  for (const Point& p : points) sums.add(p);
  return principal_components(sums.covariance());
}

void expect_variances(const std::vector<Point>& points, const std::array<double, 3>& expected) {
  const PrincipalComponents found = components_of(points);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(found.variance[i], expected[i], 3e-4) << i;
}

TEST(LocalPca, VariancesOfIdealNeighborhoodsAreThoseOfTheIntegrals) {
  expect_variances(test::ideal_edge(60), {0.0524, 0.0625, 0.25});
  expect_variances(test::ideal_edge(90), {0.0349, 0.125, 0.25});
  expect_variances(test::ideal_edge(120), {0.0175, 0.1875, 0.25});
  expect_variances(test::ideal_edge(138.19), {0.0089, 0.2182, 0.25});
  expect_variances(test::ideal_edge(180), {0, 0.25, 0.25});
  expect_variances(test::ideal_border(), {0, 0.0699, 0.25});
  expect_variances(test::ideal_cube_corner(), {0.0326, 0.1136, 0.1136});
}

TEST(LocalPca, SurfaceVariationOfIdealNeighborhoods) {
  const auto variation = [](const std::vector<Point>& points) {
    return surface_variation(components_of(points));
  };
  EXPECT_NEAR(variation(test::ideal_edge(60)), 0.1436, 5e-4);
  EXPECT_NEAR(variation(test::ideal_edge(90)), 0.0852, 5e-4);
  EXPECT_NEAR(variation(test::ideal_edge(120)), 0.0384, 5e-4);
  EXPECT_NEAR(variation(test::ideal_edge(138.19)), 0.0186, 5e-4);
  EXPECT_NEAR(variation(test::ideal_edge(150)), 0.0096, 5e-4);
  EXPECT_NEAR(variation(test::ideal_cube_corner()), 0.1254, 5e-4);
  EXPECT_NEAR(variation({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}), 1.0 / 3,
              1e-15);
  EXPECT_EQ(variation({{2, 3, 4}, {2, 3, 4}}), 0);
}

TEST(LocalPca, SumsGrowToWhatTwoPassesGive) {
  const std::vector<Point> points = test::random_points(200, 4);
  GrowingCovariance sums;
  for (std::size_t n = 1; n <= points.size(); ++n) {
    sums.add(points[n - 1]);
    Point mean{};
    for (std::size_t i = 0; i < n; ++i) mean = sum(mean, scaled(1.0 / static_cast<double>(n), points[i]));
    double xy = 0;
    double zz = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const Point d = difference(points[i], mean);
      xy += d[0] * d[1] / static_cast<double>(n);
      zz += d[2] * d[2] / static_cast<double>(n);
    }
    EXPECT_NEAR(sums.covariance().xy, xy, 1e-14) << n;
    EXPECT_NEAR(sums.covariance().zz, zz, 1e-14) << n;
    EXPECT_NEAR(distance(sums.mean(), mean), 0, 1e-14) << n;
  }
}

TEST(LocalPca, ComponentsTurnWithThePoints) {
  std::vector<Point> points = test::ideal_edge(90);
  const PrincipalComponents before = components_of(points);
  for (Point& p : points) p = test::turned(p);
  const PrincipalComponents after = components_of(points);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(after.variance[i], before.variance[i], 1e-12);
    EXPECT_NEAR(std::abs(dot(after.axis[i], test::turned(before.axis[i]))), 1, 1e-12);
  }
}

TEST(LocalPca, GapIsTheWidestEmptySector) {
  std::vector<double> angles;
  PrincipalComponents plane;
  plane.axis = {Point{0, 0, 1}, Point{0, 1, 0}, Point{1, 0, 0}};
  const auto gap = [&](const std::vector<Point>& offsets) { return widest_gap_deg(offsets, plane, angles); };
  EXPECT_NEAR(gap({{1, 0, 0}, {0, 1, 5}, {-1, 0, -3}, {0, -1, 0}}), 90, 1e-12);
  EXPECT_NEAR(gap({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}), 180, 1e-12);
  EXPECT_NEAR(gap({{-1, 1, 0}, {-1, -1, 0}}), 270, 1e-12) << "over the cut of the angles";
  EXPECT_NEAR(gap({{0, 1, 0}}), 360, 1e-12);
  EXPECT_EQ(gap({{0, 0, 1}, {0, 0, -2}}), 360) << "along the normal";
  EXPECT_EQ(gap({}), 360);
  EXPECT_NEAR(widest_gap_deg(test::ideal_border(), components_of(test::ideal_border()), angles), 180, 1.0);
}

}  // namespace
}  // namespace keenline
