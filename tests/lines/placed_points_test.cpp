#include "keenline/lines/placed_points.h"

#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Numbers = std::vector<std::uint32_t>;

PlacedPoints placed(const std::vector<Point>& positions, double spacing, const std::vector<bool>& is_chosen) {
  PointCloud cloud;
  cloud.positions = positions;
  return place_points(cloud, NeighborSearch(cloud.positions), is_chosen, spacing);
}

PlacedPoints all_placed(const std::vector<Point>& positions, double spacing) {
  return placed(positions, spacing, std::vector<bool>(positions.size(), true));
}

TEST(PlacedPoints, AreTheChosenOnesInSpacingsAboutTheirMedian) {
  const PlacedPoints points =
      placed({{9, 9, 9}, {10, 0, 1}, {12, 4, 1}, {14, -4, 1}}, 0.5, {false, true, true, true});
  EXPECT_EQ(points.points, (Numbers{1, 2, 3}));
  EXPECT_EQ(points.frame.origin, (Point{12, 0, 1}));
  EXPECT_EQ(points.positions, (std::vector<Point>{{-4, 0, 0}, {0, 8, 0}, {4, -8, 0}}));
  EXPECT_EQ(points.copies, (Numbers{1, 1, 1}));
}

TEST(PlacedPoints, AStrayPointLeavesTheOthersTheirDigits) {
  std::vector<Point> positions{{1e20, -1e20, 1e20}};
  for (int i = 0; i < 5; ++i) positions.push_back({5e6 + 0.001 * i, 1e7, 100});
  const PlacedPoints points = all_placed(positions, 0.001);
  ASSERT_EQ(points.size(), 6U);
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
    EXPECT_NEAR(distance(points.positions[i], points.positions[i + 1]), 1, 1e-5);
}

TEST(PlacedPoints, OfThoseThatCoincideTheFirstChosenStandsForAll) {
  const PlacedPoints points = placed({{1, 0, 0}, {2, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}}, 1,
                                     {false, true, true, true, true, true});
  EXPECT_EQ(points.points, (Numbers{1, 2, 5}));
  EXPECT_EQ(points.copies, (Numbers{2, 2, 1}));
}

TEST(PlacedPoints, HoldNothingThatADrawingCannot) {
  EXPECT_EQ(all_placed({{nan, 0, 0}, {1e200, 0, 0}, {1, 2, 3}}, 1).points, Numbers{2});
  EXPECT_EQ(all_placed({{nan, 0, 0}}, 1).size(), 0U);
  EXPECT_EQ(all_placed({}, 1).size(), 0U);
  // A spacing that turns lengths into more than can be drawn.
  EXPECT_EQ(all_placed({{0, 0, 0}, {1, 0, 0}}, 1e-310).points, Numbers{0});
  for (const double spacing : {0.0, -1.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(all_placed({{1, 2, 3}}, spacing).size(), 0U);
}

}  // namespace
}  // namespace keenline
