#include "keenline/report/report_grid.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

void expect_near_their_places(const std::vector<Point>& positions) {
  const ReportGrid grid = grid_for(positions);
  double widest = 0;
  for (const Point& p : positions) {
    const std::array<std::int32_t, 3> place = place_in(grid, p);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_GE(place[axis], 0);
      EXPECT_LE(place[axis], std::int32_t{ReportGrid::last_place});
      widest = std::max(widest, static_cast<double>(place[axis]));
      const double back = grid.origin[axis] + grid.step * place[axis];
      // Half a step, and what doubles of this size cannot tell apart.
      EXPECT_LE(std::abs(back - p[axis]), grid.step * 0.5 + std::abs(p[axis]) * 0x1p-51);
    }
  }
  EXPECT_GE(widest, double{ReportGrid::last_place} / 2 - 1) << "a finer grid would do";
}

TEST(ReportGrid, PositionsComeBackWithinHalfAStep) {
  std::mt19937 random(3);
  for (const double scale : {1.0, 1e-30, 123.456, 1e30, 4e307}) {
    for (const double offset : {0.0, -0.5, 1e4}) {
      if (offset * scale > 1e308 / 2) continue;
      std::vector<Point> positions(200);
      for (Point& p : positions)
        for (double& x : p) x = (offset + 0x1p-32 * static_cast<double>(random())) * scale;
      expect_near_their_places(positions);
    }
  }
}

TEST(ReportGrid, FarFromTheOriginNothingIsLost) {
  const std::vector<Point> positions{{32500000.123, 5980000.456, 99.5}, {32500010.125, 5980003.5, 100}};
  const ReportGrid grid = grid_for(positions);
  EXPECT_LT(grid.step, 1e-5);
  expect_near_their_places(positions);
}

TEST(ReportGrid, TheLargestNumbersAreHeld) {
  constexpr double largest = std::numeric_limits<double>::max();
  const std::vector<Point> positions{{-largest, 0, largest}, {largest, 1e30, -largest}};
  const ReportGrid grid = grid_for(positions);
  EXPECT_TRUE(std::isfinite(grid.step));
  const auto low = place_in(grid, positions[0]);
  const auto high = place_in(grid, positions[1]);
  EXPECT_EQ(low[0], 0);
  EXPECT_GT(high[0], std::int32_t{ReportGrid::last_place} / 2);
  EXPECT_EQ(high[0], low[2]);
}

TEST(ReportGrid, NothingAndOnePlace) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Point> none{{nan, 0, 0}};
  EXPECT_EQ(grid_for(none).origin, Point{});
  EXPECT_EQ(grid_for({}).step, 1);
  const std::vector<Point> one{{1e30, -4, 5e-324}, {1e30, -4, 5e-324}};
  const ReportGrid grid = grid_for(one);
  EXPECT_EQ(grid.origin, one[0]);
  EXPECT_EQ(place_in(grid, one[1]), (std::array<std::int32_t, 3>{}));
  // Closer together than a step can be.
  const std::vector<Point> tiny{{0, 0, 0}, {5e-324, 0, 1e-310}};
  EXPECT_EQ(place_in(grid_for(tiny), tiny[1]), (std::array<std::int32_t, 3>{}));
}

TEST(ReportGrid, WhatIsOutsideHasAPlaceToo) {
  const std::vector<Point> positions{{0, 0, 0}, {1, 1, 1}};
  const ReportGrid grid = grid_for(positions);
  EXPECT_EQ(place_in(grid, {-grid.step, 0, 2 * grid.step}), (std::array<std::int32_t, 3>{-1, 0, 2}));
  EXPECT_EQ(place_in(grid, {1e300, 0, -1e300}), (std::array<std::int32_t, 3>{2147483647, 0, -2147483647}));
}

}  // namespace
}  // namespace keenline
