#include "keenline/lines/straighten.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double degree = 0.017453292519943295;

/// Off a straight line by up to 0.4, differently at every vertex.
double wavering(std::size_t i) { return 0.4 * std::sin(2.4 * static_cast<double>(i)); }

/// From (0, 0, 0) along x in steps of one spacing, 1, and wavering.
Polyline wavering_line(std::size_t vertices, double residual) {
  Polyline line;
  for (std::size_t i = 0; i < vertices; ++i)
    line.vertices.push_back({static_cast<double>(i), wavering(i), wavering(i + 7)});
  line.residual.assign(vertices, residual);
  return line;
}

Polyline straightened(const Polyline& line, double spacing = 1) {
  FeatureGraph graph;
  graph.polylines = {line};
  const FeatureGraph result = straighten_lines(graph, spacing);
  validate(result);
  return result.polylines.at(0);
}

/// The largest distance of vertices first … last from their chord.
double off_chord(const Polyline& line, std::size_t first, std::size_t last) {
  const Point chord = unit(difference(line.vertices[last], line.vertices[first]));
  double largest = 0;
  for (std::size_t i = first; i <= last; ++i)
    largest = std::max(largest, length(cross(chord, difference(line.vertices[i], line.vertices[first]))));
  return largest;
}

TEST(StraightenLines, ALineThatIsKnownBadlyGoesStraight) {
  const Polyline before = wavering_line(30, 0.5);
  const Polyline line = straightened(before);
  ASSERT_EQ(line.vertices.size(), 30U);
  EXPECT_GT(off_chord(before, 0, 29), 0.3);
  EXPECT_LT(off_chord(line, 0, 29), 1e-12);
  for (std::size_t i = 0; i < 30; ++i) {
    EXPECT_LT(std::hypot(line.vertices[i][1], line.vertices[i][2]), 0.15);  // on its mean
    EXPECT_NEAR(line.vertices[i][0], static_cast<double>(i), 0.05);
    EXPECT_GE(line.residual[i], 0.5);
    EXPECT_GE(line.residual[i], distance(line.vertices[i], before.vertices[i]));
  }
}

TEST(StraightenLines, WhatLiesOnItsSurfacesStays) {
  const Polyline line = wavering_line(30, 0.05);
  EXPECT_EQ(straightened(line).vertices, line.vertices);
}

TEST(StraightenLines, SoDoesWhatWaversMoreThanItsResidualsAdmit) {
  Polyline line = wavering_line(30, 0.3);
  for (Point& p : line.vertices) p[1] *= 3;
  EXPECT_EQ(straightened(line).vertices, line.vertices);
}

TEST(StraightenLines, SoDoShortLinesAndClosedOnes) {
  const Polyline line = wavering_line(10, 0.5);  // 9 long
  EXPECT_EQ(straightened(line).vertices, line.vertices);
  Polyline loop;
  for (int i = 0; i < 60; ++i)
    loop.vertices.push_back({i < 30 ? i : 60.0 - i, wavering(static_cast<std::size_t>(i)), 0});
  loop.closed = true;
  loop.residual.assign(60, 0.5);
  EXPECT_EQ(straightened(loop).vertices, loop.vertices);
}

