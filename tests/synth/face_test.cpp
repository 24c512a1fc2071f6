#include "keenline/synth/face.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::pi;

constexpr double infinity = std::numeric_limits<double>::infinity();

Outline square(double half) {
  const std::array<Vec3, 4> v{{{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}};
  return {Curve::segment(v[0], v[1]), Curve::segment(v[1], v[2]), Curve::segment(v[2], v[3]),
          Curve::segment(v[3], v[0])};
}

/// The square of side 2 with one corner rounded, one bitten off by an arc, and a round hole.
PlaneFace plate() {
  return {{.origin = {0, 0, 1}},
          {{Curve::segment({-1, -1, 0}, {0.5, -1, 0}), Curve::arc({0.5, -1, 0}, {1, -0.5, 0}, {0.5, -0.5, 0}),
            Curve::segment({1, -0.5, 0}, {1, 0.5, 0}),
            Curve::arc({1, 0.5, 0}, {0.5, 1, 0}, {1, 1, 0}, {0, 0, -1}),
            Curve::segment({0.5, 1, 0}, {-1, 1, 0}), Curve::segment({-1, 1, 0}, {-1, -1, 0})},
           {Curve::circle({-0.25, 0, 0}, 0.5)}}};
}

bool on_plate(const Vec3& p) {
  if (std::abs(p.x) > 1 || std::abs(p.y) > 1) return false;
  if (p.x > 0.5 && p.y < -0.5 && std::hypot(p.x - 0.5, p.y + 0.5) > 0.5) return false;
  return std::hypot(p.x - 1, p.y - 1) > 0.5 && std::hypot(p.x + 0.25, p.y) > 0.5;
}

TEST(PlaneFace, area_counts_arcs_and_holes) {
  const double rounded_off = 0.25 - pi / 16;
  EXPECT_NEAR(plate().area(), 4 - rounded_off - pi / 16 - pi / 4, 1e-14);
}

TEST(PlaneFace, rays_hit_exactly_the_inside) {
  const PlaneFace face = plate();
  RandomStream random(3, Purpose::Position, 0);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 target{2.4 * random.uniform() - 1.2, 2.4 * random.uniform() - 1.2, 1};
    const Vec3 origin = target + Vec3{1, 2, 2};
    const double t = face.hit({origin, {-1.0 / 3, -2.0 / 3, -2.0 / 3}});
    ASSERT_EQ(t < infinity, on_plate(target)) << target.x << ' ' << target.y;
    if (t < infinity) {
      ASSERT_NEAR(t, 3, 1e-14);
    }
  }
}

TEST(PlaneFace, lines_through_vertices_and_chords_are_counted_once) {
  const PlaneFace face = plate();
  // Multiples of 1/8 meet vertices, sides, and the ends and the chord of both arcs.
  for (int i = -9; i <= 9; ++i) {
    for (int j = -9; j <= 9; ++j) {
      const Vec3 p{i / 8.0, j / 8.0, 1};
      const double from_bite = std::hypot(p.x - 1, p.y - 1);
      const double from_hole = std::hypot(p.x + 0.25, p.y);
      const double from_round = std::hypot(p.x - 0.5, p.y + 0.5);
      if (std::abs(i) == 8 || std::abs(j) == 8 || from_bite == 0.5 || from_hole == 0.5 || from_round == 0.5)
        continue;
      EXPECT_EQ(face.hit({p + Vec3{0, 0, 1}, {0, 0, -1}}) < infinity, on_plate(p)) << i << ' ' << j;
    }
  }
}

TEST(PlaneFace, rays_miss_behind_and_beside) {
  const PlaneFace face = plate();
  EXPECT_EQ(face.hit({{0.9, 0, 2}, {0, 0, 1}}), infinity);
  EXPECT_EQ(face.hit({{0.9, 0, 1}, {1, 0, 0}}), infinity);
  EXPECT_EQ(face.hit({{0.9, 0, 2}, {1, 0, 0}}), infinity);
}

TEST(PlaneFace, lattice_keeps_half_a_step_off_and_is_exactly_regular) {
  const PlaneFace face({}, {square(0.5)});
  std::vector<Vec3> points;
  face.add_lattice(0.1, points, no_progress());
  ASSERT_EQ(points.size(), 100U);
  std::set<double> steps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(std::abs(points[i].x), 0.45);
    EXPECT_LE(std::abs(points[i].y), 0.45);
    if (i % 10 != 0) steps.insert(points[i].x - points[i - 1].x);
  }
  ASSERT_EQ(steps.size(), 1U);  // not even the last bit differs
  EXPECT_NEAR(*steps.begin(), 0.1, 0.1 / 2048);
}

