#include "keenline/synth/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::radians;
using kernels::sin_cos;

constexpr Vec3 clockwise{0, 0, -1};

Outline rectangle(double half_x, double half_y) {
  const std::array<Vec3, 4> vertices{
      {{-half_x, -half_y, 0}, {half_x, -half_y, 0}, {half_x, half_y, 0}, {-half_x, half_y, 0}}};
  return polygon_outline(vertices);
}

Shape box_of(double x, double y, double z) {
  ShapeBuilder builder;
  builder.prism({rectangle(0.5 * x, 0.5 * y)}, -0.5 * z, 0.5 * z);
  return std::move(builder).finish();
}

Shape build_cube(double /*angle*/) { return box_of(1, 1, 1); }

Shape build_box(double /*angle*/) { return box_of(3, 2, 1); }

/// A ball that rolls inside a cube touches this: squares, quarters of cylinders and eighths of spheres.
Shape build_rounded_cube(double /*angle*/) {
  constexpr double radius = 0.045;
  constexpr double inner = 0.5 - radius;
  const std::array<Vec3, 4> quarters{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  ShapeBuilder builder;
  for (const Frame& frame :
       {Frame{}, Frame{{}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}}, Frame{{}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}}}) {
    const auto add = [&](auto face) { builder.face(std::make_unique<MovedFace>(frame, std::move(face))); };
    for (const double z : {-0.5, 0.5})
      add(std::make_unique<PlaneFace>(Frame{.origin = {0, 0, z}},
                                      std::vector<Outline>{rectangle(inner, inner)}));
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3& from = quarters[i];
      const Vec3& to = quarters[(i + 1) % 4];
      const Vec3 axis = inner * (from + to);
      const Curve turn = Curve::arc(from, to, {});
      add(std::make_unique<RevolvedFace>(axis, Curve::segment({radius, -inner, 0}, {radius, inner, 0}),
                                         turn));
      const Vec3 corner = 0.5 * (from + to);
      builder.designed(Curve::segment(corner + Vec3{0, 0, -0.5}, corner + Vec3{0, 0, 0.5}).mapped(frame));
      if (frame.z.z == 0) continue;
      for (const double side : {-1.0, 1.0}) {
        const Curve profile =
            Curve::arc({radius, side * inner, 0}, {0, side * 0.5, 0}, {0, side * inner, 0}, {0, 0, side});
        builder.face(std::make_unique<RevolvedFace>(axis, profile, turn));
      }
    }
  }
  return std::move(builder).finish();
}

Shape build_plane(double /*angle*/) {
  ShapeBuilder builder;
  builder.cap({rectangle(0.5, 0.5)}, 0);
  for (const Curve& side : rectangle(0.5, 0.5)) builder.border(side);
  return std::move(builder).finish();
}

/// Two unit squares that hang down from a common edge on the y axis.
Shape build_crease(double angle_deg) {
  const auto [sin, cos] = sin_cos(radians(0.5 * angle_deg));
  const Vec3 front{0, -0.5, 0};
  const Vec3 back{0, 0.5, 0};
  ShapeBuilder builder;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 across{side * sin, 0, -cos};
    builder.polygon({front, back, back + across, front + across});
    builder.border(Curve::segment(front, front + across));
    builder.border(Curve::segment(front + across, back + across));
    builder.border(Curve::segment(back + across, back));
  }
  if (angle_deg != 180) builder.edge(Curve::segment(front, back));
  return std::move(builder).finish();
}

/// Edge length 2. Corners: (0, ±1, ±golden ratio) and its cyclic shifts.
Shape build_icosahedron(double /*angle*/) {
  const double golden = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> vertices;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      vertices.insert(vertices.end(), {{0, a, b}, {a, b, 0}, {b, 0, a}});
    }
  }
  const auto adjacent = [&](std::size_t i, std::size_t j) {
    return distance(vertices[i], vertices[j]) < 2.5;
  };
  std::vector<std::vector<std::size_t>> triangles;
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k)
        if (adjacent(i, j) && adjacent(j, k) && adjacent(i, k)) triangles.push_back({i, j, k});
    }
  }
  ShapeBuilder builder;
  builder.polygons(vertices, triangles);
  return std::move(builder).finish();
}

Shape build_cylinder(double /*angle*/) {
  ShapeBuilder builder;
  builder.prism({circle_outline({}, 1)}, -1, 1);
  return std::move(builder).finish();
}

/// Slant height 1, so that no opening angle makes it huge.
Shape build_cone(double angle_deg) {
  const auto [sin, cos] = sin_cos(radians(0.5 * angle_deg));
  ShapeBuilder builder;
  builder.revolve({Curve::segment({0, 0, 0}, {sin, 0, 0}), Curve::segment({sin, 0, 0}, {0, cos, 0})});
  return std::move(builder).finish();
}

Shape build_sphere(double /*angle*/) {
  ShapeBuilder builder;
  builder.revolve({Curve::arc({0, -1, 0}, {0, 1, 0}, {})});
  return std::move(builder).finish();
}

Shape build_torus(double /*angle*/) {
  ShapeBuilder builder;
  builder.revolve({Curve::circle({1, 0, 0}, 0.4)});
  return std::move(builder).finish();
}

/// A flat foot with a sharp edge, a belly and a narrow neck in one smooth line, an open rim.
Shape build_vase(double /*angle*/) {
  ShapeBuilder builder;
  builder.revolve({Curve::segment({0, 0, 0}, {0.4, 0, 0}),
                   Curve::arc({0.4, 0, 0}, {0.4, 0.8, 0}, {0.1, 0.4, 0}),
                   Curve::arc({0.4, 0.8, 0}, {0.4, 1.6, 0}, {0.7, 1.2, 0}, clockwise)});
  return std::move(builder).finish();
}