TEST(StraightenLines, ArcsAreNoChordsHoweverLittleIsKnown) {
  for (const double radius : {8.0, 15.0, 40.0}) {
    Polyline line;
    const int steps = static_cast<int>(90 * degree * radius);
    for (int i = 0; i <= steps; ++i) {
      const double angle = 90 * degree * i / steps;
      line.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    line.residual.assign(line.vertices.size(), 0.6);
    for (const Point& p : straightened(line).vertices) EXPECT_NEAR(length(p), radius, 0.36) << radius;
  }
}

TEST(StraightenLines, ABendStaysBetweenStraightLegs) {
  Polyline line = wavering_line(26, 0.5);
  const Polyline leg = line;
  for (std::size_t i = 1; i < 26; ++i)
    line.vertices.push_back({25 + leg.vertices[i][1], leg.vertices[i][0], leg.vertices[i][2]});
  line.residual.assign(line.vertices.size(), 0.5);
  const Polyline result = straightened(line);
  const auto bend =
      std::max_element(result.vertices.begin(), result.vertices.end(),
                       [](const Point& a, const Point& b) { return a[0] - a[1] < b[0] - b[1]; });
  EXPECT_LT(distance(*bend, {25, 0, 0}), 0.6);
  const auto at = static_cast<std::size_t>(bend - result.vertices.begin());
  EXPECT_LT(off_chord(result, 0, at), 0.1);
  EXPECT_LT(off_chord(result, at, result.vertices.size() - 1), 0.1);
}

/// Two lines along x and y that end in a corner beside the origin.
FeatureGraph corner_between(const Point& corner, std::optional<double> residual) {
  FeatureGraph graph;
  graph.corners = {{corner, residual}};
  for (const bool along_y : {false, true}) {
    Polyline line = wavering_line(30, 0.5);
    for (Point& p : line.vertices) p = along_y ? Point{0, p[0], 0} : Point{p[0], 0, 0};
    line.vertices.front() = corner;
    line.start_corner = 0;
    graph.polylines.push_back(line);
  }
  return graph;
}

TEST(StraightenLines, AnUnsureCornerGoesWhereItsLinesMeet) {
  const FeatureGraph result = straighten_lines(corner_between({0.4, -0.5, 0.3}, 0.8), 1);
  EXPECT_LT(length(result.corners[0].position), 0.1);
  for (const Polyline& line : result.polylines) EXPECT_EQ(line.vertices.front(), result.corners[0].position);
  EXPECT_GE(*result.corners[0].residual, 0.8);
}

TEST(StraightenLines, AKnownCornerStaysAndSoDoesOneThatWouldGoFar) {
  const Point known{0.2, -0.2, 0.1};
  EXPECT_EQ(straighten_lines(corner_between(known, 0.1), 1).corners[0].position, known);
  const Point far{-1, -1, -1};
  EXPECT_EQ(straighten_lines(corner_between(far, 0.8), 1).corners[0].position, far);
}

TEST(StraightenLines, VerticesThatGoBackAreLeftOutWithAllThatIsKnownOfThem) {
  Polyline line = wavering_line(30, 0.5);
  std::swap(line.vertices[10][0], line.vertices[11][0]);
  for (std::size_t i = 0; i < 30; ++i) line.dihedral_deg.push_back(static_cast<double>(i));
  line.fitted = FittedLine{{0, 0, 0}, {29, 0, 0}};
  const Polyline result = straightened(line);
  ASSERT_EQ(result.vertices.size(), 29U);
  EXPECT_EQ(result.dihedral_deg.size(), 29U);
  EXPECT_EQ(result.residual.size(), 29U);
  for (std::size_t i = 1; i < 29; ++i) EXPECT_GT(result.vertices[i][0], result.vertices[i - 1][0]);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(result.fitted));
}

TEST(StraightenLines, DoesNotDependOnPlaceOrScale) {
  const Polyline line = wavering_line(30, 0.5);
  const Polyline expected = straightened(line);
  Polyline there = line;
  for (Point& p : there.vertices) p = sum({5e6, -3e6, 100}, scaled(0.125, p));
  for (double& r : there.residual) r *= 0.125;
  const Polyline result = straightened(there, 0.125);
  ASSERT_EQ(result.vertices.size(), expected.vertices.size());
  for (std::size_t i = 0; i < result.vertices.size(); ++i)
    EXPECT_LT(distance(result.vertices[i], sum({5e6, -3e6, 100}, scaled(0.125, expected.vertices[i]))), 1e-8);
}

TEST(StraightenLines, RefusesWhatIsNoGraph) {
  FeatureGraph graph;
  graph.polylines.emplace_back();
  EXPECT_THROW((void)straighten_lines(graph, 1), InvalidArgument);
  EXPECT_TRUE(straighten_lines({}, 1).polylines.empty());
}

}  // namespace
}  // namespace keenline
