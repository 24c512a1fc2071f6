#include "keenline/feature_graph.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

Polyline triangle() { return {.vertices = {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}}}; }

FeatureGraph small_graph() {
  FeatureGraph graph;
  graph.corners = {{{0, 0, 0}, {}}, {{3, 4, 0}, 0.5}};
  graph.polylines = {triangle()};
  graph.polylines[0].start_corner = 0;
  graph.polylines[0].end_corner = 1;
  return graph;
}

TEST(FeatureGraph, LengthCountsTheClosingPieceOfAClosedLineOnly) {
  Polyline line = triangle();
  EXPECT_EQ(length_of(line), 7);
  EXPECT_EQ(segment_count(line), 2U);
  line.closed = true;
  EXPECT_EQ(length_of(line), 12);
  EXPECT_EQ(segment_count(line), 3U);
  EXPECT_EQ(segment_end(line, 1), line.vertices[2]);
  EXPECT_EQ(segment_end(line, 2), line.vertices[0]);
  EXPECT_EQ(length_of({}), 0);
}

TEST(FeatureGraph, ExtentCoversVerticesAndCorners) {
  EXPECT_TRUE(extent_of({}).is_empty());
  FeatureGraph graph = small_graph();
  graph.corners[1].position = {-1, 2, 9};
  const Extent extent = extent_of(graph);
  EXPECT_FALSE(extent.is_empty());
  EXPECT_EQ(extent.low, (Point{-1, 0, 0}));
  EXPECT_EQ(extent.high, (Point{3, 4, 9}));
}

TEST(FeatureGraph, CountsTellLoopsFromLooseEnds) {
  FeatureGraph graph = small_graph();
  graph.polylines.push_back(triangle());
  graph.polylines.back().closed = true;
  graph.polylines.push_back(triangle());
  graph.polylines.back().end_corner = 1;
  const GraphCounts counts = counts_of(graph);
  EXPECT_EQ(counts.length, 7 + 12 + 7);
  EXPECT_EQ(counts.corners, 2U);
  EXPECT_EQ(counts.polylines, 3U);
  EXPECT_EQ(counts.loops, 1U);
  EXPECT_EQ(counts.loose_ends, 1U);
}

TEST(FeatureGraph, AcceptsWhatItDescribes) {
  EXPECT_NO_THROW(validate({}));
  FeatureGraph graph = small_graph();
  EXPECT_NO_THROW(validate(graph));
  Polyline& line = graph.polylines[0];
  line.dihedral_deg = {90, 91, 92};
  line.normals.resize(3);
  line.residual = {0, 0.1, 0};
  line.fitted = FittedSpline{std::vector<Point>(4), {0, 0, 0, 0, 1, 1, 1, 1}};
  EXPECT_NO_THROW(validate(graph));
  line.closed = true;
  line.end_corner = 0;
  line.fitted = FittedArc{};
  EXPECT_NO_THROW(validate(graph));
}

TEST(FeatureGraph, RefusesEverythingElseByNumber) {
  struct Case {
    std::string_view message;
    std::function<void(FeatureGraph&)> spoil;
  };
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<Case> cases{
      {"corner 1 has a number", [&](FeatureGraph& g) { g.corners[1].position[2] = nan; }},
      {"corner 0 has a number", [&](FeatureGraph& g) { g.corners[0].residual = infinity; }},
      {"polyline 0 has 1 vertices; expected at least 2",
       [](FeatureGraph& g) { g.polylines[0].vertices.resize(1); }},
      {"polyline 0 has 2 vertices; expected at least 3",
       [](FeatureGraph& g) {
         g.polylines[0].vertices.resize(2);
         g.polylines[0].closed = true;
       }},
      {"polyline 0 has a number", [](FeatureGraph& g) { g.polylines[0].vertices[1][0] = 1e151; }},
      {"polyline 0 has a number",
       [&](FeatureGraph& g) {
         g.polylines[0].residual = {0, nan, 0};
       }},
      {"2 dihedral angles for 3 vertices", [](FeatureGraph& g) { g.polylines[0].dihedral_deg.resize(2); }},
      {"4 normals for 3 vertices", [](FeatureGraph& g) { g.polylines[0].normals.resize(4); }},
      {"1 residuals for 3 vertices", [](FeatureGraph& g) { g.polylines[0].residual.resize(1); }},
      {"ends in corner 2 of 2", [](FeatureGraph& g) { g.polylines[0].end_corner = 2; }},
      {"closed but does not end", [](FeatureGraph& g) { g.polylines[0].closed = true; }},
      {"a fitted line",
       [&](FeatureGraph& g) {
         g.polylines[0].fitted = FittedLine{{nan, 0, 0}, {}};
       }},
      {"centre or radius", [](FeatureGraph& g) { g.polylines[0].fitted = FittedArc{.radius = 0}; }},
      {"perpendicular",
       [](FeatureGraph& g) {
         g.polylines[0].fitted = FittedArc{.x_axis = {0, 0, 1}};
       }},
      {"arc of 361 degrees", [](FeatureGraph& g) { g.polylines[0].fitted = FittedArc{.sweep_deg = 361}; }},
      {"3 control points and 7 knots",
       [](FeatureGraph& g) {
         g.polylines[0].fitted = FittedSpline{std::vector<Point>(3), {0, 0, 0, 0, 1, 1, 1}};
       }},
      {"knots fall", [](FeatureGraph& g) {
         g.polylines[0].fitted = FittedSpline{std::vector<Point>(4), {0, 0, 0, 0, 1, 1, 1, 0.5}};
       }}};
  for (const Case& c : cases) {
    FeatureGraph graph = small_graph();
    c.spoil(graph);
    test::expect_error<InvalidArgument>([&] { validate(graph); }, c.message);
  }
}

TEST(FeatureGraph, KindsHaveNames) {
  EXPECT_EQ(name_of(LineKind::Crease), "crease");
  EXPECT_EQ(name_of(LineKind::Border), "border");
}

}  // namespace
}  // namespace keenline
