#include "keenline/evaluate/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(SegmentTree, DistanceHasThreeCases) {
  const Segment segment{{0, 0, 0}, {4, 0, 0}};
  EXPECT_EQ(distance_to(segment, {1, 3, 4}), 5);
  EXPECT_EQ(distance_to(segment, {-3, 4, 0}), 5);
  EXPECT_EQ(distance_to(segment, {7, 0, 4}), 5);
  EXPECT_EQ(distance_to({{1, 1, 1}, {1, 1, 1}}, {1, 1, 3}), 2);
}

TEST(SegmentTree, EndsAreExactFarFromTheOrigin) {
  const Segment segment{{4500000.123, 5400000.001, 99.9}, {4500017.77, 5400000.5, 101.3}};
  EXPECT_EQ(distance_to(segment, segment.a), 0);
  EXPECT_EQ(distance_to(segment, segment.b), 0);
}

std::vector<Segment> random_segments(std::size_t count, double length) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in_cube(-1, 1);
  std::vector<Segment> segments(count);
  for (Segment& s : segments) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      s.a[axis] = in_cube(random);
      s.b[axis] = s.a[axis] + length * in_cube(random);
    }
  }
  return segments;
}

TEST(SegmentTree, FindsWhatTryingEachFinds) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> around(-3, 3);
  for (const std::size_t count : {1, 2, 4, 5, 8, 9, 10, 63, 500}) {
    for (const double length : {0.0, 0.01, 2.0}) {
      const std::vector<Segment> segments = random_segments(count, length);
      const SegmentTree tree(segments);
      for (int query = 0; query < 50; ++query) {
        const Point p{around(random), around(random), around(random)};
        double nearest = std::numeric_limits<double>::infinity();
        for (const Segment& s : segments) nearest = std::min(nearest, distance_to(s, p));
        ASSERT_EQ(tree.distance_to_nearest(p), nearest) << count << " segments of " << length;
      }
    }
  }
}

TEST(SegmentTree, WithoutSegmentsEverythingIsInfinitelyFar) {
  EXPECT_EQ(SegmentTree({}).distance_to_nearest({0, 0, 0}), std::numeric_limits<double>::infinity());
}

TEST(SegmentTree, EqualSegmentsAreNoHardCase) {
  const SegmentTree tree(std::vector<Segment>(100000, {{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(tree.distance_to_nearest({0.5, 2, 0}), 2);
}

}  // namespace
}  // namespace keenline
