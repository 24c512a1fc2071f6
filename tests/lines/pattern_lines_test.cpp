#include "keenline/lines/pattern_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Nodes at these places, joined by these edges.
struct Drawing {
  LinePoints points;
  NodeGraph pattern;

  Drawing(const std::vector<Point>& positions, const std::vector<std::pair<int, int>>& edges)
      : points(points_at(positions, edges)), pattern(spanning_pattern(positions.size(), points.edges, 0)) {}

  static LinePoints points_at(const std::vector<Point>& positions,
                              const std::vector<std::pair<int, int>>& edges) {
    LinePoints result;
    result.positions = positions;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
      result.points.push_back(i);
      result.copies.push_back(1);
    }
    for (const auto& [a, b] : edges) {
      const auto from = static_cast<std::uint32_t>(std::min(a, b));
      const auto to = static_cast<std::uint32_t>(std::max(a, b));
      result.edges.push_back({from, to, distance(positions[from], positions[to])});
    }
    return result;
  }
};

TEST(PatternLines, JunctionsThatAreCloseAreOneCorner) {
  // Two junctions, 1 and 2, two spacings apart, each with two arms.
  const Drawing drawing({{-5, 5, 0}, {-1, 0, 0}, {1, 0, 0}, {5, 5, 0}, {-5, -5, 0}, {5, -5, 0}},
                        {{0, 1}, {4, 1}, {1, 2}, {2, 3}, {2, 5}});
  const PatternLines lines = lines_of(drawing.pattern, drawing.points);
  ASSERT_EQ(lines.corners.size(), 1U);
  EXPECT_EQ(lines.corners[0], (Point{0, 0, 0}));
  ASSERT_EQ(lines.lines.size(), 4U);
  for (const PatternLine& line : lines.lines) {
    EXPECT_EQ(line.vertices.size(), 2U);
    EXPECT_NE(line.start_corner.has_value(), line.end_corner.has_value());
    EXPECT_EQ(line.start_corner ? line.vertices.front() : line.vertices.back(), (Point{0, 0, 0}));
  }
}

TEST(PatternLines, JunctionsFurtherApartAreTwo) {
  const Drawing drawing({{-5, 5, 0}, {-2, 0, 0}, {2, 0, 0}, {5, 5, 0}, {-5, -5, 0}, {5, -5, 0}},
                        {{0, 1}, {4, 1}, {1, 2}, {2, 3}, {2, 5}});
  const PatternLines lines = lines_of(drawing.pattern, drawing.points);
  EXPECT_EQ(lines.corners.size(), 2U);
  EXPECT_EQ(lines.lines.size(), 5U);
}

TEST(PatternLines, LoopsAreClosed) {
  // A square, and one that hangs on the corner where a line begins.
  const Drawing free({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}});
  PatternLines lines = lines_of(free.pattern, free.points);
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_TRUE(lines.lines[0].closed);
  EXPECT_EQ(lines.lines[0].vertices.size(), 4U);
  EXPECT_FALSE(lines.lines[0].start_corner.has_value());

  const Drawing hung({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {-5, -5, 0}},
                     {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}});
  lines = lines_of(hung.pattern, hung.points);
  ASSERT_EQ(lines.corners.size(), 1U);
  ASSERT_EQ(lines.lines.size(), 2U);
  EXPECT_TRUE(lines.lines[0].closed);
  EXPECT_EQ(lines.lines[0].start_corner, 0U);
  EXPECT_EQ(lines.lines[0].end_corner, 0U);
  EXPECT_FALSE(lines.lines[1].closed);

  FeatureGraph graph;
  graph.corners.push_back({});
  add_lines(graph, lines, {{10, 20, 30}, 0.5}, LineKind::Border);
  validate(graph);
  EXPECT_EQ(graph.polylines[0].start_corner, 1U) << "after the corner that was there";
  EXPECT_EQ(graph.polylines[0].vertices[2], (Point{12, 22, 30}));
  EXPECT_EQ(graph.polylines[1].kind, LineKind::Border);
}

TEST(PatternLines, SupportIsWhatLiesNearest) {
  Drawing drawing({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0.5, 0}, {5, 5, 5}}, {{0, 1}, {1, 2}});
  drawing.points.edges.push_back({1, 3, 0.5});  // in the graph, not in the pattern
  const PatternLines lines = lines_of(drawing.pattern, drawing.points);
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_EQ(lines.lines[0].support, 4U);
}

