#include "keenline/synth/curve.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::pi;

void expect_near(const Vec3& a, const Vec3& b) {
  EXPECT_LT(distance(a, b), 1e-15) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(Curve, segment) {
  const Curve segment = Curve::segment({1, 0, 0}, {4, 4, 0});
  EXPECT_EQ(segment.length(), 5);
  expect_near(segment.at(0.5), {2.5, 2, 0});
  expect_near(segment.end_direction(), {0.6, 0.8, 0});
  EXPECT_DOUBLE_EQ(segment.distance_to({2.5 + 0.8, 2 - 0.6, 0}), 1);  // beside it
  EXPECT_DOUBLE_EQ(segment.distance_to({1, 0, 2}), 2);                // above its end
  EXPECT_DOUBLE_EQ(segment.distance_to({7, 8, 0}), 5);                // beyond its end
}

TEST(Curve, quarter_arc) {
  const Curve arc = Curve::arc({2, 0, 1}, {0, 2, 1}, {0, 0, 1});
  EXPECT_DOUBLE_EQ(arc.length(), pi);
  expect_near(arc.at(0.5), {std::sqrt(2.0), std::sqrt(2.0), 1});
  expect_near(arc.start_direction(), {0, 1, 0});
  expect_near(arc.end_direction(), {-1, 0, 0});
  EXPECT_NEAR(arc.distance_to({3, 4, 1}), 3, 1e-15);
  EXPECT_NEAR(arc.distance_to({0.6, 0.8, 1}), 1, 1e-15);
  EXPECT_DOUBLE_EQ(arc.distance_to({3, 4, 5}), 5);   // 3 off the circle, 4 above
  EXPECT_DOUBLE_EQ(arc.distance_to({2, -3, 1}), 3);  // past the start
  EXPECT_DOUBLE_EQ(arc.distance_to({-3, 2, 1}), 3);  // past the end
}

TEST(Curve, clockwise_arc_bulges_the_other_way) {
  const Curve arc = Curve::arc({1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, -1});
  EXPECT_DOUBLE_EQ(arc.length(), pi / 2);
  expect_near(arc.at(0.5), {1 - std::sqrt(0.5), 1 - std::sqrt(0.5), 0});
  expect_near(arc.start_direction(), {-1, 0, 0});
}

TEST(Curve, arc_beyond_a_half_turn) {
  const Curve arc = Curve::arc({0, -1, 0}, {-1, 0, 0}, {});
  EXPECT_DOUBLE_EQ(arc.length(), 1.5 * pi);
  expect_near(arc.at(1.0 / 3), {1, 0, 0});
  expect_near(arc.at(2.0 / 3), {0, 1, 0});
  EXPECT_NEAR(arc.distance_to({-0.5, 0.5, 0}), 1 - std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(arc.distance_to({-0.5, -0.5, 0}), std::sqrt(0.5), 1e-15);  // in the gap
}

TEST(Curve, circle) {
  const Curve circle = Curve::circle({1, 2, 3}, 2);
  EXPECT_TRUE(circle.is_circle());
  EXPECT_DOUBLE_EQ(circle.length(), 4 * pi);
  expect_near(circle.at(0), {3, 2, 3});
  expect_near(circle.at(0.25), {1, 4, 3});
  EXPECT_NEAR(circle.distance_to({1, 2, 3}), 2, 1e-15);
  EXPECT_NEAR(circle.distance_to({1, 7, 7}), 5, 1e-15);
}

TEST(Curve, ends_are_exact) {
  const Vec3 start{0.1, -0.1, 0};
  const Vec3 end{-0.7, -0.1, 0};
  const Curve arc = Curve::arc(start, end, {-0.3, -0.1, 0});
  EXPECT_EQ(arc.at(0).point(), start.point());
  EXPECT_EQ(arc.at(1).point(), end.point());
  EXPECT_EQ(arc.mapped({.origin = {0, 0, 0.1}}).end().point(), (Point{-0.7, -0.1, 0.1}));
}

TEST(Curve, bounds_are_tight) {
  const Box quarter = Curve::arc({2, 0, 0}, {0, 2, 0}, {}).bounds();
  expect_near(quarter.low, {0, 0, 0});
  expect_near(quarter.high, {2, 2, 0});
  const Box most = Curve::arc({0, -1, 0}, {-1, 0, 0}, {}).bounds();
  expect_near(most.low, {-1, -1, 0});
  expect_near(most.high, {1, 1, 0});
  // A circle in a plane that leans by 45 degrees about the x axis.
  const double s = std::sqrt(0.5);
  const Box leaning = Curve::circle({}, 1, {0, -s, s}, {1, 0, 0}).bounds();
  EXPECT_NEAR(leaning.high.x, 1, 1e-15);
  EXPECT_NEAR(leaning.high.y, s, 1e-15);
  EXPECT_NEAR(leaning.low.z, -s, 1e-15);
}

TEST(Curve, smooth_joints_are_told_from_kinks) {
  const Curve line = Curve::segment({-1, 0, 0}, {0, 0, 0});
  EXPECT_TRUE(is_smooth_joint(line, Curve::arc({0, 0, 0}, {1, 1, 0}, {0, 1, 0})));
  EXPECT_TRUE(is_smooth_joint(line, Curve::segment({0, 0, 0}, {5, 0, 0})));
  EXPECT_FALSE(is_smooth_joint(line, Curve::arc({0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 0, -1})));
  EXPECT_FALSE(is_smooth_joint(line, Curve::segment({0, 0, 0}, {5, 0.001, 0})));
}

}  // namespace
}  // namespace keenline::synth
