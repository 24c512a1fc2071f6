#include "keenline/detect/cone.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/motion.h"

namespace keenline {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Points of a cone all around its axis, no two at one height; `lift` is added along the outer normal of
/// every other one and taken from the rest.
std::vector<Point> cone_points(double opening_deg, const Point& apex, double lift = 0, int count = 60) {
  const double sine = std::sin(opening_deg / 2 * degree);
  const double cosine = std::cos(opening_deg / 2 * degree);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double azimuth = 137.5 * degree * i;
    const double s = 0.3 + 2.0 * i / count;  // along the generator
    const double d = i % 2 == 0 ? lift : -lift;
    const double r = s * sine + d * cosine;
    points.push_back(
        sum(apex, test::turned({r * std::cos(azimuth), r * std::sin(azimuth), s * cosine - d * sine})));
  }
  return points;
}

std::vector<double> ones(const std::vector<Point>& points) { return std::vector<double>(points.size(), 1); }

TEST(Cone, IsFoundFromAStartBesideItsApex) {
  const Point apex{0.4, -0.2, 0.3};
  for (const double opening : {40.0, 60.0, 90.0, 125.0}) {
    const std::vector<Point> points = cone_points(opening, apex);
    const Cone cone = fitted_cone(points, ones(points), {0, 0, 0}).value();
    EXPECT_LT(distance(cone.apex, apex), 1e-5) << opening;
    EXPECT_NEAR(cone.squared_sine(), std::pow(std::sin(opening / 2 * degree), 2), 1e-5) << opening;
    EXPECT_NEAR(dot(unit(cone.slope), test::turned({0, 0, 1})), 1, 1e-6) << opening;
    EXPECT_LT(mean_square_off(cone, points, ones(points)), 1e-10) << opening;
  }
}

TEST(Cone, PointsWithoutWeightDoNotCount) {
  std::vector<Point> points = cone_points(60, {0, 0, 0});
  std::vector<double> weights = ones(points);
  for (int i = 0; i < 20; ++i) {
    points.push_back({0.1 * i, 1, -2});
    weights.push_back(0);
  }
  const Cone cone = fitted_cone(points, weights, {0.1, 0.1, 0.1}).value();
  EXPECT_LT(length(cone.apex), 1e-5);
  EXPECT_LT(mean_square_off(cone, points, weights), 1e-10);
}

TEST(Cone, DistancesArePerpendicular) {
  const double lift = 0.01;
  for (const double opening : {30.0, 60.0, 120.0}) {
    const Cone cone{{0, 0, 0}, scaled(1 / std::cos(opening / 2 * degree), test::turned({0, 0, 1}))};
    const std::vector<Point> points = cone_points(opening, {0, 0, 0}, lift);
    EXPECT_NEAR(std::sqrt(mean_square_off(cone, points, ones(points))), lift, 0.01 * lift) << opening;
  }
}

TEST(Cone, AParaboloidIsTheOtherExplanation) {
  const Cone cone{{0, 0, 0}, scaled(std::numbers::sqrt2, test::turned({0, 0, 1}))};
  std::vector<Point> bowl = cone_points(90, {0, 0, 0});
  for (Point& p : bowl) {
    const Point axis = test::turned({0, 0, 1});
    const double height = dot(p, axis);
    p = sum(p, scaled(0.7 * height * height + 0.2 - height, axis));
  }
  EXPECT_LT(mean_square_off_paraboloid(cone, bowl, ones(bowl)), 1e-20);
  const std::vector<Point> points = cone_points(90, {0, 0, 0});
  EXPECT_GT(mean_square_off_paraboloid(cone, points, ones(points)), 1e-4);
}

TEST(Cone, EnclosesItsAxisUnlessHalfIsMissing) {
  const Cone cone{{0, 0, 0}, test::turned({0, 0, 1.2})};
  std::vector<Point> points = cone_points(60, {0, 0, 0});
  EXPECT_TRUE(encloses_axis(cone, points));
  std::erase_if(points, [](const Point& p) { return dot(p, test::turned({1, 0, 0})) < 0; });
  EXPECT_FALSE(encloses_axis(cone, points));
}

TEST(Cone, WiresPlatesAndNonsenseAreNotPointed) {
  const auto with_opening = [](double opening_deg) {
    return Cone{{0, 0, 0}, {0, 1 / std::cos(opening_deg / 2 * degree), 0}};
  };
  EXPECT_TRUE(is_pointed(with_opening(12)));
  EXPECT_TRUE(is_pointed(with_opening(134)));
  EXPECT_FALSE(is_pointed(with_opening(11)));
  EXPECT_FALSE(is_pointed(with_opening(136)));
  EXPECT_FALSE(is_pointed({}));
  EXPECT_FALSE(is_pointed({{0, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 1, 0}}));
  const std::vector<Point> coincident(20, Point{1, 1, 1});
  EXPECT_FALSE(is_pointed(fitted_cone(coincident, ones(coincident), {1, 1, 1}).value_or(Cone{})));
}

TEST(Cone, IsNotLookedForBeyondThePoints) {
  // An edge and a plane: cones fit the better the farther off their apex is.
  std::vector<Point> edge;
  std::vector<Point> plane;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y) {
      edge.push_back({x * 0.3, y * 0.31, std::abs(x * 0.2)});
      plane.push_back({x * 0.3, y * 0.31, (x * y * 7 + x + y) % 3 * 0.02});
    }
  EXPECT_FALSE(fitted_cone(edge, ones(edge), {0, 0, 0}).has_value());
  EXPECT_FALSE(fitted_cone(plane, ones(plane), {0, 0, 0}).has_value());
}

}  // namespace
}  // namespace keenline
