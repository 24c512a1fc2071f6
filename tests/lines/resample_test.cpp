#include "keenline/lines/resample.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

FeatureGraph graph_of(const Polyline& line) {
  FeatureGraph graph;
  graph.polylines.push_back(line);
  return graph;
}

Polyline resampled(const Polyline& line, double step) {
  const FeatureGraph graph = resample_lines(graph_of(line), step);
  validate(graph);
  return graph.polylines[0];
}

TEST(ResampleLines, StepsAreEqualAndAsNearToTheAskedOneAsCanBe) {
  const Polyline line{.vertices = {{0, 0, 0}, {1, 0, 0}, {7, 0, 0}, {10, 0, 0}}};
  const Polyline even = resampled(line, 2.9);
  ASSERT_EQ(even.vertices.size(), 4U);  // three pieces of 10 / 3
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(even.vertices[i][0], static_cast<double>(i) * 10 / 3, 1e-14);
  EXPECT_EQ(resampled(line, 100).vertices, (std::vector<Point>{{0, 0, 0}, {10, 0, 0}}));
}

TEST(ResampleLines, SharpBendsStay) {
  const Polyline corner{.vertices = {{0, 0, 0}, {5.3, 0, 0}, {5.3, 4.1, 0}}};
  const Polyline even = resampled(corner, 1);
  EXPECT_EQ(std::count(even.vertices.begin(), even.vertices.end(), (Point{5.3, 0, 0})), 1);
  EXPECT_NEAR(length_of(even), 9.4, 1e-12);
  EXPECT_EQ(even.vertices.size(), 5U + 4 + 1);
  const Polyline square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .closed = true};
  EXPECT_NEAR(length_of(resampled(square, 0.3)), 4, 1e-12);
  EXPECT_EQ(resampled(square, 0.3).vertices.size(), 12U);
}

TEST(ResampleLines, ABendRoundsAFewVerticesButIsOne) {
  // A right angle with a vertex cut off: both of its bends are of 45 degrees, a step away they are one of 90.
  const Polyline cut{.vertices = {{0, 0, 0}, {9.9, 0, 0}, {10, 0.1, 0}, {10, 10, 0}}};
  EXPECT_GT(length_of(resampled(cut, 2)), length_of(cut) - 0.1);
}

TEST(ResampleLines, ACircleIsDividedAllRound) {
  Polyline circle{.closed = true};
  for (int i = 0; i < 100; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / 100;
    circle.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  const Polyline even = resampled(circle, 0.1);
  EXPECT_EQ(even.vertices.size(), 63U);
  EXPECT_TRUE(even.closed);
  EXPECT_EQ(even.vertices[0], circle.vertices[0]);
  for (std::size_t i = 0; i < segment_count(even); ++i)
    EXPECT_NEAR(distance(even.vertices[i], segment_end(even, i)), length_of(even) / 63, 2e-4);
  EXPECT_EQ(resampled(circle, 100).vertices.size(), 3U);
}

TEST(ResampleLines, AClosedLineWithBendsBeginsAtTheFirstOfThem) {
  // Round but for a spike at vertex 45.
  Polyline spiked{.closed = true};
  for (int i = 0; i < 60; ++i) {
    const double angle = 2 * std::acos(-1.0) * (i + 15) / 60;
    const bool is_spike = i == 45;
    spiked.vertices.push_back(
        {(is_spike ? 3 : 1) * std::cos(angle), (is_spike ? 3 : 1) * std::sin(angle), 0});
  }
  const Polyline even = resampled(spiked, 0.2);
  EXPECT_EQ(even.vertices[0], spiked.vertices[44]);
  EXPECT_EQ(std::count(even.vertices.begin(), even.vertices.end(), spiked.vertices[45]), 1);
  EXPECT_EQ(std::count(even.vertices.begin(), even.vertices.end(), spiked.vertices[46]), 1);
}

TEST(ResampleLines, ValuesAreInterpolated) {
  Polyline line{.vertices = {{0, 0, 0}, {4, 0, 0}, {8, 0, 0}}};
  line.dihedral_deg = {80, 100, 90};
  line.residual = {0, 1, 0};
  line.normals = {{{0, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}}, {{0, 1, 0}, {0, 1, 0}}};
  const Polyline even = resampled(line, 2);
  EXPECT_EQ(even.dihedral_deg, (std::vector<double>{80, 90, 100, 95, 90}));
  EXPECT_EQ(even.residual, (std::vector<double>{0, 0.5, 1, 0.5, 0}));
  EXPECT_NEAR(distance(even.normals[1].left, unit({0, 1, 1})), 0, 1e-15);
  EXPECT_NEAR(length(even.normals[3].right), 1, 1e-15);
}

TEST(ResampleLines, ValuesOfAClosedLineGoRound) {
  Polyline triangle{.vertices = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, .closed = true};
  triangle.dihedral_deg = {10, 20, 30};
  const Polyline even = resampled(triangle, std::sqrt(2.0) / 2);
  EXPECT_NEAR(even.dihedral_deg.back(), 20, 1e-12);  // half-way from the last vertex to the first
}

TEST(ResampleLines, CornersAndEndsKeepEveryBit) {
  FeatureGraph graph;
  graph.corners = {{{0.1, 0.2, 0.3}, {}}, {{1e7, 0.7, 1}, {}}};
  graph.polylines.push_back(
      {.vertices = {graph.corners[0].position, {5e6, 0.5, 0.6}, graph.corners[1].position},
       .start_corner = 0U,
       .end_corner = 1U});
  const Polyline line = resample_lines(graph, 1e5).polylines[0];
  EXPECT_EQ(line.vertices.front(), graph.corners[0].position);
  EXPECT_EQ(line.vertices.back(), graph.corners[1].position);
  EXPECT_EQ(line.vertices.size(), 101U);
}

TEST(ResampleLines, LinesWithoutLengthStayLines) {
  const Polyline dot{.vertices = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, .closed = true};
  EXPECT_EQ(resampled(dot, 1).vertices, dot.vertices);
  const Polyline open{.vertices = {{1, 1, 1}, {1, 1, 1}}};
  EXPECT_EQ(resampled(open, 1).vertices, open.vertices);
}

TEST(ResampleLines, RefusesWhatIsOutOfRange) {
  const Polyline line{.vertices = {{0, 0, 0}, {1, 0, 0}}};
  for (const double step : {0.0, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)resampled(line, step), InvalidArgument);
  EXPECT_THROW((void)resampled(line, 1e-12), OutOfMemory);
}

}  // namespace
}  // namespace keenline
