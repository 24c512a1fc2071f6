#include "keenline/lines/finish_net.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

namespace keenline {
namespace {

using std::numbers::pi;

/// `count` nodes one apart on a circle that would take `places`, connected in a row.
LineNet arc(std::uint32_t count, std::uint32_t places) {
  const double radius = 0.5 / std::sin(pi / places);
  std::vector<Point> positions;
  for (std::uint32_t i = 0; i < count; ++i)
    positions.push_back({radius * std::cos(2 * pi * i / places), radius * std::sin(2 * pi * i / places), 0});
  LineNet net(positions);
  for (std::uint32_t i = 0; i + 1 < count; ++i) net.connect(i, i + 1);
  return net;
}

TEST(FinishNet, ClosesALoopButNotAShortChain) {
  LineNet loop = arc(40, 41);  // a gap of two
  close_ends(loop, 8, 3, no_progress());
  EXPECT_TRUE(loop.ends().empty());
  ASSERT_EQ(loop.chains().size(), 1U);
  EXPECT_TRUE(loop.chains()[0].is_loop);

  LineNet chain({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  chain.connect(0, 1);
  chain.connect(1, 2);
  close_ends(chain, 8, 3, no_progress());
  EXPECT_EQ(chain.ends().size(), 2U);
}

TEST(FinishNet, ClosesNothingBeyondItsReach) {
  LineNet loop = arc(40, 50);
  close_ends(loop, 8, 3, no_progress());
  EXPECT_EQ(loop.ends().size(), 2U);
  close_ends(loop, 12, 3, no_progress());
  EXPECT_EQ(loop.ends().size(), 0U);
}

TEST(FinishNet, ConnectsAnEndToTheMiddleOfAnotherLine) {
  std::vector<Point> positions;
  for (int i = 0; i < 30; ++i) positions.push_back({1.0 * i, 0, 0});
  for (int i = 0; i < 20; ++i) positions.push_back({15, 4.0 + i, 0});
  LineNet net(positions);
  for (std::uint32_t i = 0; i + 1 < 30; ++i) net.connect(i, i + 1);
  for (std::uint32_t i = 30; i + 1 < 50; ++i) net.connect(i, i + 1);
  close_ends(net, 8, 3, no_progress());
  EXPECT_EQ(net.degree_of(15), 3U);
  EXPECT_EQ(net.degree_of(30), 2U);
  EXPECT_EQ(net.ends(), (std::vector<std::uint32_t>{0, 29, 49}));
}

TEST(FinishNet, SmoothingFlattensWavesAndKeepsArcs) {
  LineNet loop = arc(60, 60);
  loop.connect(59, 0);
  const double radius = length(loop.position_of(0));
  for (std::uint32_t i = 0; i < 60; ++i) loop.move(i, scaled(i % 2 == 0 ? 1.05 : 0.95, loop.position_of(i)));
  smooth(loop, 10, no_progress());
  for (std::uint32_t i = 0; i < 60; ++i) EXPECT_NEAR(length(loop.position_of(i)), radius, 0.005 * radius);

  LineNet row = arc(10, 1000);
  const Point first = row.position_of(0);
  const Point last = row.position_of(9);
  smooth(row, 10, no_progress());
  EXPECT_EQ(row.position_of(0), first);
  EXPECT_EQ(row.position_of(9), last);
}

TEST(FinishNet, TheGraphHasCornersWhereThreeLinesMeet) {
  PointCloud cloud;
  for (int i = 0; i < 30; ++i) cloud.positions.push_back({10 + 0.5 * i, 20, 30});
  FeatureLabels labels;
  labels.kind.assign(30, Kind::Edge);
  const Candidates candidates(cloud, NeighborSearch(cloud.positions), labels, 0.5, no_progress());
  // In spacings from the median of the points: a star of three arms, one of them closed to an eye.
  LineNet net(
      {{0, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {1, 2, 0}, {-1, 2, 0}, {8, 8, 8}, {8, 9, 8}, {9, 8, 8}});
  net.connect(0, 1);
  net.connect(0, 2);
  net.connect(0, 4);
  net.connect(4, 3);
  net.connect(3, 5);
  net.connect(5, 0);
  net.connect(6, 7);
  net.connect(7, 8);
  net.connect(8, 6);
  const std::vector<std::uint32_t> support{1, 2, 3, 4, 5, 6, 7, 8, 9};
  const FeatureGraph graph = graph_of(net, candidates, support);
  validate(graph);
  ASSERT_EQ(graph.corners.size(), 1U);
  EXPECT_EQ(graph.corners[0].position, (Point{17, 20, 30}));
  ASSERT_EQ(graph.polylines.size(), 4U);
  EXPECT_EQ(
      std::count_if(graph.polylines.begin(), graph.polylines.end(), [](const auto& l) { return l.closed; }),
      2);
  for (const Polyline& line : graph.polylines) {
    if (line.start_corner) {
      EXPECT_EQ(line.vertices.front(), graph.corners[0].position);
    }
    if (line.start_corner && line.closed) {
      EXPECT_EQ(line.support, 1U + 5U + 4U + 6U) << "of every node once";
    }
    if (line.end_corner && !line.closed) {
      EXPECT_EQ(line.vertices.back(), graph.corners[0].position);
    }
  }
  const Polyline& loop = graph.polylines.back();
  EXPECT_TRUE(loop.closed);
  EXPECT_FALSE(loop.start_corner.has_value());
  EXPECT_EQ(loop.support, 24U);
  EXPECT_EQ(loop.vertices[0], (Point{21, 24, 34}));
}

}  // namespace
}  // namespace keenline
