#pragma once

#include <cmath>
#include <vector>

#include "keenline/cloud.h"

namespace keenline::test {

/// Evenly by area over a sector of the unit disc about the origin: `u` to `u` + sweep in the plane of u and
/// v.
inline void add_sector(std::vector<Point>& points, const Point& u, const Point& v, double sweep) {
  constexpr int rings = 60;
  for (int ring = 0; ring < rings; ++ring) {
    const double radius = (ring + 0.5) / rings;
    const int steps = static_cast<int>(std::lround(sweep * (2 * ring + 1)));
    for (int step = 0; step < steps; ++step) {
      const double angle = sweep * (step + 0.5) / steps;
      const double x = radius * std::cos(angle);
      const double y = radius * std::sin(angle);
      points.push_back({x * u[0] + y * v[0], x * u[1] + y * v[1], x * u[2] + y * v[2]});
    }
  }
}

/// Two half discs of radius 1 that meet in the x axis at this angle: what a point on an edge has around it.
inline std::vector<Point> ideal_edge(double degrees) {
  const double pi = std::acos(-1.0);
  const double angle = degrees * pi / 180;
  std::vector<Point> points;
  add_sector(points, {1, 0, 0}, {0, 1, 0}, pi);
  add_sector(points, {1, 0, 0}, {0, std::cos(angle), std::sin(angle)}, pi);
  return points;
}

/// Half a disc: a point on the rim of an open surface.
inline std::vector<Point> ideal_border() {
  std::vector<Point> points;
  add_sector(points, {1, 0, 0}, {0, 1, 0}, std::acos(-1.0));
  return points;
}

/// Three quarter discs: the corner of a cube.
inline std::vector<Point> ideal_cube_corner() {
  const double quarter = std::acos(-1.0) / 2;
  std::vector<Point> points;
  add_sector(points, {1, 0, 0}, {0, 1, 0}, quarter);
  add_sector(points, {0, 1, 0}, {0, 0, 1}, quarter);
  add_sector(points, {0, 0, 1}, {1, 0, 0}, quarter);
  return points;
}

}  // namespace keenline::test
