#include "keenline/neighborhood/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

Box box_of(const BoxTree& tree, std::uint32_t begin, std::uint32_t end) {
  Box box{tree.position_of(tree.first_point_at(begin)), tree.position_of(tree.first_point_at(begin))};
  for (std::uint32_t location = begin; location < end; ++location)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double c = tree.position_of(tree.first_point_at(location))[axis];
      box.low[axis] = std::min(box.low[axis], c);
      box.high[axis] = std::max(box.high[axis], c);
    }
  return box;
}

double diagonal(const Box& box) {
  return std::hypot(box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]);
}

/// Every node's box is that of its locations, and its children share these out.
void expect_sound(const BoxTree& tree) {
  const auto nodes = tree.nodes();
  ASSERT_EQ(nodes[0].begin, 0U);
  ASSERT_EQ(nodes[0].next, nodes.size());
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    ASSERT_LT(nodes[n].begin, tree.end_of(n));
    const Box expected = box_of(tree, nodes[n].begin, tree.end_of(n));
    ASSERT_EQ(nodes[n].box.low, expected.low) << "node " << n;
    ASSERT_EQ(nodes[n].box.high, expected.high) << "node " << n;
    if (tree.is_leaf(n)) {
      ASSERT_LE(tree.end_of(n) - nodes[n].begin, BoxTree::leaf_capacity);
      continue;
    }
    const std::uint32_t second = nodes[n + 1].next;
    ASSERT_EQ(nodes[n + 1].begin, nodes[n].begin);
    ASSERT_EQ(nodes[second].begin, tree.end_of(n + 1));
    ASSERT_EQ(nodes[second].next, nodes[n].next);
  }
}

TEST(BoxTree, IsSoundForAnyCloud) {
  for (const auto& [name, points] : test::uneven_clouds()) {
    SCOPED_TRACE(name);
    const BoxTree tree(points, no_progress());
    expect_sound(tree);
    std::vector<std::uint32_t> all(tree.points().begin(), tree.points().end());
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> expected(points.size());
    std::iota(expected.begin(), expected.end(), 0U);
    EXPECT_EQ(all, expected);
  }
}

TEST(BoxTree, GathersCoincidentPoints) {
  const std::vector<Point> points{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {5, 5, 5}, {-0.0, 0, -0.0}, {1, 2, 3}};
  const BoxTree tree(points, no_progress());
  ASSERT_EQ(tree.location_count(), 3U);
  ASSERT_TRUE(tree.has_coincident_points());
  for (std::uint32_t location = 0; location < 3; ++location) {
    const auto there = tree.points_at(location);
    const std::vector<std::uint32_t> found(there.begin(), there.end());
    EXPECT_EQ(tree.first_point_at(location), found.front());
    const auto expected = found.front() == 0   ? std::vector<std::uint32_t>{0, 2, 5}
                          : found.front() == 1 ? std::vector<std::uint32_t>{1, 4}
                                               : std::vector<std::uint32_t>{3};
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxTree, KnowsWhereEachPointIs) {
  for (auto [name, points] : test::uneven_clouds()) {
    SCOPED_TRACE(name);
    points[7][1] = std::numeric_limits<double>::quiet_NaN();
    const BoxTree tree(points, no_progress());
    EXPECT_FALSE(tree.location_of(7));
    for (std::uint32_t point = 8; point < points.size(); point += 13) {
      const auto location = tree.location_of(point);
      ASSERT_TRUE(location);
      const auto there = tree.points_at(*location);
      EXPECT_TRUE(std::find(there.begin(), there.end(), point) != there.end());
    }
  }
}

TEST(BoxTree, MakesSmallLeavesWhereThePointsAre) {
  // A lattice with unit spacing whose extent an outlier hides: a leaf of 24 is never longer than 24.
  std::vector<Point> points;
  for (int i = 0; i < 2500; ++i) points.push_back({double(i % 50), double(i / 50), 0});
  points.push_back({1e15, 1e15, 1e15});
  const BoxTree tree(points, no_progress());
  for (std::uint32_t n = 0; n < tree.nodes().size(); ++n) {
    if (!tree.is_leaf(n)) continue;
    const double length = diagonal(tree.nodes()[n].box);
    EXPECT_TRUE(length < 12 || length > 1e14) << length;
  }
}

TEST(BoxTree, IsTheSameForAnyNumberOfThreads) {
  const std::vector<Point> points = test::random_points(40000, 2);
  const BoxTree expected(points, no_progress());
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const BoxTree tree(points, no_progress());
    EXPECT_TRUE(std::equal(tree.points().begin(), tree.points().end(), expected.points().begin()));
    ASSERT_EQ(tree.nodes().size(), expected.nodes().size());
    for (std::size_t n = 0; n < tree.nodes().size(); ++n) {
      ASSERT_EQ(tree.nodes()[n].begin, expected.nodes()[n].begin);
      ASSERT_EQ(tree.nodes()[n].box.high, expected.nodes()[n].box.high);
    }
  }
}

TEST(BoxTree, MayBeEmpty) {
  const std::vector<Point> none;
  EXPECT_TRUE(BoxTree(none, no_progress()).nodes().empty());
  const std::vector<Point> unusable(30, Point{0, std::numeric_limits<double>::infinity(), 0});
  const BoxTree tree(unusable, no_progress());
  EXPECT_TRUE(tree.nodes().empty());
  EXPECT_EQ(tree.location_count(), 0U);
}

}  // namespace
}  // namespace keenline
