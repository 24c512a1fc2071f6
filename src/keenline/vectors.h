#pragma once

#include <cmath>

#include "keenline/cloud.h"

namespace keenline {

// Points taken as vectors. Not Eigen's: how that one orders its additions depends on the instruction set, and
// results must have the same bits everywhere.

[[nodiscard]] constexpr double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] constexpr Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] constexpr Point sum(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

[[nodiscard]] constexpr Point difference(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[nodiscard]] constexpr Point scaled(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }

[[nodiscard]] inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

[[nodiscard]] inline double distance(const Point& a, const Point& b) { return length(difference(a, b)); }

/// \pre length(a) > 0
[[nodiscard]] inline Point unit(const Point& a) {
  const double l = length(a);
  return {a[0] / l, a[1] / l, a[2] / l};
}

}  // namespace keenline
