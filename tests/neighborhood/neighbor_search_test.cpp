#include "keenline/neighborhood/neighbor_search.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <mutex>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/nearest_by_force.h"
#include "support/uneven_clouds.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::uint32_t> list(std::span<const std::uint32_t> values) {
  return {values.begin(), values.end()};
}

TEST(NeighborSearch, EqualsBruteForceOnAnyCloud) {
  for (auto [name, points] : test::uneven_clouds()) {
    SCOPED_TRACE(name);
    points[11][2] = nan;
    const NeighborSearch search(points);
    for (const int count : {3, 16, 100}) {
      const Neighborhoods all = search.all(count);
      ASSERT_EQ(all.size(), points.size());
      for (std::uint32_t i = 0; i < points.size(); ++i) {
        const auto expected = test::nearest_by_force(points, i, static_cast<std::size_t>(count));
        ASSERT_EQ(list(all.of(i)), expected) << "point " << i << ", " << count << " neighbours";
        if (i % 9 == 2) {
          ASSERT_EQ(search.nearest(i, count), expected) << "point " << i;
        }
      }
    }
  }
}

TEST(NeighborSearch, KnowsTiesOfManyMoreThanAskedFor) {
  // Twenty places at distance 5 from the origin, ten points at each.
  std::vector<Point> points{{0, 0, 0}};
  for (int copy = 0; copy < 10; ++copy)
    for (const double a : {-3.0, 3.0})
      for (const double b : {-4.0, 4.0})
        for (const Point& p :
             {Point{a, b, 0}, Point{b, 0, a}, Point{0, a, b}, Point{b, a, 0}, Point{a, 0, b}})
          points.push_back(p);
  const NeighborSearch search(points);
  EXPECT_EQ(search.nearest(0, 16), test::nearest_by_force(points, 0, 16));
  EXPECT_EQ(list(search.all(90).of(0)), test::nearest_by_force(points, 0, 90));
}

TEST(NeighborSearch, FindsThePointsNearestToAnyPosition) {
  for (auto [name, points] : test::uneven_clouds()) {
    SCOPED_TRACE(name);
    points[11][2] = nan;
    const NeighborSearch search(points);
    for (std::size_t i = 0; i < points.size(); i += 9) {
      const Point& p = points[i];
      for (const Point& position : {p, Point{p[0] + 0.013, p[1], p[2] - 0.4}, Point{100, 2 * p[0], -p[1]}}) {
        if (!is_finite(position)) continue;
        for (const int count : {1, 7, 300}) {
          ASSERT_EQ(search.nearest_to(position, count),
                    test::nearest_to_by_force(points, position, static_cast<std::size_t>(count)))
              << "point " << i << ", " << count << " nearest";
        }
      }
    }
  }
}

TEST(NeighborSearch, FindsTheNearestOfVeryLargeAndVerySmallCoordinates) {
  for (const double scale : {0x1p-700, 0x1p700}) {
    std::vector<Point> points = test::random_points(500, 10);
    const std::vector<std::uint32_t> expected = test::nearest_to_by_force(points, {0.25, 0.5, 0.5}, 20);
    for (Point& p : points)
      for (double& coordinate : p) coordinate *= scale;
    const NeighborSearch search(points);
    EXPECT_EQ(search.nearest_to({0.25 * scale, 0.5 * scale, 0.5 * scale}, 20), expected);
  }
}

TEST(NeighborSearch, VisitsEveryFinitePointOnceInTheSameBlocks) {
  std::vector<Point> points = test::random_points(20000, 5);
  for (std::size_t i = 0; i < points.size(); i += 100) points[i][0] = nan;
  for (std::size_t i = 1; i < points.size(); i += 4) points[i] = {0.5, 0.5, 0.5};
  const NeighborSearch search(points);
  const Neighborhoods all = search.all(16);
  std::map<std::uint32_t, std::vector<std::uint32_t>> first_blocks;  // by their first point
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::mutex mutex;
    std::map<std::uint32_t, std::vector<std::uint32_t>> blocks;
    std::vector<int> visits(points.size(), 0);
    search.for_each_block(16, [&](std::span<const std::uint32_t> block, const Neighborhoods& neighborhoods) {
      const std::lock_guard lock(mutex);
      ASSERT_EQ(neighborhoods.size(), block.size());
      ASSERT_LE(block.size(), 4096U);
      blocks.emplace(block[0], list(block));
      for (std::size_t i = 0; i < block.size(); ++i) {
        ++visits[block[i]];
        ASSERT_EQ(list(neighborhoods.of(i)), list(all.of(block[i])));
      }
    });
    for (std::size_t i = 0; i < points.size(); ++i) ASSERT_EQ(visits[i], is_finite(points[i]) ? 1 : 0);
    if (first_blocks.empty()) first_blocks = blocks;
    EXPECT_EQ(blocks, first_blocks);
  }
}

