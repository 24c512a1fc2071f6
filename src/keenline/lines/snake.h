#pragma once

#include <functional>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

struct SnakeOptions {
  double tension = 0.2;    ///< of the curve's length, 0 to 1
  double stiffness = 0.2;  ///< against bending, 0 to 1
  double pull = 1;         ///< of what attracts it, 0 to 10
  double duration = 20;    ///< how long it moves, 0 to 1000
};

/// Which way, and how strongly, a place attracts vertex number `vertex` there.
using Attraction = std::function<Point(std::size_t vertex, const Point& place)>;

/// An active contour: vertices move down the gradient of tension / 2 times the squared lengths of the pieces,
/// plus stiffness / 2 times the squared second differences, minus the pull of what attracts. Vertices should
/// be about one unit of length apart. The ends of an open curve stay where they are. Source: Kass, Witkin,
/// Terzopoulos 1988, "Snakes: active contour models", equation 1; in steps small enough to do without their
/// solver. Cost: O(vertices), 4 to 20 steps per unit of the duration. \throw InvalidArgument when an option
/// is out of range.
void relax_snake(std::vector<Point>& vertices, bool closed, const SnakeOptions& options,
                 const Attraction& attraction);

}  // namespace keenline
