#include "keenline/lines/sides.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

#include "support/rough_lines.h"

namespace keenline {
namespace {

using test::LineScene;
using test::shape_options;

FeatureGraph measured(const LineScene& scene) {
  FeatureGraph graph = test::roughened(scene.truth, scene.spacing, {.vertices = 0.1, .corners = 0.1});
  measure_sides(graph, scene.synth.cloud, scene.search, scene.spacing);
  validate(graph);
  return graph;
}

std::vector<double> all_angles(const FeatureGraph& graph) {
  std::vector<double> angles;
  for (const Polyline& line : graph.polylines)
    angles.insert(angles.end(), line.dihedral_deg.begin(), line.dihedral_deg.end());
  return angles;
}

TEST(Sides, AnglesOfCreasesAreThoseOfTheShape) {
  struct Expected {
    std::string shape;
    double angle;
  };
  const double icosahedron = std::acos(-std::sqrt(5.0) / 3) * 180 / std::acos(-1.0);
  for (const auto& [shape, angle] :
       {Expected{"cube", 90}, Expected{"icosahedron", icosahedron}, Expected{"cone", 60}}) {
    const LineScene scene(shape_options(shape, 3000));
    std::vector<double> angles = all_angles(measured(scene));
    ASSERT_FALSE(angles.empty()) << shape;
    std::sort(angles.begin(), angles.end());
    EXPECT_NEAR(angles[angles.size() / 2], angle, 0.4) << shape;
    EXPECT_NEAR(angles[angles.size() / 20], angle, 2) << shape;
    EXPECT_NEAR(angles[angles.size() * 19 / 20], angle, 2) << shape;
  }
}

TEST(Sides, NormalsPointOutOfAConvexBody) {
  const LineScene scene(shape_options("box", 8000));
  for (const Polyline& line : measured(scene).polylines) {
    ASSERT_EQ(line.normals.size(), line.vertices.size());
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      const auto& [left, right] = line.normals[i];
      EXPECT_NEAR(length(left), 1, 1e-12);
      EXPECT_GT(dot(left, line.vertices[i]), 0);  // the middle of the box is the origin
      EXPECT_GT(dot(right, line.vertices[i]), 0);
      const Point along = difference(line.vertices.back(), line.vertices.front());
      EXPECT_GT(dot(cross(left, right), along), 0);
    }
  }
}

TEST(Sides, NearACornerTheThirdFaceIsNotOneOfThem) {
  const LineScene scene(shape_options("cube", 6000));
  for (const Polyline& line : scene.truth.polylines) {
    const auto sides = sides_along(line, scene.synth.cloud, scene.search, scene.spacing);
    ASSERT_EQ(sides.size(), 2U);
    const Point along = unit(difference(line.vertices[1], line.vertices[0]));
    for (const auto& at_corner : sides) {
      ASSERT_TRUE(at_corner);
      // Not exactly 0: what little of that face is within a twentieth of a spacing of a side counts there.
      EXPECT_NEAR(dot(at_corner->left.surface.z, along), 0, 0.005);
      EXPECT_NEAR(dot(at_corner->right.surface.z, along), 0, 0.005);
    }
  }
}

TEST(Sides, VerticesWithoutSidesHaveThoseOfTheNearestOne) {
  const LineScene scene(shape_options("crease", 4000));
  const double h = scene.spacing;
  // The crease is on the y axis from -0.5 to 0.5; this line goes on into the void.
  const Polyline line{.vertices = {{0, 0, 0}, {0, 0.3, 0}, {0, 0.5 + 10 * h, 0}, {0, 0.5 + 30 * h, 0}}};
  const auto sides = sides_along(line, scene.synth.cloud, scene.search, h);
  EXPECT_TRUE(sides[0] && sides[1]);
  EXPECT_FALSE(sides[3]);  // more than the reach away
  Polyline described = line;
  describe(described, sides);
  ASSERT_EQ(described.dihedral_deg.size(), 4U);
  EXPECT_EQ(described.dihedral_deg[3], described.dihedral_deg[1]);
}

TEST(Sides, AreNotSoughtAgainWhereTheLineHasStayed) {
  const LineScene scene(shape_options("crease", 4000));
  const double h = scene.spacing;
  Polyline line;
  for (int i = -5; i <= 5; ++i) line.vertices.push_back({0, 2 * i * h, 0});
  KnownSides known;
  const auto look = [&](const NeighborSearch& search, KnownSides* before) {
    return sides_along(line, scene.synth.cloud, search, h, {}, no_progress(), before);
  };
  const auto normals = [](const std::vector<std::optional<LineSides>>& sides) {
    std::vector<Point> all;
    for (const auto& side : sides) {
      all.push_back(side.value().left.surface.normal({}));
      all.push_back(side.value().right.surface.normal({}));
    }
    return all;
  };
  const auto fresh = normals(look(scene.search, nullptr));
  EXPECT_EQ(normals(look(scene.search, &known)), fresh);
  const std::vector<Point> nowhere;
  const NeighborSearch blind(nowhere);
  EXPECT_EQ(normals(look(blind, &known)), fresh);  // and goes on knowing them

  line.vertices[5] = {0.2 * h, 0, 0.1 * h};
  const auto moved = normals(look(scene.search, nullptr));
  EXPECT_NE(moved, fresh);
  EXPECT_EQ(normals(look(scene.search, &known)), moved);
}

TEST(Sides, WhereNothingIsKnownNothingIsSaid) {
  const LineScene scene(shape_options("sphere", 2000));
  FeatureGraph graph;
  graph.polylines.push_back({.vertices = {{5, 0, 0}, {6, 0, 0}}});
  graph.polylines[0].dihedral_deg = {1, 2};
  measure_sides(graph, scene.synth.cloud, scene.search, scene.spacing);
  EXPECT_TRUE(graph.polylines[0].dihedral_deg.empty());
  EXPECT_TRUE(graph.polylines[0].normals.empty());
}

TEST(Sides, ResidualsThatAreKnownAreKept) {
  const LineScene scene(shape_options("cube", 3000));
  FeatureGraph graph = scene.truth;
  graph.polylines[0].residual = {7, 8};
  measure_sides(graph, scene.synth.cloud, scene.search, scene.spacing);
  EXPECT_EQ(graph.polylines[0].residual, (std::vector<double>{7, 8}));
  EXPECT_EQ(graph.polylines[1].residual.size(), 2U);
}

TEST(Sides, ABorderHasNoAngle) {
  const LineScene scene(shape_options("plane", 3000));
  const FeatureGraph graph = measured(scene);
  EXPECT_TRUE(graph.polylines[0].dihedral_deg.empty());
  ASSERT_FALSE(graph.polylines[0].normals.empty());
  for (const auto& [left, right] : graph.polylines[0].normals) {
    EXPECT_EQ(left, right);
    EXPECT_NEAR(std::abs(left[2]), 1, 1e-9);
  }
}

TEST(Sides, ASpacingIsNeeded) {
  const LineScene scene(shape_options("cube", 500));
  FeatureGraph graph = scene.truth;
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(measure_sides(graph, scene.synth.cloud, scene.search, spacing), InvalidArgument);
}

}  // namespace
}  // namespace keenline
