#include "keenline/lines/fit_spline.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

namespace keenline {
namespace {

std::vector<Point> sine(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = 6 * static_cast<double>(i) / static_cast<double>(count - 1);
    points.push_back({x + 1e6, std::sin(x), 0.1 * x});
  }
  return points;
}

std::vector<Point> ellipse(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(count);
    points.push_back({3 * std::cos(angle), std::sin(angle), 0});
  }
  return points;
}

double largest_miss(const SplineFit& fit, const std::vector<Point>& points) {
  double largest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    largest = std::max(largest, distance(point_on(fit.spline, fit.parameters[i]), points[i]));
  return largest;
}

void expect_valid(const FittedSpline& spline) {
  FeatureGraph graph;
  graph.polylines.push_back({.vertices = {{0, 0, 0}, {1, 0, 0}}});
  graph.polylines[0].fitted = spline;
  EXPECT_NO_THROW(validate(graph));
}

TEST(FitSpline, OneBezierCurveIsFoundAgain) {
  const FittedSpline bezier{{{0, 0, 0}, {1, 2, 0}, {3, 2, 1}, {4, 0, 1}}, {0, 0, 0, 0, 1, 1, 1, 1}};
  EXPECT_EQ(point_on(bezier, 0), (Point{0, 0, 0}));
  EXPECT_EQ(point_on(bezier, 1), (Point{4, 0, 1}));
  EXPECT_EQ(point_on(bezier, 0.5), (Point{2, 1.5, 0.5}));
  std::vector<Point> points;
  for (int i = 0; i <= 40; ++i) points.push_back(point_on(bezier, i / 40.0));
  const auto fit = fit_spline(points, false, 4);
  ASSERT_TRUE(fit);
  EXPECT_LT(largest_miss(*fit, points), 0.03);  // the parameters come near, three steps do not get there
}

TEST(FitSpline, MoreControlPointsComeNearer) {
  const std::vector<Point> points = sine(60);
  double last = 1;
  for (const std::size_t controls : {5U, 8U, 14U, 26U}) {
    const auto fit = fit_spline(points, false, controls);
    ASSERT_TRUE(fit) << controls;
    expect_valid(fit->spline);
    EXPECT_EQ(fit->spline.control_points.size(), controls);
    EXPECT_LT(largest_miss(*fit, points), 0.5 * last) << controls;
    last = largest_miss(*fit, points);
  }
  EXPECT_LT(last, 1e-4);
}

TEST(FitSpline, AsManyControlPointsAsPointsGoThroughAll) {
  const std::vector<Point> points = sine(12);
  const auto fit = fit_spline(points, false, 12);
  ASSERT_TRUE(fit);
  EXPECT_LT(largest_miss(*fit, points), 1e-8);
}

TEST(FitSpline, BeginsAndEndsWhereThePointsDo) {
  const std::vector<Point> points = sine(30);
  const auto fit = fit_spline(points, false, 6);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->spline.control_points.front(), points.front());
  EXPECT_EQ(fit->spline.control_points.back(), points.back());
  EXPECT_TRUE(std::is_sorted(fit->parameters.begin(), fit->parameters.end()));
}

TEST(FitSpline, AClosedOneHasNoKinkWhereItCloses) {
  const std::vector<Point> points = ellipse(60);
  const auto fit = fit_spline(points, true, 14);
  ASSERT_TRUE(fit);
  expect_valid(fit->spline);
  EXPECT_LT(largest_miss(*fit, points), 0.03);
  EXPECT_EQ(fit->parameters.size(), points.size());
  const auto& controls = fit->spline.control_points;
  EXPECT_EQ(controls.front(), controls.back());
  const Point before = unit(difference(controls.back(), controls[controls.size() - 2]));
  const Point after = unit(difference(controls[1], controls[0]));
  EXPECT_GT(dot(before, after), 1 - 1e-6);
}

TEST(FitSpline, CoincidentPointsDoNoHarm) {
  std::vector<Point> points = sine(20);
  points.insert(points.begin() + 7, 3, points[7]);
  points.insert(points.end(), 2, points.back());
  const auto fit = fit_spline(points, false, 8);
  ASSERT_TRUE(fit);
  expect_valid(fit->spline);
  EXPECT_FALSE(fit_spline(std::vector<Point>(9, Point{1, 2, 3}), false, 4));
  EXPECT_FALSE(fit_spline(std::vector<Point>(9, Point{1, 2, 3}), true, 5));
}

}  // namespace
}  // namespace keenline
