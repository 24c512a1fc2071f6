#include "keenline/lines/smooth.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

FeatureGraph graph_of(const Polyline& line) {
  FeatureGraph graph;
  graph.polylines.push_back(line);
  return graph;
}

Polyline smoothed(const Polyline& line, int neighbors = 5) {
  return smooth_lines(graph_of(line), {neighbors}).polylines[0];
}

Polyline circle(std::size_t count) {
  Polyline line{.closed = true};
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(count);
    line.vertices.push_back({10 * std::cos(angle), 10 * std::sin(angle), 3});
  }
  return line;
}

/// Along the x axis in uneven steps, off it by up to `unrest` in y and z.
Polyline unsteady(double unrest) {
  Polyline line;
  double x = 0;
  for (const Point& p : test::random_points(200, 3)) {
    line.vertices.push_back({x, unrest * (2 * p[0] - 1), unrest * (2 * p[1] - 1)});
    x += 0.5 + p[2];
  }
  return line;
}

double mean_square_off_axis(const Polyline& line) {
  double squares = 0;
  for (const Point& p : line.vertices) squares += p[1] * p[1] + p[2] * p[2];
  return squares / static_cast<double>(line.vertices.size());
}

TEST(SmoothLines, CirclesKeepTheirLength) {
  for (const std::size_t count : {20U, 21U, 50U, 100U, 1000U}) {
    const Polyline line = circle(count);
    EXPECT_NEAR(length_of(smoothed(line)) / length_of(line), 1, 0.001) << count;
    EXPECT_NEAR(length_of(smoothed(line, 50)) / length_of(line), 1, 0.001) << count;
  }
}

TEST(SmoothLines, AllVerticesOfACircleAreEqual) {
  for (const Point& p : smoothed(circle(40)).vertices)
    EXPECT_NEAR(std::hypot(p[0], p[1]),
                std::hypot(smoothed(circle(40)).vertices[0][0], smoothed(circle(40)).vertices[0][1]), 1e-12);
}

TEST(SmoothLines, UnrestIsHalvedAndStraightLinesStayAsTheyAre) {
  EXPECT_LT(mean_square_off_axis(smoothed(unsteady(0.3))), 0.35 * mean_square_off_axis(unsteady(0.3)));
  const Polyline straight = unsteady(0);
  const Polyline same = smoothed(straight);
  for (std::size_t i = 0; i < straight.vertices.size(); ++i)
    EXPECT_LT(distance(same.vertices[i], straight.vertices[i]), 1e-12);
}

TEST(SmoothLines, MoreNeighborsSmoothMore) {
  EXPECT_LT(mean_square_off_axis(smoothed(unsteady(0.3), 15)),
            0.6 * mean_square_off_axis(smoothed(unsteady(0.3), 5)));
}

TEST(SmoothLines, EndsAndCornersStay) {
  const Polyline open = unsteady(0.3);
  EXPECT_EQ(smoothed(open).vertices.front(), open.vertices.front());
  EXPECT_EQ(smoothed(open).vertices.back(), open.vertices.back());
  FeatureGraph drop = graph_of(circle(30));
  drop.polylines[0].vertices[0] = {14, 0, 3};
  drop.corners.push_back({{14, 0, 3}, {}});
  drop.polylines[0].start_corner = drop.polylines[0].end_corner = 0U;
  const FeatureGraph smooth = smooth_lines(drop);
  EXPECT_EQ(smooth.polylines[0].vertices[0], (Point{14, 0, 3}));
  // Nothing is averaged across the corner: it is as sharp as before.
  EXPECT_GT(smooth.polylines[0].vertices[1][0], 10);
}

TEST(SmoothLines, IsTheSameForwardAndBackward) {
  const Polyline line = unsteady(0.3);
  Polyline backward = line;
  std::reverse(backward.vertices.begin(), backward.vertices.end());
  const Polyline a = smoothed(line);
  const Polyline b = smoothed(backward);
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    EXPECT_LT(distance(a.vertices[i], b.vertices[a.vertices.size() - 1 - i]), 1e-12);
}

TEST(SmoothLines, ShortAndDegenerateLinesAreLines) {
  for (const bool closed : {false, true}) {
    Polyline line{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .closed = closed};
    validate(graph_of(smoothed(line)));
    line.vertices.assign(7, Point{1, 2, 3});
    EXPECT_EQ(smoothed(line).vertices, line.vertices);
  }
  const Polyline segment{.vertices = {{0, 0, 0}, {1, 0, 0}}};
  EXPECT_EQ(smoothed(segment, 1000).vertices, segment.vertices);
  EXPECT_TRUE(smooth_lines({}).polylines.empty());
}

TEST(SmoothLines, ValuesStayAndCurvesGo) {
  Polyline line{.vertices = {{0, 0, 0}, {1, 0.5, 0}, {2, 0, 0}}};
  line.dihedral_deg = {90, 91, 92};
  line.fitted = FittedLine{{0, 0, 0}, {2, 0, 0}};
  const Polyline smooth = smoothed(line);
  EXPECT_EQ(smooth.dihedral_deg, line.dihedral_deg);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(smooth.fitted));
}

TEST(SmoothLines, RefusesWhatIsOutOfRange) {
  EXPECT_THROW((void)smooth_lines({}, {1}), InvalidArgument);
  EXPECT_THROW((void)smooth_lines({}, {1001}), InvalidArgument);
}

}  // namespace
}  // namespace keenline
