#include "keenline/synth/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"
#include "keenline/synth/curve_network.h"

#include "synth/test_shapes.h"

namespace keenline::synth {
namespace {

using kernels::pi;
using kernels::radians;
using kernels::sin_cos;

using test::build;

double total_length(const std::vector<Curve>& curves) {
  double sum = 0;
  for (const Curve& curve : curves) sum += curve.length();
  return sum;
}

TEST(Shapes, each_has_its_implicit_twin_in_the_tests) {
  ASSERT_EQ(shape_rows().size(), test::implicits().size());
  for (const ShapeRow& row : shape_rows())
    EXPECT_EQ(test::implicits().count(std::string(row.shape.name)), 1U) << row.shape.name;
}

TEST(Shapes, areas_have_closed_forms) {
  const double belly = std::asin(0.8);  // the vase's arcs reach this far above and below their centres
  const std::map<std::string, double> areas{
      {"plane", 1},
      {"crease", 2},
      {"cube", 6},
      {"rounded-cube", 6 * 0.91 * 0.91 + 12 * 0.91 * 0.5 * pi * 0.045 + 4 * pi * 0.045 * 0.045},
      {"box", 22},
      {"icosahedron", 20 * std::sqrt(3.0)},
      {"cylinder", 6 * pi},
      {"cone", 0.75 * pi},
      {"sphere", 4 * pi},
      {"torus", 1.6 * pi * pi},
      {"vase", 0.16 * pi + 2 * pi * ((0.1 * belly + 0.4) + (0.7 * belly - 0.4))},
      {"through-hole", 8 + 8 - 0.5 * pi + pi},
  };
  for (const auto& [name, area] : areas) EXPECT_NEAR(build(name).area(), area, 1e-13) << name;
}

TEST(Shapes, features_are_counted_and_measured) {
  struct Expected {
    std::size_t edges;
    double length;
    std::size_t corners;
    std::size_t peaks;
    std::size_t borders;
  };
  const double boss_arc = 2 * std::asin(0.8) * 0.5;  // half chord 0.4, radius 0.5
  const double base_rim = 1.6 + 0.2 * pi + 0.4 + 0.2 * pi + 1 + 0.3 * pi + 0.6;
  const std::map<std::string, Expected> table{
      {"plane", {0, 0, 0, 0, 4}},
      {"crease", {1, 1, 0, 0, 6}},
      {"cube", {12, 12, 8, 0, 0}},
      {"rounded-cube", {0, 0, 0, 0, 0}},
      {"box", {12, 24, 8, 0, 0}},
      {"icosahedron", {30, 60, 12, 0, 0}},
      {"cylinder", {2, 4 * pi, 0, 0, 0}},
      {"cone", {1, pi, 0, 1, 0}},
      {"sphere", {0, 0, 0, 0, 0}},
      {"torus", {0, 0, 0, 0, 0}},
      {"vase", {1, 0.8 * pi, 0, 0, 1}},
      {"through-hole", {14, 20 + 2 * pi, 8, 0, 0}},
      // Base: two rims and three upright edges; boss: two rims and two upright edges; two rims of the bore.
      {"fandisk", {25, 2 * base_rim + 1.2 + 2 * (boss_arc + 0.4 * pi) + 0.4 + 0.6 * pi, 10, 0, 0}},
  };
  for (const auto& [name, expected] : table) {
    const Shape shape = build(name);
    EXPECT_EQ(shape.edges.size(), expected.edges) << name;
    EXPECT_NEAR(total_length(shape.edges), expected.length, 1e-13) << name;
    EXPECT_EQ(shape.corners.size(), expected.corners) << name;
    EXPECT_EQ(shape.peaks.size(), expected.peaks) << name;
    EXPECT_EQ(shape.borders.size(), expected.borders) << name;
  }
}

TEST(Shapes, a_rounded_cube_was_drawn_as_a_cube) {
  const Shape rounded = build("rounded-cube");
  EXPECT_EQ(rounded.faces.size(), 6U + 12 + 8);
  EXPECT_EQ(rounded.designed.size(), 12U);
  EXPECT_EQ(total_length(rounded.designed), 12);
  EXPECT_EQ(corners_of(rounded.designed).size(), 8U);
  for (const Curve& edge : rounded.designed)
    EXPECT_NEAR(distance_to(build("cube").edges, edge.at(0.3)), 0, 1e-15);
  // Half-way round, surface and edge are (sqrt(2) - 1) radii apart.
  EXPECT_NEAR(test::implicits().at("rounded-cube")(rounded.designed[0].at(0.5).point()),
              (std::sqrt(2.0) - 1) * 0.045, 1e-15);
}

TEST(Shapes, trim_star_obeys_euler) {
  const Shape star = build("trim-star");
  // V - E + F = 2 for the star without its bore, which adds two circles and one face.
  EXPECT_EQ(star.corners.size(), 30U);
  EXPECT_EQ(star.edges.size(), 50U + 2);
  EXPECT_EQ(star.faces.size(), 22U + 1);
}

TEST(Shapes, every_corner_ends_at_least_two_edges_and_every_free_end_lies_on_a_border) {
  for (const ShapeRow& row : shape_rows()) {
    const Shape shape = build(row.shape.name);
    const auto ends_at = [&](const Vec3& p) {
      return std::count_if(shape.edges.begin(), shape.edges.end(), [&](const Curve& edge) {
        return !edge.is_circle() && (distance(edge.start(), p) < 1e-12 || distance(edge.end(), p) < 1e-12);
      });
    };
    for (const Vec3& corner : shape.corners) EXPECT_GE(ends_at(corner), 2) << row.shape.name;
    for (const Vec3& end : ends_of(shape.edges))
      EXPECT_TRUE(ends_at(end) > 1 || distance_to(shape.borders, end) < 1e-12) << row.shape.name;
  }
}

TEST(Shapes, surface_and_edges_lie_on_the_implicit_surface) {
  for (const ShapeRow& row : shape_rows()) {
    const Shape shape = build(row.shape.name);
    const auto& implicit = test::implicits().at(std::string(row.shape.name));
    RandomStream random(1, Purpose::Position, 0);
    for (const auto& face : shape.faces) {
      for (int i = 0; i < 300; ++i) {
        ASSERT_NEAR(implicit(face->random_point(random).point()), 0, 1e-12) << row.shape.name;
      }
    }
    for (const auto* curves : {&shape.edges, &shape.borders}) {
      for (const Curve& curve : *curves) {
        for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
          EXPECT_NEAR(implicit(curve.at(t).point()), 0, 1e-12) << row.shape.name;
        }
      }
    }
  }
}

/// Unit gradient of the implicit surface.
Vec3 normal_at(const test::Implicit& implicit, const Vec3& p) {
  constexpr double h = 1e-6;
  const auto along = [&](const Vec3& d) {
    return implicit((p + h * d).point()) - implicit((p - h * d).point());
  };
  return unit({along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})});
}

