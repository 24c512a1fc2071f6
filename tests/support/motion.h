#pragma once

#include <cmath>

#include "keenline/cloud.h"

namespace keenline::test {

/// A rotation about an axis that is no coordinate axis.
inline Point turned(const Point& p) {
  const double c = std::cos(0.7);
  const double s = std::sin(0.7);
  const double cd = std::cos(-1.9);
  const double sd = std::sin(-1.9);
  const Point q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
  return {q[0], cd * q[1] - sd * q[2], sd * q[1] + cd * q[2]};
}

/// Turned, scaled, then shifted; positions only.
inline PointCloud moved(const PointCloud& cloud, double scale, const Point& shift) {
  PointCloud result;
  for (const Point& p : cloud.positions) {
    const Point q = turned(p);
    result.positions.push_back({scale * q[0] + shift[0], scale * q[1] + shift[1], scale * q[2] + shift[2]});
  }
  return result;
}

}  // namespace keenline::test
