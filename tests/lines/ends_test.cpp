#include "keenline/lines/ends.h"

#include <gtest/gtest.h>

#include "support/straight_path.h"

namespace keenline {
namespace {

using test::straight_path;

constexpr Point x{1, 0, 0};
constexpr Point y{0, 1, 0};
constexpr Point z{0, 0, 1};

std::size_t size_of_group_with(const std::vector<std::vector<PathEnd>>& groups, std::size_t path,
                               bool at_back) {
  for (const auto& group : groups)
    for (const PathEnd& end : group)
      if (end.path == path && end.at_back == at_back) return group.size();
  return 0;
}

TEST(Ends, LinesApproachEachOtherWhereTheyShould) {
  const Approach at = approach_of({{1, 0, 0}, x, 1}, {{4, -3, 2}, y, 1});
  EXPECT_NEAR(at.first, 3, 1e-12);
  EXPECT_NEAR(at.second, 3, 1e-12);
  EXPECT_NEAR(at.miss, 2, 1e-12);
}

TEST(Ends, PlanesHaveACommonPoint) {
  Foot a;
  a.position = {5, 2, 3};
  a.normals = {y, z};
  Foot b;
  b.position = {1, 9, 3};
  b.normals = {x, z};
  const std::vector<const Foot*> feet{&a, &b};
  const CommonPoint common = common_point(feet);
  EXPECT_LT(distance(common.position, {1, 2, 3}), 0.02);
  EXPECT_LT(common.residual, 0.02);
  // Of one line it is any point; the mean is taken.
  const std::vector<const Foot*> one{&a};
  EXPECT_LT(distance(common_point(one).position, a.position), 1e-12);
}

TEST(Ends, ComeTogetherAcrossAGapAndAtACorner) {
  const std::vector<Path> paths{
      straight_path({0, 0, 0}, {20, 0, 0}, y, z), straight_path({24, 0, 0}, {40, 0, 0}, y, z),
      straight_path({42, 1, 0}, {42, 30, 0}, x, z), straight_path({42, 0, 3}, {42, 0, 30}, x, y)};
  const auto groups = gather_ends(paths);
  EXPECT_EQ(size_of_group_with(groups, 0, false), 1U);
  EXPECT_EQ(size_of_group_with(groups, 0, true), 2U);
  EXPECT_EQ(size_of_group_with(groups, 1, false), 2U);
  EXPECT_EQ(size_of_group_with(groups, 1, true), 3U);
  EXPECT_EQ(size_of_group_with(groups, 2, true), 1U);
}

TEST(Ends, TwoCornersNearEachOtherStayTwo) {
  // A face only four spacings wide between two edges that end on a third line's ends.
  const std::vector<Path> paths{
      straight_path({0, 1, 0}, {0, 20, 0}, x, z), straight_path({4, 1, 0}, {4, 20, 0}, x, z),
      straight_path({-1, 0, 0}, {-20, 0, 0}, y, z), straight_path({5, 0, 0}, {20, 0, 0}, y, z)};
  const auto groups = gather_ends(paths);
  EXPECT_EQ(size_of_group_with(groups, 0, false), 2U);
  EXPECT_EQ(size_of_group_with(groups, 1, false), 2U);
}

}  // namespace
}  // namespace keenline
