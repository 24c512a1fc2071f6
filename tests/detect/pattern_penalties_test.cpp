#include "keenline/detect/pattern_penalties.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/ideal_neighborhoods.h"
#include "support/motion.h"

namespace keenline {
namespace {

PointPenalties penalties_of(const std::vector<Point>& neighbors, const Point& point = {0, 0, 0}) {
  std::vector<Point> positions{point};
  positions.insert(positions.end(), neighbors.begin(), neighbors.end());
  std::vector<std::uint32_t> indices(neighbors.size());
  std::iota(indices.begin(), indices.end(), 1U);
  LocalOffsets local;
  std::vector<double> angles;
  return point_penalties(positions, 0, indices, local, angles);
}

TEST(PatternPenalties, OfIdealEdgesAreThoseOfTheIntegrals) {
  const auto expect = [](double degrees, double crease, double corner, double bend) {
    const PointPenalties found = penalties_of(test::ideal_edge(degrees));
    EXPECT_NEAR(found.crease, crease, 0.006) << degrees;
    EXPECT_NEAR(found.corner, corner, 0.006) << degrees;
    EXPECT_NEAR(found.bend, bend, 0.006) << degrees;
    EXPECT_NEAR(found.distance, 2.0 / 3, 1e-3) << degrees;
    EXPECT_NEAR(std::abs(found.direction[0]), 1, 1e-6) << degrees;
  };
  expect(60, 0.54, 0.79, 1.10);
  expect(90, 0.36, 0.86, 0.90);
  expect(120, 0.68, 0.93, 0.64);
  expect(138.19, 0.84, 0.96, 0.45);
}

TEST(PatternPenalties, OfAPlaneABorderAndACorner) {
  const PointPenalties plane = penalties_of(test::ideal_edge(180));
  EXPECT_NEAR(plane.crease, 1, 0.002);
  EXPECT_NEAR(plane.corner, 1, 1e-9);
  EXPECT_NEAR(plane.bend, 0, 1e-9);
  EXPECT_LT(plane.gap_deg, 10);
  const PointPenalties border = penalties_of(test::ideal_border());
  EXPECT_NEAR(border.border, (0.25 - 2 * 0.0699) / 0.25, 0.002);
  EXPECT_NEAR(border.gap_deg, 180, 1);
  EXPECT_NEAR(border.bend, 0, 1e-9);
  EXPECT_NEAR(penalties_of(test::ideal_cube_corner()).corner, 0.71, 0.003);
}

TEST(PatternPenalties, NeighborsInOnePlaceAreNothing) {
  const PointPenalties found = penalties_of({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(found.bend, 0);
  EXPECT_EQ(found.crease, 1);
  EXPECT_EQ(found.corner, 1);
  EXPECT_EQ(found.border, 1);
  EXPECT_EQ(penalties_of({{0, 0, 0}, {0, 0, 0}}).distance, 0) << "all of them at the point";
}

TEST(PatternPenalties, TurnAndScaleWithThePoints) {
  const std::vector<Point> edge = test::ideal_edge(110);
  const PointPenalties before = penalties_of(edge);
  std::vector<Point> moved;
  const Point shift{1e4, -2e4, 3e4};
  for (const Point& p : edge) moved.push_back(sum(scaled(0.01, test::turned(p)), shift));
  const PointPenalties after = penalties_of(moved, shift);
  EXPECT_NEAR(after.bend, before.bend, 1e-6);
  EXPECT_NEAR(after.crease, before.crease, 1e-6);
  EXPECT_NEAR(after.corner, before.corner, 1e-6);
  EXPECT_NEAR(after.distance, 0.01 * before.distance, 1e-8);
  EXPECT_NEAR(std::abs(dot(after.direction, test::turned(before.direction))), 1, 1e-9);
}

TEST(PatternPenalties, OfEdgesAreLeastAlongTheCrease) {
  const PointPenalties edge = penalties_of(test::ideal_edge(90));
  const PenaltyRule rule;
  const Point along{1, 0, 0};
  const Point across{0, 0, 1};
  EXPECT_NEAR(edge_crease_penalty(edge, edge, along, rule), 0.3 * 2 * 0.36, 0.005);
  EXPECT_NEAR(edge_crease_penalty(edge, edge, across, rule), 0.3 * 2 * 0.86, 0.005);
  EXPECT_NEAR(crease_penalty(edge, rule), 0.3 * 0.36, 0.003);
  const PointPenalties plane = penalties_of(test::ideal_edge(180));
  EXPECT_NEAR(edge_crease_penalty(plane, plane, along, rule), 2, 0.01);
  EXPECT_NEAR(crease_penalty(plane, rule), 1, 0.01);

  const PenaltyRule paper{0.2, 1.8, true};
  EXPECT_NEAR(edge_crease_penalty(edge, edge, along, paper), 0.2 * 2 * 0.5 + 0.8 * 2 * 0.36, 0.01);
  EXPECT_NEAR(edge_crease_penalty(edge, edge, across, paper), 0.2 * 2 * 0.5, 0.01) << "why it is not used";
}

TEST(PatternPenalties, BordersAreLeastAlongTheRim) {
  const PointPenalties rim = penalties_of(test::ideal_border());
  const PenaltyRule rule;
  EXPECT_NEAR(edge_border_penalty(rim, rim, {1, 0, 0}, rule), 0.5 + 0.44, 0.01);
  EXPECT_NEAR(edge_border_penalty(rim, rim, {0, 1, 0}, rule), 0.5 + 1, 0.01);
}

TEST(PatternPenalties, WaysAreTheSameFromBothEnds) {
  const std::vector<Point> positions{{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}};
  std::vector<PointPenalties> penalties(2);
  penalties[0].distance = 0.5;
  penalties[1].distance = 1.5;
  LocalOffsets local;
  const Way way = way_between(positions, penalties, 0, 1, local);
  EXPECT_NEAR(way.direction[0], 1, 1e-15);
  EXPECT_NEAR(way.relative_length, 1, 1e-12);
  const Way back = way_between(positions, penalties, 1, 0, local);
  EXPECT_EQ(back.direction, way.direction);
  EXPECT_EQ(back.relative_length, way.relative_length);
}

}  // namespace
}  // namespace keenline
