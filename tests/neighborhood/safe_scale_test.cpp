#include "keenline/neighborhood/safe_scale.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<Point> scaled_unit_cloud(int exponent) {
  std::vector<Point> points = test::random_points(500, 1);
  for (Point& p : points)
    for (double& c : p) c = std::ldexp(c, exponent);
  return points;
}

TEST(SafeScale, LeavesWhatSquaresSafely) {
  EXPECT_EQ(safe_exponent({}), 0);
  EXPECT_EQ(safe_exponent({{0, 0, 0}, {-0.0, 0, 0}}), 0);
  for (const int exponent : {-380, -20, 0, 20, 499}) EXPECT_EQ(safe_exponent(scaled_unit_cloud(exponent)), 0);
}

TEST(SafeScale, PutsTheLargestCoordinateAtTheTop) {
  EXPECT_EQ(safe_exponent({{0, 0x1p-660, 0}}), -660 + 1 - 500);
  EXPECT_EQ(safe_exponent({{0, 0, 0}, {0, -0x1p1020, 0}}), 1020 + 1 - 500);
}

TEST(SafeScale, DoesNotPushTheCloudOutForOneOutlier) {
  std::vector<Point> points = scaled_unit_cloud(0);
  points.push_back({1e308, 0, 0});
  const int exponent = safe_exponent(points);
  EXPECT_LE(exponent, 350);  // what is about 1 squares to a normal number
  EXPECT_GT(exponent, 300);
  EXPECT_EQ(safely_scaled(points.back(), exponent), (Point{0x1p500, 0, 0}));
}

TEST(SafeScale, IgnoresWhatIsNotFinite) {
  std::vector<Point> points = scaled_unit_cloud(0);
  points.push_back({infinity, 0, 0});
  points.push_back({1e-300, 1e300, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_EQ(safe_exponent(points), 0);
}

TEST(SafeScale, IsExactWithinItsRange) {
  EXPECT_EQ(safely_scaled({0x1.23456789p-660, -3, 0}, -660), (Point{0x1.23456789p0, -0x1p500, 0}));
  EXPECT_EQ(safely_scaled({0.1, -0.2, 1e300}, 0), (Point{0.1, -0.2, 0x1p500}));
}

}  // namespace
}  // namespace keenline
