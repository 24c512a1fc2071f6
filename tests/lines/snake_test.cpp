#include "keenline/lines/snake.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

Point nothing(std::size_t /*vertex*/, const Point& /*place*/) { return {0, 0, 0}; }

TEST(Snake, StretchesStraightBetweenItsEnds) {
  std::vector<Point> vertices;
  for (int i = 0; i <= 10; ++i) vertices.push_back({1.0 * i, i % 2 == 0 ? 0.0 : 0.8, 0.3 * (i % 3)});
  const std::vector<Point> before = vertices;
  SnakeOptions options;
  options.duration = 500;
  relax_snake(vertices, false, options, nothing);
  EXPECT_EQ(vertices.front(), before.front());
  EXPECT_EQ(vertices.back(), before.back());
  const Point end = before.back();
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Point expected = scaled(static_cast<double>(i) / 10, end);
    EXPECT_NEAR(distance(vertices[i], expected), 0, 1e-3) << i;
  }
}

/// Of a regular polygon of n vertices every force is towards the middle, as large as its radius times what
/// the second and fourth differences of a wave of n steps are.
TEST(Snake, LoopsShrinkAtTheRateOfTheEnergy) {
  const int n = 24;
  const double pi = std::acos(-1.0);
  std::vector<Point> vertices;
  for (int i = 0; i < n; ++i) vertices.push_back({std::cos(2 * pi * i / n), std::sin(2 * pi * i / n), 5});
  const SnakeOptions options;
  relax_snake(vertices, true, options, nothing);
  const double second = 2 - 2 * std::cos(2 * pi / n);
  const double rate = options.tension * second + options.stiffness * second * second;
  const double expected = std::exp(-rate * options.duration);
  for (const Point& v : vertices) {
    EXPECT_NEAR(std::hypot(v[0], v[1]), expected, 0.01);
    EXPECT_NEAR(v[2], 5, 1e-12);
  }
}

TEST(Snake, GoesWhereItIsAttracted) {
  std::vector<Point> vertices;
  for (int i = 0; i <= 20; ++i) vertices.push_back({1.0 * i, 0, 0});
  const auto towards_line = [](std::size_t /*vertex*/, const Point& p) { return Point{0, 2 - p[1], 0}; };
  SnakeOptions options;
  relax_snake(vertices, false, options, towards_line);
  EXPECT_EQ(vertices.front(), (Point{0, 0, 0}));
  EXPECT_NEAR(vertices[10][1], 2, 0.05);
  options.pull = 0;
  const std::vector<Point> before = vertices;
  options.tension = options.stiffness = 0;
  relax_snake(vertices, false, options, towards_line);
  EXPECT_EQ(vertices, before);
}

TEST(Snake, StaysStableWithTheStiffestOptions) {
  std::vector<Point> vertices;
  for (int i = 0; i < 40; ++i) vertices.push_back({1.0 * i, i % 2 == 0 ? 1.0 : -1.0, 0});
  SnakeOptions options;
  options.tension = options.stiffness = 1;
  relax_snake(vertices, false, options, nothing);
  for (const Point& v : vertices) EXPECT_LE(std::abs(v[1]), 1.0);
}

TEST(Snake, ShortCurvesAndWrongOptions) {
  std::vector<Point> two{{0, 0, 0}, {1, 0, 0}};
  relax_snake(two, false, {}, nothing);
  EXPECT_EQ(two[1], (Point{1, 0, 0}));
  SnakeOptions options;
  options.tension = 1.5;
  test::expect_error<InvalidArgument>([&] { relax_snake(two, false, options, nothing); }, "tension", "1.5");
  options = {};
  options.duration = std::nan("");
  test::expect_error<InvalidArgument>([&] { relax_snake(two, false, options, nothing); }, "duration");
}

}  // namespace
}  // namespace keenline
