#include "keenline/detect/gauss_map.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "keenline/progress.h"

namespace keenline {
namespace {

/// A point at the origin and `count` others on a circle in the plane z = 0.
std::vector<Point> circle(int count, double radius = 1) {
  std::vector<Point> positions{{0, 0, 0}};
  for (int i = 0; i < count; ++i) {
    const double angle = 0.1 + 2 * 3.14159265358979 * i / count;
    positions.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return positions;
}

std::vector<std::uint32_t> all_but_first(const std::vector<Point>& positions) {
  std::vector<std::uint32_t> neighbors(positions.size() - 1);
  std::iota(neighbors.begin(), neighbors.end(), 1U);
  return neighbors;
}

TEST(GaussMapOfAPoint, OneLinePerPairOfNeighbours) {
  const auto positions = circle(7);
  GaussMap map(0, no_progress());
  map.collect(positions, positions[0], all_but_first(positions));
  ASSERT_EQ(map.lines().count, 21);
  for (int i = 0; i < 21; ++i) EXPECT_FLOAT_EQ(std::abs(map.lines().z[i]), 1);
  EXPECT_DOUBLE_EQ(std::abs(map.common_direction()[2]), 1);
  map.cluster();
  ASSERT_EQ(map.merges().size(), 20U);
  for (const kernels::Merge& merge : map.merges()) EXPECT_EQ(merge.height, 0);
  map.cluster(5);
  EXPECT_EQ(map.merges().size(), 16U);
  map.clear();
  EXPECT_EQ(map.lines().count, 0);
  EXPECT_TRUE(map.merges().empty());
}

TEST(GaussMapOfAPoint, SlenderTrianglesAreLeftOut) {
  // Twelve on a circle: 30 degrees apart, of which the opposite ones have no normal at all.
  const auto positions = circle(12);
  GaussMap all(1e-9, no_progress());
  all.collect(positions, positions[0], all_but_first(positions));
  EXPECT_EQ(all.lines().count, 66 - 6);
  GaussMap wide(0.51, no_progress());  // sin 30 = 0.5
  wide.collect(positions, positions[0], all_but_first(positions));
  EXPECT_EQ(wide.lines().count, 66 - 6 - 24);
}

TEST(GaussMapOfAPoint, TheBestTrianglesAreThoseNearestToEquilateral) {
  // Twelve on a circle: 60 degrees apart are those two steps apart, then come those of one and three.
  const auto positions = circle(12);
  const auto lines_of_best = [&](int triangles) {
    GaussMap map(0.001, no_progress(), triangles);
    map.collect(positions, positions[0], all_but_first(positions));
    return map.lines().count;
  };
  EXPECT_EQ(lines_of_best(3), 12);  // equal ones stay together
  EXPECT_EQ(lines_of_best(12), 12);
  EXPECT_EQ(lines_of_best(13), 24);
  EXPECT_EQ(lines_of_best(66), 60);
  EXPECT_EQ(lines_of_best(1000), 60);
}

TEST(GaussMapOfAPoint, ScaleAndPlaceAreLost) {
  const auto unit = circle(9);
  GaussMap expected(0.001, no_progress());
  expected.collect(unit, unit[0], all_but_first(unit));
  for (const double scale : {0x1p-900, 0x1p-3, 0x1p900, 0x1.8p1022}) {
    const auto scaled = circle(9, scale);
    GaussMap map(0.001, no_progress());
    map.collect(scaled, scaled[0], all_but_first(scaled));
    ASSERT_EQ(map.lines().count, expected.lines().count) << scale;
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(map.lengths()[i] / map.lengths()[0], 1, 1e-12);
  }
}

TEST(GaussMapOfAPoint, MemoryIsThatOfThePairs) {
  EXPECT_EQ(GaussMap::memory(16), 120U * 144U * 4U);
  EXPECT_EQ(GaussMap::memory(40), 780U * 784U * 8U);
}

}  // namespace
}  // namespace keenline
