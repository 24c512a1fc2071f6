#pragma once

#include "keenline/lines/foot.h"

namespace keenline::test {

/// Feet a spacing apart on the straight from `a` to `b`, on planes with these normals.
inline Path straight_path(const Point& a, const Point& b, const Point& normal, const Point& other) {
  Path path;
  const Point along = unit(difference(b, a));
  for (double t = 0; t <= distance(a, b); t += 1) {
    Foot foot;
    foot.position = sum(a, scaled(t, along));
    foot.tangent = along;
    foot.normals = {normal, other};
    foot.is_backed = true;
    path.feet.push_back(foot);
  }
  return path;
}

}  // namespace keenline::test
