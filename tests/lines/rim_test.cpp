#include "keenline/lines/rim.h"

#include <vector>

#include <gtest/gtest.h>

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

/// A plane side whose x axis is x.
const Side flat{.surface = {}, .inward = {1, 0, 0}, .residual = 0.02, .support = 50};

double reach_of(const Side& rim, double y) { return rim.surface.above({0, y, 0}); }

TEST(Rim, GoesThroughTheOutermostRowOfALattice) {
  std::vector<Point> offsets;
  for (int x = 0; x < 6; ++x)
    for (int y = -8; y <= 8; ++y) offsets.push_back({0.5 * x - 0.25, 0.5 * y, 0});
  const auto rim = rim_of(flat, offsets);
  ASSERT_TRUE(rim);
  // The surface lies behind it: where the rim is at -0.25, the origin is 0.25 inside.
  EXPECT_NEAR(reach_of(*rim, 0), -0.25, 1e-12);
  EXPECT_NEAR(reach_of(*rim, 3), -0.25, 1e-12);
  EXPECT_EQ(rim->surface.normal({}), (Point{-1, 0, 0}));
  EXPECT_EQ(rim->inward, (Point{0, 0, -1}));
}

TEST(Rim, IsHalfWayUnbiasedOnRandomPoints) {
  double sum = 0;
  constexpr int trials = 200;
  for (unsigned trial = 0; trial < trials; ++trial) {
    std::vector<Point> offsets;
    for (const Point& p : test::random_points(48, trial))
      offsets.push_back({6 * p[0], 8 * p[1] - 4, 0.02 * p[2]});  // one per unit of area
    const auto rim = rim_of(flat, offsets);
    ASSERT_TRUE(rim);
    sum += reach_of(*rim, 0);
  }
  EXPECT_NEAR(sum / trials, 0, 0.15);  // of 0.6 that the outermost points fall short
}

TEST(Rim, FollowsASlantedEnd) {
  std::vector<Point> offsets;
  for (int row = 0; row < 4; ++row)
    for (int y = -16; y <= 16; ++y) offsets.push_back({0.3 * row + 0.2 * 0.25 * y, 0.25 * y, 0});
  const auto rim = rim_of(flat, offsets);
  ASSERT_TRUE(rim);
  EXPECT_NEAR(reach_of(*rim, 2) - reach_of(*rim, -2), 0.8, 0.1);
}

TEST(Rim, OtherSheetsHaveNoPartInIt) {
  std::vector<Point> offsets;
  for (int x = 0; x < 6; ++x)
    for (int y = -8; y <= 8; ++y) {
      offsets.push_back({0.5 * x, 0.5 * y, 0});
      offsets.push_back({0.5 * x - 3, 0.5 * y, 2});
    }
  const auto rim = rim_of(flat, offsets);
  ASSERT_TRUE(rim);
  EXPECT_NEAR(reach_of(*rim, 0), 0, 1e-12);
}

TEST(Rim, NeedsPointsAlongIt) {
  EXPECT_FALSE(rim_of(flat, {}));
  EXPECT_FALSE(rim_of(flat, std::vector<Point>(50, Point{1, 0, 0})));
}

}  // namespace
}  // namespace keenline
