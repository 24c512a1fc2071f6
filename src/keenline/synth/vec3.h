#pragma once

#include <cmath>

#include "keenline/cloud.h"

namespace keenline::synth {

/// A vector in space. Not Eigen's: how that one orders its additions depends on the instruction set, and
/// shapes must come out with the same bits everywhere.
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  [[nodiscard]] Point point() const { return {x, y, z}; }
};

[[nodiscard]] constexpr Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
[[nodiscard]] constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(const Vec3& a, const Vec3& b) { return length(a - b); }
[[nodiscard]] inline Vec3 unit(const Vec3& a) { return (1 / length(a)) * a; }

/// Local coordinates in space: three perpendicular unit vectors at an origin.
struct Frame {
  Vec3 origin;
  Vec3 x{1, 0, 0};
  Vec3 y{0, 1, 0};
  Vec3 z{0, 0, 1};

  [[nodiscard]] Vec3 direction(const Vec3& d) const { return d.x * x + d.y * y + d.z * z; }
  [[nodiscard]] Vec3 point(const Vec3& p) const { return origin + direction(p); }
};

}  // namespace keenline::synth
