#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/synth/shapes.h"

namespace keenline::test {

/// A shape of the table, at its standard angle unless told.
inline synth::Shape build(std::string_view name, std::optional<double> angle_deg = {}) {
  const synth::ShapeRow* row = synth::find_shape(name);
  if (row == nullptr) {
    ADD_FAILURE() << "no shape " << name;
    return {};
  }
  return row->build(angle_deg.value_or(row->shape.angle.value_or(AngleRange{}).standard));
}

/// Independent descriptions of the shapes: zero on the surface, negative inside, positive outside.
using Implicit = std::function<double(const Point&)>;

inline double star_gauge(double x, double y) {
  constexpr double degree = 3.14159265358979323846 / 180;
  // Folded into the wedge from the tip at angle 0 to the notch at 36 degrees.
  const double angle = std::abs(std::remainder(std::atan2(y, x) - 90 * degree, 72 * degree));
  const double r = std::hypot(x, y);
  const double notch_x = 0.5 * std::cos(36 * degree);
  const double notch_y = 0.5 * std::sin(36 * degree);
  // The line through (1, 0) and the notch: n . p = n . (1, 0)
  const double nx = notch_y;
  const double ny = 1 - notch_x;
  return r * (nx * std::cos(angle) + ny * std::sin(angle)) / nx;
}

inline double trim_star(const Point& p) {
  const double size = std::min(1.0, 1 - (p[2] - 0.1));  // falls from 1 to 0.8 between z = 0.1 and 0.3
  return std::max({std::abs(p[2]) - 0.3, 0.25 - std::hypot(p[0], p[1]), star_gauge(p[0], p[1]) - size});
}

inline double fandisk(const Point& p) {
  const auto [x, y, z] = p;
  double base = std::max({std::abs(x) - 1, std::abs(y) - 0.6, 0.4 - std::hypot(x - 1, y - 0.6)});
  if (x > 0.6 && y < -0.2) base = std::max(base, std::hypot(x - 0.6, y + 0.2) - 0.4);
  if (x < -0.4 && y > 0) base = std::max(base, std::hypot(x + 0.4, y) - 0.6);
  const double boss = y >= -0.1 ? std::hypot(x + 0.3, y + 0.1) - 0.4 : std::hypot(x + 0.3, y - 0.2) - 0.5;
  const double low = std::max(base, std::abs(z + 0.1) - 0.2);
  const double high = std::max(boss, std::abs(z) - 0.3);
  return std::max(std::min(low, high), 0.15 - std::hypot(x + 0.3, y));
}

inline double vase(const Point& p) {
  const double r = std::hypot(p[0], p[1]);
  const double body =
      p[2] <= 0.8 ? std::hypot(r - 0.1, p[2] - 0.4) - 0.5 : 0.5 - std::hypot(r - 0.7, p[2] - 1.2);
  return std::max(-p[2], body);
}

inline double box(const Point& p, double x, double y, double z) {
  return std::max({std::abs(p[0]) - x / 2, std::abs(p[1]) - y / 2, std::abs(p[2]) - z / 2});
}

/// Distance from a cube that is smaller by the radius all round, less the radius.
inline double rounded_cube(const Point& p) {
  constexpr double radius = 0.045;
  const double smaller = box(p, 1 - 2 * radius, 1 - 2 * radius, 1 - 2 * radius);
  const auto beyond = [&](double x) { return std::max(0.0, std::abs(x) - 0.5 + radius); };
  const double distance = std::hypot(beyond(p[0]), beyond(p[1]), beyond(p[2]));
  return std::min(smaller, 0.0) + distance - radius;
}

inline double icosahedron(const Point& p) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  const auto [x, y, z] = Point{std::abs(p[0]), std::abs(p[1]), std::abs(p[2])};
  const double farthest =
      std::max({x + y + z, x / golden + z * golden, y / golden + x * golden, z / golden + y * golden});
  return (farthest - golden * golden) / std::sqrt(3.0);
}

/// Of every shape, at its standard angle.
inline const std::map<std::string, Implicit>& implicits() {
  static const std::map<std::string, Implicit> all{
      {"plane", [](const Point& p) { return p[2]; }},
      {"crease", [](const Point& p) { return (std::abs(p[0]) + p[2]) / std::sqrt(2.0); }},
      {"cube", [](const Point& p) { return box(p, 1, 1, 1); }},
      {"box", [](const Point& p) { return box(p, 3, 2, 1); }},
      {"rounded-cube", rounded_cube},
      {"icosahedron", icosahedron},
      {"cylinder", [](const Point& p) { return std::max(std::hypot(p[0], p[1]) - 1, std::abs(p[2]) - 1); }},
      {"cone",
       [](const Point& p) {
         const double height = std::sqrt(3.0) / 2;
         return std::max(-p[2], height * std::hypot(p[0], p[1]) + 0.5 * (p[2] - height));
       }},
      {"sphere", [](const Point& p) { return std::hypot(p[0], p[1], p[2]) - 1; }},
      {"torus", [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.4; }},
      {"vase", vase},
      {"through-hole",
       [](const Point& p) { return std::max(box(p, 2, 2, 1), 0.5 - std::hypot(p[0], p[1])); }},
      {"trim-star", trim_star},
      {"fandisk", fandisk},
  };
  return all;
}

}  // namespace keenline::test