TEST(Shapes, no_sharp_edge_is_missing) {
  // Away from all known edges, close points have close normals: where curvature is at most 1 / 0.15, the
  // angle over a distance of 0.04 stays below 16 degrees, and all kinks turn by more.
  const double least_cosine = sin_cos(radians(16)).cos;
  for (const char* name :
       {"cube", "box", "icosahedron", "cylinder", "torus", "vase", "through-hole", "trim-star", "fandisk"}) {
    const Shape shape = build(name);
    const auto& implicit = test::implicits().at(name);
    RandomStream random(2, Purpose::Position, 0);
    for (const auto& face : shape.faces) {
      for (int i = 0; i < 300; ++i) {
        const Vec3 p = face->random_point(random);
        if (distance_to(shape.edges, p) < 0.05 || distance_to(shape.borders, p) < 0.05) continue;
        const Vec3 normal = normal_at(implicit, p);
        // A nearby point of the surface: step sideways, then back onto the surface along the normal.
        const Vec3 beside = p + 0.03 * unit(cross(normal, random.normal_vector()));
        double low = -0.02;
        double high = 0.02;
        ASSERT_LT(implicit((beside + low * normal).point()), 0) << name;
        ASSERT_GT(implicit((beside + high * normal).point()), 0) << name;
        while (high - low > 1e-12) {
          const double middle = 0.5 * (low + high);
          (implicit((beside + middle * normal).point()) < 0 ? low : high) = middle;
        }
        ASSERT_GT(dot(normal, normal_at(implicit, beside + low * normal)), least_cosine)
            << name << ' ' << p.x << ' ' << p.y << ' ' << p.z;
      }
    }
  }
}

TEST(Shapes, smooth_transitions_of_the_fandisk_are_no_edges) {
  const Shape fandisk = build("fandisk");
  // On the seam between a plane wall and its fillet, half-way up: the nearest edges are the rims.
  EXPECT_NEAR(distance_to(fandisk.edges, {1, -0.2, -0.1}), 0.2, 1e-14);
  EXPECT_NEAR(distance_to(fandisk.edges, {-1, 0, -0.1}), 0.2, 1e-14);
  // Where an arc meets a line at an angle there is one.
  EXPECT_NEAR(distance_to(fandisk.edges, {1, 0.2, -0.1}), 0, 1e-14);
}

TEST(Shapes, crease_opens_by_its_angle) {
  for (const double angle : {30.0, 90.0, 179.0, 270.0}) {
    const Shape crease = build("crease", angle);
    ASSERT_EQ(crease.edges.size(), 1U);
    // Between the middles of the outer borders, seen from the edge.
    const Vec3 left = crease.borders[1].at(0.5);
    const Vec3 right = crease.borders[4].at(0.5);
    const double inner = std::min(angle, 360 - angle);
    EXPECT_NEAR(std::acos(dot(left, right)), radians(inner), 1e-12);
    EXPECT_EQ(left.z > 0, angle > 180);
  }
  EXPECT_TRUE(build("crease", 180).edges.empty());
}

TEST(Shapes, cone_opens_by_its_angle) {
  const Shape cone = build("cone", 90);
  EXPECT_NEAR(cone.peaks[0].z, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(cone.edges[0].radius(), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(cone.area(), pi * (0.5 + std::sqrt(0.5)), 1e-14);
}

TEST(Shapes, bounding_boxes_are_tight) {
  const std::map<std::string, double> diagonals{{"cube", std::sqrt(3.0)},
                                                {"rounded-cube", std::sqrt(3.0)},
                                                {"box", std::sqrt(14.0)},
                                                {"cylinder", std::sqrt(12.0)},
                                                {"cone", std::sqrt(2.75)},
                                                {"sphere", std::sqrt(12.0)},
                                                {"torus", std::sqrt(2 * 2.8 * 2.8 + 0.64)},
                                                {"vase", std::sqrt(2 * 1.2 * 1.2 + 1.6 * 1.6)},
                                                {"fandisk", std::sqrt(4 + 1.44 + 0.36)}};
  for (const auto& [name, diagonal] : diagonals)
    EXPECT_NEAR(build(name).bounds().diagonal(), diagonal, 1e-14) << name;
}

}  // namespace
}  // namespace keenline::synth
