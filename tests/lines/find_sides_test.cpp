#include "keenline/lines/find_sides.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/rough_lines.h"

namespace keenline {
namespace {

using test::LineScene;
using test::shape_options;

std::optional<LineSides> sides_at(const LineScene& scene, const Point& position, const Point& direction) {
  return find_sides(scene.synth.cloud, scene.search, position, unit(direction), LineKind::Crease,
                    scene.spacing);
}

double miss(const Side& side, const Point& p) {
  return side.surface.distance(side.surface.offset_of(p)) * side.surface.spacing;
}

TEST(FindSides, AreTheTwoFacesOfACubeHoweverTheLineIsOff) {
  const LineScene scene(shape_options("cube", 6000));
  const double h = scene.spacing;
  for (const Point& off : {Point{0, 0, 0}, Point{-h, 0, 0}, Point{0.5 * h, 0, 0.8 * h}, Point{-h, 0, -h}}) {
    // The edge x = z = 0.5 runs along y.
    const auto sides = sides_at(scene, sum({0.5, 0.1, 0.5}, off), {0.2, 1, 0.1});
    ASSERT_TRUE(sides);
    // Looking along +y from outside, -x is to the left.
    EXPECT_NEAR(distance(sides->left.surface.normal({}), {0, 0, 1}), 0, 1e-3);
    EXPECT_NEAR(distance(sides->right.surface.normal({}), {1, 0, 0}), 0, 1e-3);
    EXPECT_LT(sides->left.inward[0], -0.9);
    EXPECT_LT(sides->right.inward[2], -0.9);
    for (const Point& on_edge : {Point{0.5, 0.1, 0.5}, Point{0.5, -0.3, 0.5}}) {
      EXPECT_NEAR(miss(sides->left, on_edge), 0, 1e-3 * h);
      EXPECT_NEAR(miss(sides->right, on_edge), 0, 1e-3 * h);
    }
    EXPECT_GE(sides->left.support, 8U);
    EXPECT_LT(sides->left.residual, 0.01 * h);
  }
}

TEST(FindSides, AgainstTheDirectionLeftIsRight) {
  const LineScene scene(shape_options("cube", 6000));
  const auto forth = sides_at(scene, {0.5, 0.1, 0.5}, {0, 1, 0});
  const auto back = sides_at(scene, {0.5, 0.1, 0.5}, {0, -1, 0});
  ASSERT_TRUE(forth && back);
  EXPECT_LT(distance(forth->left.surface.normal({}), back->right.surface.normal({})), 1e-12);
  EXPECT_LT(distance(forth->right.surface.normal({}), back->left.surface.normal({})), 1e-12);
}

TEST(FindSides, ABentSideIsAQuadricAndAFlatOneIsNone) {
  const LineScene scene(shape_options("cylinder", 6000, 0.03));
  const double h = scene.spacing;
  const auto sides = sides_at(scene, {1 - 0.3 * h, 0, 1}, {0, 1, 0});
  ASSERT_TRUE(sides);
  const Side& top = std::abs(sides->left.surface.z[2]) > 0.9 ? sides->left : sides->right;
  const Side& wall = &top == &sides->left ? sides->right : sides->left;
  EXPECT_EQ(top.surface.height[3], 0);
  EXPECT_NEAR(wall.surface.height[3], -0.5 * h, 0.25 * h);  // half of 1 / radius, in spacings
  EXPECT_NEAR(miss(wall, {1, 0, 1}), 0, 0.15 * h);
  EXPECT_NEAR(miss(top, {1, 0, 1}), 0, 0.1 * h);
}

TEST(FindSides, NothingWhereNothingMeets) {
  const LineScene plane(shape_options("plane", 3000, 0.05));
  EXPECT_FALSE(sides_at(plane, {0, 0, 0}, {1, 0, 0}));
  EXPECT_FALSE(sides_at(plane, {0, 0, 5}, {1, 0, 0}));
  const LineScene sphere(shape_options("sphere", 3000));
  EXPECT_FALSE(sides_at(sphere, {0, 0, 1}, {1, 0, 0}));
  const LineScene cube(shape_options("cube", 3000));
  EXPECT_FALSE(sides_at(cube, {0.5, 0, 0.5}, {1, 0, 0}));  // no line runs that way
}

TEST(FindSides, NeedsPoints) {
  PointCloud cloud;
  const auto find = [&] {
    const NeighborSearch search(cloud.positions);
    return find_sides(cloud, search, {0, 0, 0}, {1, 0, 0}, LineKind::Crease, 1);
  };
  EXPECT_FALSE(find());
  cloud.positions.assign(1000, Point{0, 0, 0});
  EXPECT_FALSE(find());
  cloud.positions.assign(3, Point{3, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_FALSE(find());
}

TEST(FindSides, ABorderHasItsSurfaceAndARim) {
  const LineScene scene(shape_options("plane", 3000));
  const double h = scene.spacing;
  const auto sides =
      find_sides(scene.synth.cloud, scene.search, {0.5 - 0.5 * h, 0.1, 0}, {0, 1, 0}, LineKind::Border, h);
  ASSERT_TRUE(sides);
  EXPECT_NEAR(std::abs(sides->left.surface.normal({})[2]), 1, 1e-12);
  EXPECT_GT(sides->right.surface.normal({})[0], 0.9);
  EXPECT_NEAR(miss(sides->right, {0.5, 0.1, 0}), 0, 0.9 * h);
}

}  // namespace
}  // namespace keenline