Shape build_through_hole(double /*angle*/) {
  ShapeBuilder builder;
  builder.prism({rectangle(1, 1), circle_outline({}, 0.5)}, -0.5, 0.5);
  return std::move(builder).finish();
}

/// A five-pointed star: upright walls, then a taper to a smaller top, and a bore through it all.
Shape build_trim_star(double /*angle*/) {
  constexpr std::size_t sides = 10;
  constexpr double bottom = -0.3;
  constexpr double belt = 0.1;
  constexpr double top = 0.3;
  constexpr double taper = 0.8;
  const auto ring = [](double scale, double z) {
    std::vector<Vec3> vertices;
    for (std::size_t i = 0; i < sides; ++i) {
      const auto [sin, cos] = sin_cos(radians(90 + 36 * static_cast<double>(i)));
      const double radius = scale * (i % 2 == 0 ? 1 : 0.5);
      vertices.push_back({radius * cos, radius * sin, z});
    }
    return vertices;
  };
  std::vector<Vec3> vertices = ring(1, bottom);
  for (const auto& level : {ring(1, belt), ring(taper, top)})
    vertices.insert(vertices.end(), level.begin(), level.end());
  std::vector<std::vector<std::size_t>> quads;
  for (const std::size_t level : {std::size_t{0}, sides}) {
    for (std::size_t i = 0; i < sides; ++i) {
      const std::size_t next = (i + 1) % sides;
      quads.push_back({level + i, level + next, level + sides + next, level + sides + i});
    }
  }
  const Outline bore = circle_outline({}, 0.25);
  ShapeBuilder builder;
  builder.polygons(vertices, quads);
  builder.cap({polygon_outline(ring(1, 0)), bore}, bottom);
  builder.cap({polygon_outline(ring(taper, 0)), bore}, top);
  builder.rim(bore, bottom);
  builder.rim(bore, top);
  builder.wall(bore, bottom, top);
  return std::move(builder).finish();
}

/// After the fandisk test part: lines run smoothly into arcs (no edges there), arcs meet lines and arcs at an
/// angle (edges, some of them curved), with a step, a boss and a bore.
Shape build_fandisk(double /*angle*/) {
  constexpr double bottom = -0.3;
  constexpr double step = 0.1;
  constexpr double top = 0.3;
  const Outline base{Curve::segment({-1, -0.6, 0}, {0.6, -0.6, 0}),
                     Curve::arc({0.6, -0.6, 0}, {1, -0.2, 0}, {0.6, -0.2, 0}),
                     Curve::segment({1, -0.2, 0}, {1, 0.2, 0}),
                     Curve::arc({1, 0.2, 0}, {0.6, 0.6, 0}, {1, 0.6, 0}, clockwise),
                     Curve::segment({0.6, 0.6, 0}, {-0.4, 0.6, 0}),
                     Curve::arc({-0.4, 0.6, 0}, {-1, 0, 0}, {-0.4, 0, 0}),
                     Curve::segment({-1, 0, 0}, {-1, -0.6, 0})};
  const Outline boss{Curve::arc({-0.7, -0.1, 0}, {0.1, -0.1, 0}, {-0.3, 0.2, 0}),
                     Curve::arc({0.1, -0.1, 0}, {-0.7, -0.1, 0}, {-0.3, -0.1, 0})};
  const Outline bore = circle_outline({-0.3, 0, 0}, 0.15);
  ShapeBuilder builder;
  builder.cap({base, bore}, bottom);
  builder.wall(base, bottom, step);
  builder.cap({base, boss}, step);
  builder.wall(boss, step, top);
  builder.cap({boss, bore}, top);
  builder.wall(bore, bottom, top);
  for (const Outline* outline : {&base, &bore}) builder.rim(*outline, bottom);
  for (const Outline* outline : {&base, &boss}) builder.rim(*outline, step);
  for (const Outline* outline : {&boss, &bore}) builder.rim(*outline, top);
  return std::move(builder).finish();
}

constexpr std::array rows{
    ShapeRow{{"plane", "unit square: nothing sharp, four borders", {}}, build_plane},
    ShapeRow{{"crease", "two squares that meet at a dihedral angle", AngleRange{1, 359, 90}}, build_crease},
    ShapeRow{{"cube", "side 1", {}}, build_cube},
    ShapeRow{{"rounded-cube", "side 1, edges rounded with radius 0.045; true lines are the edges before", {}},
             build_rounded_cube},
    ShapeRow{{"box", "sides 3, 2, 1", {}}, build_box},
    ShapeRow{{"icosahedron", "20 triangles of side 2", {}}, build_icosahedron},
    ShapeRow{{"cylinder", "radius 1, height 2, closed", {}}, build_cylinder},
    ShapeRow{{"cone", "slant height 1, closed, with an opening angle", AngleRange{1, 179, 60}}, build_cone},
    ShapeRow{{"sphere", "radius 1: nothing sharp", {}}, build_sphere},
    ShapeRow{{"torus", "radii 1 and 0.4: nothing sharp", {}}, build_torus},
    ShapeRow{{"vase", "smooth body, sharp foot, open rim", {}}, build_vase},
    ShapeRow{{"through-hole", "box 2 x 2 x 1 with a hole of radius 0.5", {}}, build_through_hole},
    ShapeRow{{"trim-star", "tapered five-pointed star with a bore", {}}, build_trim_star},
    ShapeRow{{"fandisk", "machine part: smooth fillets, curved edges, a boss, a bore", {}}, build_fandisk},
};

}  // namespace

std::span<const ShapeRow> shape_rows() { return rows; }

const ShapeRow* find_shape(std::string_view name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const ShapeRow& row) { return row.shape.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace keenline::synth