TEST(RevolvedFace, areas_are_the_textbook_ones) {
  const Curve whole = Curve::circle({}, 1);
  const Curve quarter = Curve::arc({1, 0, 0}, {0, 1, 0}, {});
  EXPECT_NEAR(RevolvedFace({}, Curve::segment({2, 0, 0}, {2, 3, 0}), whole).area(), 12 * pi, 1e-13);
  EXPECT_NEAR(RevolvedFace({}, Curve::segment({2, 0, 0}, {2, 3, 0}), quarter).area(), 3 * pi, 1e-13);
  EXPECT_NEAR(RevolvedFace({}, Curve::segment({3, 0, 0}, {0, 4, 0}), whole).area(), 15 * pi, 1e-13);
  EXPECT_NEAR(RevolvedFace({}, Curve::arc({0, -2, 0}, {0, 2, 0}, {}), whole).area(), 16 * pi, 1e-13);
  EXPECT_NEAR(RevolvedFace({}, Curve::circle({2, 0, 0}, 1), whole).area(), 8 * pi * pi, 1e-13);
}

TEST(RevolvedFace, random_points_are_uniform_by_area) {
  // On a sphere z is uniform (Archimedes); on a cone the share up to radius r is r^2.
  const RevolvedFace sphere({}, Curve::arc({0, -1, 0}, {0, 1, 0}, {}), Curve::circle({}, 1));
  const RevolvedFace cone({}, Curve::segment({1, 0, 0}, {0, 1, 0}), Curve::circle({}, 1));
  constexpr std::size_t bins = 20;
  constexpr int count = 20000;
  std::array<double, bins> by_height{};
  std::array<double, bins> by_radius{};
  RandomStream random(4, Purpose::Position, 0);
  for (int i = 0; i < count; ++i) {
    by_height[static_cast<std::size_t>((0.5 + 0.5 * sphere.random_point(random).z) * bins)] += 1;
    const Vec3 p = cone.random_point(random);
    by_radius[static_cast<std::size_t>((p.x * p.x + p.y * p.y) * bins)] += 1;
  }
  for (const auto& histogram : {by_height, by_radius}) {
    double chi_squared = 0;
    for (const double n : histogram) chi_squared += (n - 1000) * (n - 1000) / 1000;
    EXPECT_LT(chi_squared, 19 + 5 * 6.2);  // 19 degrees of freedom
  }
}

TEST(RevolvedFace, rays_meet_torus_sphere_and_cone_where_geometry_says) {
  const Curve whole = Curve::circle({}, 1);
  const RevolvedFace torus({5, 0, 0}, Curve::circle({1, 0, 0}, 0.25), whole);
  EXPECT_NEAR(torus.hit({{5, -8, 0}, {0, 1, 0}}), 8 - 1.25, 1e-14);
  EXPECT_NEAR(torus.hit({{5, 0, 0}, {0, 1, 0}}), 0.75, 1e-14);  // from within the hole
  EXPECT_NEAR(torus.hit({{6, 0, 9}, {0, 0, -1}}), 8.75, 1e-14);
  EXPECT_EQ(torus.hit({{5, 0, 9}, {0, 0, -1}}), infinity);  // through the hole

  const RevolvedFace half_sphere({}, Curve::arc({0, -1, 0}, {0, 1, 0}, {}),
                                 Curve::arc({0, -1, 0}, {0, 1, 0}, {}));
  EXPECT_NEAR(half_sphere.hit({{3, 0, 0}, {-1, 0, 0}}), 2, 1e-14);
  EXPECT_NEAR(half_sphere.hit({{-3, 0, 0}, {1, 0, 0}}), 4, 1e-14);  // the near half is not there

  const RevolvedFace cone({}, Curve::segment({1, 0, 0}, {0, 1, 0}), whole);
  EXPECT_NEAR(cone.hit({{2, 0, 0.5}, {-1, 0, 0}}), 1.5, 1e-14);
  EXPECT_EQ(cone.hit({{2, 0, 1.5}, {-1, 0, 0}}), infinity);  // the other nappe is not the face's
}

TEST(RevolvedFace, rays_towards_random_surface_points_arrive_there_or_earlier_on_the_surface) {
  const RevolvedFace torus({}, Curve::circle({1, 0, 0}, 0.4), Curve::circle({}, 1));
  int arrived = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    RandomStream random(6, Purpose::Position, i);
    const Vec3 target = torus.random_point(random);
    const Vec3 origin = 5 * unit(random.normal_vector());
    const Ray ray{origin, unit(target - origin)};
    const double t = torus.hit(ray);
    ASSERT_LE(t, distance(origin, target) + 1e-7);
    const Vec3 p = origin + t * ray.direction;
    ASSERT_NEAR(std::hypot(std::hypot(p.x, p.y) - 1, p.z), 0.4, 1e-13);
    arrived += distance(p, target) < 1e-7 ? 1 : 0;
  }
  EXPECT_GT(arrived, 600);
  EXPECT_LT(arrived, 1200);  // more than half of the surface faces away
}

TEST(RevolvedFace, bounds_are_tight) {
  const RevolvedFace quarter_ring({1, 0, 0}, Curve::circle({2, 5, 0}, 0.5),
                                  Curve::arc({1, 0, 0}, {0, 1, 0}, {}));
  const Box box = quarter_ring.bounds();
  EXPECT_LT(distance(box.low, {1, 0, 4.5}), 1e-15);
  EXPECT_LT(distance(box.high, {3.5, 2.5, 5.5}), 1e-15);
}

}  // namespace
}  // namespace keenline::synth