TEST(NeighborSearch, OfPointsThatCoincideTheFirstIsKnown) {
  using Numbers = std::vector<std::uint32_t>;
  const std::vector<Point> some{{1, 0, 0},    {nan, 0, 0}, {0.0, 0, 0}, {1, 0, 0},
                                {-0.0, 0, 0}, {nan, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(NeighborSearch(some).first_coincident(), (Numbers{0, 1, 2, 0, 2, 5, 0}));
  const std::vector<Point> apart{{1, 0, 0}, {2, 0, 0}};
  EXPECT_EQ(NeighborSearch(apart).first_coincident(), (Numbers{0, 1}));
  const std::vector<Point> none;
  EXPECT_EQ(NeighborSearch(none).first_coincident(), Numbers{});
}

class Counter : public Progress {
 public:
  void advance(std::uint64_t units) override { done += units; }
  std::atomic<std::uint64_t> done = 0;
};

TEST(NeighborSearch, ReportsEachPointOnce) {
  const std::vector<Point> points = test::random_points(5000, 6);
  const NeighborSearch search(points);
  Counter progress;
  search.for_each_block(
      8, [](auto, const auto&) {}, progress);
  EXPECT_EQ(progress.done, 5000U);
}

TEST(NeighborSearch, CanBeCancelled) {
  const std::vector<Point> points = test::random_points(5000, 7);
  test::CancelledProgress progress;
  EXPECT_THROW(const NeighborSearch search(points, progress), Cancelled);
  const NeighborSearch search(points);
  EXPECT_THROW(search.for_each_block(
                   8, [](auto, const auto&) {}, progress),
               Cancelled);
}

TEST(NeighborSearch, PassesOnWhatAVisitThrows) {
  const std::vector<Point> points = test::random_points(5000, 8);
  const NeighborSearch search(points);
  const auto refuse = [](auto, const auto&) { throw InvalidArgument("no"); };
  EXPECT_THROW(search.for_each_block(8, refuse), InvalidArgument);
}

TEST(NeighborSearch, RefusesWhatIsOutOfRange) {
  const std::vector<Point> points = test::random_points(10, 9);
  const NeighborSearch search(points);
  EXPECT_THROW((void)search.nearest(10, 8), InvalidArgument);
  EXPECT_THROW((void)search.nearest_to({0, 0, 0}, 0), InvalidArgument);
  for (const int count : {2, 256}) {
    EXPECT_THROW((void)search.nearest(0, count), InvalidArgument);
    EXPECT_THROW((void)search.all(count), InvalidArgument);
    EXPECT_THROW(search.for_each_block(count, [](auto, const auto&) {}), InvalidArgument);
  }
}

TEST(NeighborSearch, MayHaveNothingToSearch) {
  const std::vector<Point> none;
  EXPECT_EQ(NeighborSearch(none).all(8).size(), 0U);
  EXPECT_TRUE(NeighborSearch(none).nearest_to({0, 0, 0}, 3).empty());
  const std::vector<Point> same(9000, Point{1, 2, 3});
  const NeighborSearch search(same);
  EXPECT_TRUE(search.nearest(5, 8).empty());
  EXPECT_EQ(search.nearest_to({0, 0, 0}, 3), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(search.nearest_to({nan, 0, 0}, 3).empty());
  EXPECT_TRUE(search.all(8).indices.empty());
}

}  // namespace
}  // namespace keenline
