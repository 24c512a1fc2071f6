#include "keenline/synth/curve_network.h"

#include <gtest/gtest.h>

namespace keenline::synth {
namespace {

const Vec3 a{0, 0, 0};
const Vec3 b{1, 0, 0};
const Vec3 c{2, 0, 0};
const Vec3 d{3, 1, 0};

/// a, b and c in line, then a quarter turn to d, tangent at c.
std::vector<Curve> smooth_chain() {
  return {Curve::segment(b, c), Curve::segment(b, a), Curve::arc(c, d, {2, 1, 0})};
}

TEST(CurveNetwork, ends_come_once) {
  EXPECT_EQ(ends_of(smooth_chain()).size(), 4U);
  EXPECT_TRUE(ends_of(std::vector{Curve::circle({}, 1)}).empty());
}

TEST(CurveNetwork, corners_need_three_edges_or_a_turn) {
  EXPECT_TRUE(corners_of(smooth_chain()).empty());

  auto branching = smooth_chain();
  branching.push_back(Curve::segment(b, {1, 1, 0}));
  ASSERT_EQ(corners_of(branching).size(), 1U);
  EXPECT_EQ(corners_of(branching)[0].point(), b.point());

  const std::vector bent{Curve::segment(a, b), Curve::segment({1, 1, 0}, b)};
  ASSERT_EQ(corners_of(bent).size(), 1U);
  EXPECT_EQ(corners_of(bent)[0].point(), b.point());
}

TEST(CurveNetwork, smooth_chains_become_one_polyline) {
  const auto polylines = polylines_of(smooth_chain(), {}, 10);
  ASSERT_EQ(polylines.size(), 1U);
  const TruthCurve& line = polylines[0];
  EXPECT_FALSE(line.closed);
  // Straight pieces keep two vertices; a quarter turn takes 18 steps of 5 degrees.
  ASSERT_EQ(line.vertices.size(), 2U + 18 + 1);
  const bool forward = line.vertices.front() == a.point();
  EXPECT_EQ(line.vertices.front(), (forward ? a : d).point());
  EXPECT_EQ(line.vertices.back(), (forward ? d : a).point());
}

TEST(CurveNetwork, polylines_end_at_stops) {
  const std::vector stops{b};
  EXPECT_EQ(polylines_of(smooth_chain(), stops, 10).size(), 2U);
}

TEST(CurveNetwork, circles_and_closed_chains_are_closed) {
  const auto circles = polylines_of(std::vector{Curve::circle({}, 1)}, {}, 0.01);
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_TRUE(circles[0].closed);
  EXPECT_EQ(circles[0].vertices.size(), 629U);  // 2 pi / 0.01, rounded up

  const std::vector triangle{Curve::segment(a, b), Curve::segment(b, d), Curve::segment(d, a)};
  const auto rings = polylines_of(triangle, {}, 1);
  ASSERT_EQ(rings.size(), 1U);
  EXPECT_TRUE(rings[0].closed);
  EXPECT_EQ(rings[0].vertices.size(), 3U);

  const auto loops = polylines_of(triangle, std::vector{d}, 1);  // a loop from a corner to itself
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_TRUE(loops[0].closed);
  EXPECT_EQ(loops[0].vertices.front(), d.point());
}

}  // namespace
}  // namespace keenline::synth
