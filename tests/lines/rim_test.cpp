#include "keenline/lines/rim.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

/// A plane side whose x axis is x.
const Side flat{.surface = {}, .inward = {1, 0, 0}, .residual = 0.02, .support = 50};

double reach_of(const Side& rim, double y) { return rim.surface.above({0, y, 0}); }

/// A lattice of spacing 1 behind x = level(y).
template <typename Level>
std::vector<Point> lattice_behind(const Level& level) {
  std::vector<Point> offsets;
  for (int row = 0; row < 6; ++row)
    for (int y = -7; y <= 7; ++y) offsets.push_back({level(y) + row, static_cast<double>(y), 0});
  return offsets;
}

TEST(Rim, IsAStraightLineBeforeAllPoints) {
  const auto rim = rim_of(flat, lattice_behind([](double y) { return 0.3 + 0.2 * y; }));
  ASSERT_TRUE(rim);
  // The area of two points before the outermost row; positive values are beyond the rim.
  EXPECT_NEAR(reach_of(*rim, 0), 0.3 - 2.0 / 14, 1e-12);
  EXPECT_NEAR(reach_of(*rim, 3), 0.9 - 2.0 / 14, 1e-12);
  EXPECT_NEAR(rim->surface.normal({})[0], -1 / std::sqrt(1.04), 1e-12);
  EXPECT_EQ(rim->inward, (Point{0, 0, -1}));
}

TEST(Rim, IsAParabolaWhereALineWouldLeaveTooMuchEmpty) {
  for (const double bend : {-0.04, 0.04}) {
    const auto rim = rim_of(flat, lattice_behind([&](double y) { return bend * y * y; }));
    ASSERT_TRUE(rim);
    EXPECT_NEAR(rim->surface.height[3], -bend, 0.002);
    EXPECT_NEAR(reach_of(*rim, 0), -3.0 / 14, 0.05);
  }
  const auto hardly = rim_of(flat, lattice_behind([](double y) { return 0.002 * y * y; }));
  ASSERT_TRUE(hardly);
  EXPECT_EQ(hardly->surface.height[3], 0);
}

TEST(Rim, IsUnbiasedOnRandomPoints) {
  double sum = 0;
  double squares = 0;
  constexpr int trials = 200;
  for (unsigned trial = 0; trial < trials; ++trial) {
    std::vector<Point> offsets;
    for (const Point& p : test::random_points(112, trial))
      offsets.push_back({8 * p[0], 14 * p[1] - 7, 0.02 * p[2]});  // one per unit of area
    const auto rim = rim_of(flat, offsets);
    ASSERT_TRUE(rim);
    sum += reach_of(*rim, 0);
    squares += reach_of(*rim, 0) * reach_of(*rim, 0);
  }
  EXPECT_NEAR(sum / trials, 0, 0.05);
  EXPECT_LT(std::sqrt(squares / trials), 0.2);
}

TEST(Rim, OtherSheetsHaveNoPartInIt) {
  std::vector<Point> offsets = lattice_behind([](double) { return 0.0; });
  const auto alone = rim_of(flat, offsets);
  for (int y = -7; y <= 7; ++y) {
    offsets.push_back({-2, static_cast<double>(y), 2});  // above
    offsets.push_back({-4, static_cast<double>(y), 0});  // beyond a gap
  }
  const auto rim = rim_of(flat, offsets);
  ASSERT_TRUE(alone && rim);
  EXPECT_EQ(reach_of(*rim, 0), reach_of(*alone, 0));
}

TEST(Rim, NeedsPointsAlongIt) {
  EXPECT_FALSE(rim_of(flat, {}));
  EXPECT_FALSE(rim_of(flat, std::vector<Point>(50, Point{1, 0, 0})));
  EXPECT_FALSE(rim_of(flat, std::vector<Point>{{0, -1, 0}, {0, 0, 0}, {0, 1, 0}}));
}

}  // namespace
}  // namespace keenline
