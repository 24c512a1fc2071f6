#include "keenline/lines/fit_arc.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/motion.h"
#include "support/uneven_clouds.h"

namespace keenline {
namespace {

const double degree = std::acos(-1.0) / 180;

/// On a circle of radius 2 somewhere in space, from one angle to another.
std::vector<Point> turned_arc(double from_deg, double to_deg, int count, double unrest = 0) {
  const std::vector<Point> random = test::random_points(static_cast<std::size_t>(count), 4);
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double angle = (from_deg + (to_deg - from_deg) * i / (count - 1)) * degree;
    const bool is_end = i == 0 || i == count - 1;
    const Point p{2 * std::cos(angle), 2 * std::sin(angle), 0};
    const double off = is_end ? 0 : unrest;
    const Point& r = random[static_cast<std::size_t>(i)];
    points.push_back(sum({100, 0, 0}, test::turned(sum(p, scaled(off, difference(r, {0.5, 0.5, 0.5}))))));
  }
  return points;
}

const Point center{100, 0, 0};

TEST(FitArc, ExactArcsAreFoundAgain) {
  for (const double sweep : {5.0, 90.0, 180.0, 270.0, 350.0}) {
    for (const double start : {0.0, 200.0}) {
      const std::vector<Point> points = turned_arc(start, start + sweep, 21);
      const auto arc = fit_arc(points, false);
      ASSERT_TRUE(arc) << sweep;
      EXPECT_NEAR(arc->radius, 2, 1e-8) << sweep;
      EXPECT_NEAR(arc->sweep_deg, sweep, 1e-6) << sweep;
      EXPECT_LT(distance(arc->center, center), 1e-8) << sweep;
      EXPECT_NEAR(length(arc->normal), 1, 1e-12);
      EXPECT_NEAR(dot(arc->normal, arc->x_axis), 0, 1e-12);
      for (const Point& p : points) EXPECT_LT(distance(nearest_on(*arc, p), p), 1e-8) << sweep;
    }
  }
}

TEST(FitArc, RunsFromTheFirstPointToTheLast) {
  std::vector<Point> points = turned_arc(10, 110, 15);
  const auto forth = fit_arc(points, false);
  std::reverse(points.begin(), points.end());
  const auto back = fit_arc(points, false);
  ASSERT_TRUE(forth && back);
  EXPECT_LT(length(sum(forth->normal, back->normal)), 1e-9);
  const Point start = sum(back->center, scaled(back->radius, back->x_axis));
  EXPECT_LT(distance(start, points.front()), 1e-8);
}

TEST(FitArc, UnrestAveragesOut) {
  const auto arc = fit_arc(turned_arc(0, 120, 200, 0.1), false);
  ASSERT_TRUE(arc);
  EXPECT_NEAR(arc->radius, 2, 0.02);
  EXPECT_LT(distance(arc->center, center), 0.03);
}

TEST(FitArc, ClosedLinesAreCircles) {
  std::vector<Point> points = turned_arc(30, 390, 41, 0.05);
  points.pop_back();
  const auto circle = fit_arc(points, true);
  ASSERT_TRUE(circle);
  EXPECT_EQ(circle->sweep_deg, 360);
  EXPECT_NEAR(circle->radius, 2, 0.01);
  EXPECT_LT(distance(circle->center, center), 0.02);
  // It begins beside the first point and turns as the line does.
  const Point start = sum(circle->center, scaled(circle->radius, circle->x_axis));
  EXPECT_LT(distance(start, points[0]), 0.1);
  const Point quarter = sum(circle->center, scaled(circle->radius, cross(circle->normal, circle->x_axis)));
  EXPECT_LT(distance(quarter, points[10]), 0.15);
}

TEST(FitArc, BeyondAnEndTheEndIsNearest) {
  const auto arc = fit_arc(turned_arc(0, 90, 10), false);
  ASSERT_TRUE(arc);
  const Point before = sum(center, test::turned({2, -1, 0}));
  EXPECT_LT(distance(nearest_on(*arc, before), sum(center, test::turned({2, 0, 0}))), 1e-8);
  const Point behind = sum(center, test::turned({-1, 2, 0}));
  EXPECT_LT(distance(nearest_on(*arc, behind), sum(center, test::turned({0, 2, 0}))), 1e-8);
}

TEST(FitArc, WhatIsStraightOrNowhereIsNoArc) {
  const std::vector<Point> straight{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {4, 4, 4}};
  EXPECT_FALSE(fit_arc(straight, false));
  EXPECT_FALSE(fit_arc(straight, true));
  EXPECT_FALSE(fit_arc(std::vector<Point>(5, Point{1, 2, 3}), false));
  EXPECT_FALSE(fit_arc(std::vector<Point>(5, Point{1, 2, 3}), true));
  EXPECT_FALSE(fit_arc(std::span(straight).first(2), false));
  EXPECT_FALSE(fit_arc({}, true));
}

}  // namespace
}  // namespace keenline