TEST(PatternLines, PointsAreThoseOfTheKindAndThoseBeside) {
  PointCloud cloud;
  FeatureLabels labels;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 9; ++y) {
      cloud.positions.push_back({1e6 + 0.01 * x, 2e6 + 0.01 * y, 3e6});
      labels.kind.push_back(y == 4 && x % 5 == 0 ? Kind::Edge : y == 0 ? Kind::Border : Kind::Flat);
    }
  cloud.positions.push_back({nan, 0, 0});
  labels.kind.push_back(Kind::Edge);
  const NeighborSearch search(cloud.positions);
  const LinePoints creases = line_points(cloud, search, labels, 0.01, LineKind::Crease, no_progress());
  std::size_t labelled = 0;
  for (std::size_t i = 0; i < creases.points.size(); ++i) {
    const std::uint32_t point = creases.points[i];
    if (labels.kind[point] == Kind::Edge) ++labelled;
    const Point back = creases.frame.global(creases.positions[i]);
    EXPECT_NEAR(distance(back, cloud.positions[point]), 0, 1e-8);
    EXPECT_LE(std::abs(cloud.positions[point][1] - 2e6 - 0.04), 0.0301)
        << "two spacings to each side, at the end three";
  }
  EXPECT_EQ(labelled, 8U);
  EXPECT_GT(creases.points.size(), 100U);
  for (const WeightedEdge& edge : creases.edges) {
    EXPECT_LT(edge.a, edge.b);
    EXPECT_NEAR(edge.weight, distance(creases.positions[edge.a], creases.positions[edge.b]), 1e-12);
    EXPECT_LE(edge.weight, 3);
  }
  // The gaps of four are bridged: everything is one component.
  const PatternLines bridged = lines_of(clean_pattern(creases, creases.edges, 20, no_progress()), creases);
  ASSERT_FALSE(bridged.lines.empty());
  double length = 0;
  for (const PatternLine& line : bridged.lines)
    for (std::size_t i = 1; i < line.vertices.size(); ++i)
      length += distance(line.vertices[i - 1], line.vertices[i]);
  EXPECT_GE(length, 30);
  for (const double spacing : {0.0, -1.0, nan})
    EXPECT_TRUE(line_points(cloud, search, labels, spacing, LineKind::Crease, no_progress()).points.empty());
  labels.kind.pop_back();
  EXPECT_THROW((void)line_points(cloud, search, labels, 1, LineKind::Crease, no_progress()), InvalidArgument);
}

/// A row of a hundred points, and on one of them as many copies as there are.
TEST(PatternLines, PointsThatCoincideAreOneNode) {
  constexpr std::uint32_t copies = 20000;
  PointCloud cloud;
  for (int i = 0; i < 100; ++i) cloud.positions.push_back({1.0 * i, 0, 0});
  FeatureLabels labels;
  labels.kind.assign(100, Kind::Edge);
  const NeighborSearch search(cloud.positions);
  const LinePoints alone = line_points(cloud, search, labels, 1, LineKind::Crease, no_progress());
  cloud.positions.insert(cloud.positions.end(), copies, cloud.positions[50]);
  labels.kind.resize(cloud.size(), Kind::Edge);
  const NeighborSearch among_copies(cloud.positions);
  const LinePoints points = line_points(cloud, among_copies, labels, 1, LineKind::Crease, no_progress());
  EXPECT_EQ(points.points, alone.points);
  EXPECT_EQ(points.edges.size(), alone.edges.size());
  const NodeGraph pattern = clean_pattern(points, points.edges, 5, no_progress());
  const PatternLines lines = lines_of(pattern, points);
  ASSERT_EQ(lines.lines.size(), 1U);
  EXPECT_EQ(lines.lines[0].vertices.size(), 100U);
  EXPECT_EQ(lines.lines[0].support, 100U + copies);
}

TEST(PatternLines, CyclesAreGivenOrFollowTheFinitePoints) {
  PointCloud cloud;
  EXPECT_EQ(cycle_of({}, cloud), 5U);
  cloud.positions.assign(400, {1, 2, 3});
  EXPECT_EQ(cycle_of({}, cloud), 10U);
  cloud.positions.insert(cloud.positions.end(), 1000, {nan, 0, 0});
  EXPECT_EQ(cycle_of({}, cloud), 10U);
  EXPECT_EQ(cycle_of(1, cloud), 1U);
  EXPECT_THROW((void)cycle_of(0, cloud), InvalidArgument);
}

}  // namespace
}  // namespace keenline
