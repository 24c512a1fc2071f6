#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "keenline/lines/foot.h"

namespace keenline {

struct PathEnd {
  std::size_t path;
  bool at_back;
};

[[nodiscard]] const Foot& foot_at(const std::vector<Path>& paths, const PathEnd& end);

/// A straight line from a place on.
struct Ray {
  Point start{};
  Point direction{};  ///< unit vector
  double scale = 1;   ///< spacing of the points around
};

/// Out of the path, along its tangent.
[[nodiscard]] Ray ray_from(const std::vector<Path>& paths, const PathEnd& end);

struct Approach {
  double first;   ///< along the first ray
  double second;  ///< along the second
  double miss;    ///< by how much they pass each other
};

/// Where two lines are nearest to each other. \pre they are not parallel
[[nodiscard]] Approach approach_of(const Ray& a, const Ray& b);

// A walk may stop some steps before a corner, or run past it by a step or two: so far lines are prolonged, or
// taken back, to find where they meet, in spacings of the points around.
inline constexpr double line_reach = 4;
inline constexpr double line_overrun = 2;
inline constexpr double largest_miss = 1;  ///< lines that pass each other this closely meet
inline constexpr double parallel = 0.94;   ///< cosine of 20 degrees: where such lines meet is not to be told
inline constexpr double smooth_turn = 0.77;  ///< cosine of 40 degrees: lines that turn less are one

struct CommonPoint {
  Point position{};
  double residual = 0;  ///< root mean square distance of the planes
};

/// Where the planes of the feet come together: least squares, drawn weakly to the mean of the feet, which
/// decides where the planes leave it open. \pre !feet.empty()
[[nodiscard]] CommonPoint common_point(std::span<const Foot* const> feet);

/// Which ends of open paths come together: those that face each other over a gap, and those whose lines meet.
/// The nearest are taken first, and an end joins others only if then all of them still point to their common
/// point. Every end is in exactly one group; a loose one is alone.
[[nodiscard]] std::vector<std::vector<PathEnd>> gather_ends(const std::vector<Path>& paths);

}  // namespace keenline
