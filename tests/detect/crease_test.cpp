#include "keenline/detect/crease.h"

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/detect/faces.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A square lattice of side 1 on two half planes that meet at x = 0 under an exterior angle of `fold_deg`,
/// seen from a point of the first at x = -distance, which is the origin of the map.
GaussMap fold_seen_from(double distance, double fold_deg, std::vector<double> rows_of_second) {
  std::vector<Point> positions{{-distance, 0, 0}};
  const double c = std::cos(fold_deg * degree);
  const double s = std::sin(fold_deg * degree);
  for (const int y : {-2, -1, 0, 1, 2}) {
    for (const double x : {1.0, 2.0}) positions.push_back({-distance - x, static_cast<double>(y), 0});
    for (const double x : rows_of_second) positions.push_back({x * c, static_cast<double>(y), -x * s});
  }
  std::vector<std::uint32_t> neighbors(positions.size() - 1);
  std::iota(neighbors.begin(), neighbors.end(), 1U);
  GaussMap map(0.001, no_progress());
  map.collect(positions, positions[0], neighbors);
  return map;
}

/// As find_faces() would have them where the faces scatter.
Face face(double x, double y, double z) { return {{x, y, z}, 8 * 728.0}; }

class CreaseOf : public testing::TestWithParam<int> {};

TEST_P(CreaseOf, TwoPlanesIsWhereTheyMeet) {
  const double fold_deg = GetParam();
  const double distance = 0.75;
  const GaussMap map = fold_seen_from(distance, fold_deg, {1, 2, 3});
  const Face first = face(0, 0, 1);
  const Face second = face(std::sin(fold_deg * degree), 0, std::cos(fold_deg * degree));
  const auto crease = first_crease(map, std::array{first, second});
  ASSERT_TRUE(crease);
  // The map scales offsets by a power of two.
  const double scale = map.lengths()[0] / std::hypot(1, 2);
  EXPECT_NEAR(crease->distance, distance * scale, 1e-9);
  EXPECT_NEAR(crease->foot[0], distance * scale, 1e-9);
  EXPECT_NEAR(std::abs(crease->direction[1]), 1, 1e-9);
  EXPECT_NEAR(crease->scatter, 0, 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Folds, CreaseOf, testing::Values(30, 60, 90, 120));

TEST(Crease, OnePlaneHasNone) {
  const GaussMap map = fold_seen_from(0.75, 0, {1, 2, 3});
  EXPECT_FALSE(first_crease(map, std::array{face(0, 0, 1), face(0, 0, 1)}));
}

TEST(Crease, ARowIsNoPlane) {
  EXPECT_FALSE(first_crease(fold_seen_from(0.75, 90, {1}), std::array{face(0, 0, 1), face(1, 0, 0)}));
}

TEST(Crease, NeighboursOfAThirdFaceDoNotCount) {
  const auto map = fold_seen_from(0.75, 90, {1, 2, 3});
  // Of equally near faces the last takes them.
  EXPECT_TRUE(first_crease(map, std::array{face(0, 0, 1), face(1, 0, 0)}));
  EXPECT_FALSE(first_crease(map, std::array{face(0, 0, 1), face(1, 0, 0), face(1, 0, 0)}));
}

/// Lattices of `x`, `y` and `z` rows of three points on the coordinate planes across these axes, seen from
/// where they meet.
GaussMap corner_of(int x, int y, int z) {
  std::vector<Point> positions{{0, 0, 0}};
  for (int i = 1; i <= 3; ++i) {
    for (int row = 1; row <= x; ++row) positions.push_back({0, 1.0 * row, 1.0 * i});
    for (int row = 1; row <= y; ++row) positions.push_back({1.0 * row, 0, 1.0 * i});
    for (int row = 1; row <= z; ++row) positions.push_back({1.0 * row, 1.0 * i, 0});
  }
  std::vector<std::uint32_t> neighbors(positions.size() - 1);
  std::iota(neighbors.begin(), neighbors.end(), 1U);
  GaussMap map(0.001, no_progress());
  map.collect(positions, positions[0], neighbors);
  return map;
}

TEST(Corner, IsWhereThreeFacesWithNeighboursMeet) {
  const std::array faces{face(1, 0, 0), face(0, 1, 0), face(0, 0, 1)};
  EXPECT_TRUE(make_corner(corner_of(2, 2, 2), faces));
  EXPECT_TRUE(make_corner(corner_of(3, 3, 1), faces));
  // An edge: nobody lies on the third.
  EXPECT_FALSE(make_corner(corner_of(3, 3, 0), faces));
  EXPECT_FALSE(make_corner(corner_of(2, 2, 2), std::span(faces).first(2)));
  const double root = std::sqrt(0.5);
  const std::array between{face(1, 0, 0), face(0, 1, 0), face(root, root, 0), face(0, 0, 1)};
  EXPECT_TRUE(make_corner(corner_of(2, 2, 2), between));
  EXPECT_FALSE(make_corner(corner_of(3, 3, 0), between));
}

TEST(Corner, TakesNormalsThatSpanSpace) {
  const double root = std::sqrt(0.5);
  const auto map = corner_of(3, 3, 3);
  EXPECT_FALSE(make_corner(map, std::array{face(1, 0, 0), face(0, 1, 0), face(root, root, 0)}));
}

TEST(Crease, APointIsBesideItWhereOthersAreNearer) {
  const std::array faces{face(0, 0, 1), face(1, 0, 0)};
  EXPECT_TRUE(is_beside_crease(fold_seen_from(0.8, 90, {0.1, 1.1, 2.1}), faces));
  // Nobody lies nearer.
  EXPECT_FALSE(is_beside_crease(fold_seen_from(0.8, 90, {1.8, 2.8, 3.8}), faces));
  // It is the nearest row itself.
  EXPECT_FALSE(is_beside_crease(fold_seen_from(0.1, 90, {0.9, 1.9, 2.9}), faces));
  EXPECT_FALSE(is_beside_crease(fold_seen_from(0, 90, {1, 2, 3}), faces));
}

TEST(Crease, APointOnBothFacesIsOnIt) {
  const GaussMap map = fold_seen_from(0.8, 90, {0.1, 1.1, 2.1});
  std::array faces{face(0, 0, 1), face(1, 0, 0)};
  faces[0].birth = 3 * 728;
  EXPECT_TRUE(is_beside_crease(map, faces));
  faces[1].birth = 3 * 728;
  EXPECT_FALSE(is_beside_crease(map, faces));
}

}  // namespace
}  // namespace keenline
