#include "keenline/neighborhood/surroundings.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/nearest_by_force.h"
#include "support/uneven_clouds.h"

namespace keenline {
namespace {

void expect_nearest(Surroundings& surroundings, const std::vector<Point>& points, const BoxTree& tree,
                    std::uint32_t location, std::size_t count) {
  const std::uint32_t point = tree.first_point_at(location);
  const auto found = surroundings.nearest(tree.position_of(point), location);
  const auto expected = test::nearest_by_force(points, point, count);
  ASSERT_GE(found.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(found[i].point, expected[i]) << "neighbour " << i << " of point " << point;
    ASSERT_EQ(tree.first_point_at(found[i].location), expected[i]);
  }
}

bool has_copies(const std::vector<Point>& points) {
  return BoxTree(points, no_progress()).has_coincident_points();
}

/// Boxes of all sizes: every node of the tree, its first and last location.
TEST(Surroundings, FindTheNearestFromAnyBox) {
  for (const auto& [name, points] : test::uneven_clouds()) {
    if (has_copies(points)) continue;  // locations are not points there
    SCOPED_TRACE(name);
    const BoxTree tree(points, no_progress());
    for (const std::size_t count : {3U, 16U, 60U}) {
      Surroundings surroundings(tree, count);
      for (std::uint32_t n = 0; n < tree.nodes().size(); n += 3) {
        surroundings.enter(tree.nodes()[n].box, tree.nodes()[n].begin);
        expect_nearest(surroundings, points, tree, tree.nodes()[n].begin, count);
        expect_nearest(surroundings, points, tree, tree.end_of(n) - 1, count);
      }
    }
  }
}

TEST(Surroundings, DoNotMissWhatSinglePrecisionCannotTellApart) {
  // Around the origin on a circle of radius 1, nearer by one part in 10^12 the larger the index.
  std::vector<Point> points{{0, 0, 0}};
  for (int i = 1; i <= 200; ++i) {
    const double angle = i * 2.399963;
    const double radius = 1 - i * 1e-12;
    points.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  const BoxTree tree(points, no_progress());
  Surroundings surroundings(tree, 16);
  const std::uint32_t middle = *tree.location_of(0);
  surroundings.enter({{-1, -1, 0}, {1, 1, 0}}, middle);
  expect_nearest(surroundings, points, tree, middle, 16);
  EXPECT_EQ(surroundings.nearest(points[0], middle)[0].point, 200U);
}

TEST(Surroundings, WorkAtEveryScale) {
  for (const int exponent : {-390, -100, 100, 490}) {
    std::vector<Point> points = test::random_points(300, 3);
    for (Point& p : points)
      for (double& c : p) c = std::ldexp(c, exponent);
    const BoxTree tree(points, no_progress());
    Surroundings surroundings(tree, 16);
    surroundings.enter(tree.nodes()[0].box, 0);
    for (std::uint32_t location = 0; location < 300; location += 17)
      expect_nearest(surroundings, points, tree, location, 16);
  }
}

TEST(Surroundings, GiveAllWhereThereAreNoMore) {
  const std::vector<Point> points = test::random_points(10, 4);
  const BoxTree tree(points, no_progress());
  Surroundings surroundings(tree, 255);
  surroundings.enter(tree.nodes()[0].box, 0);
  EXPECT_EQ(surroundings.nearest(tree.position_of(tree.first_point_at(0)), 0).size(), 9U);

  const std::vector<Point> one{{1, 2, 3}};
  const BoxTree lonely(one, no_progress());
  Surroundings nothing(lonely, 16);
  nothing.enter(lonely.nodes()[0].box, 0);
  EXPECT_TRUE(nothing.nearest(one[0], 0).empty());
}

}  // namespace
}  // namespace keenline
