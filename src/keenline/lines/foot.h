#pragma once

#include <array>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/vectors.h"

namespace keenline {

/// Where lines are traced: lengths in spacings of the cloud, from an origin near the features. So a cloud may
/// lie anywhere and have any scale, and all constants are plain numbers.
struct TraceFrame {
  Point origin{};
  double spacing = 1;

  [[nodiscard]] Point local(const Point& p) const {
    const Point offset = difference(p, origin);
    // Not by the reciprocal: that of the smallest spacings is infinite.
    return {offset[0] / spacing, offset[1] / spacing, offset[2] / spacing};
  }
  [[nodiscard]] Point global(const Point& p) const { return sum(origin, scaled(spacing, p)); }
};

/// A place on a line, as one neighbourhood shows it.
struct Foot {
  Point position{};
  Point tangent{};                 ///< unit vector
  std::array<Point, 2> normals{};  ///< unit normals, of any sign, of two planes that meet in the line here
  double scale = 1;                ///< spacing of the points around; more where they are noisy
  double quality = 0;              ///< 0 to 1: how much of the neighbourhood the planes explain
  double evidence = 50;            ///< for a line, against a smooth surface: difference of chi squared
  bool is_backed = false;          ///< the detector found a point nearby
};

/// Feet one after another, a spacing apart.
struct Path {
  std::vector<Foot> feet;
  bool closed = false;
  LineKind kind = LineKind::Crease;
  double unit = 1;  ///< the scales of the feet are so many times the spacing of the points around
};

}  // namespace keenline
