#include "keenline/lines/snake.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

void validate(const SnakeOptions& options) {
  require_in_range("tension", options.tension, 0, 1);
  require_in_range("stiffness", options.stiffness, 0, 1);
  require_in_range("pull", options.pull, 0, 10);
  require_in_range("duration", options.duration, 0, 1000);
}

/// Minus the gradient of the energy of the curve itself.
void add_inner_forces(const std::vector<Point>& vertices, bool closed, const SnakeOptions& options,
                      std::vector<Point>& forces) {
  const std::size_t count = vertices.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < count; ++i) {
    const std::size_t next = (i + 1) % count;
    const Point force = scaled(options.tension, difference(vertices[next], vertices[i]));
    forces[i] = sum(forces[i], force);
    forces[next] = difference(forces[next], force);
  }
  for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    const std::size_t next = (i + 1) % count;
    const Point bend = difference(sum(vertices[before], vertices[next]), scaled(2, vertices[i]));
    const Point force = scaled(options.stiffness, bend);
    forces[before] = difference(forces[before], force);
    forces[next] = difference(forces[next], force);
    forces[i] = sum(forces[i], scaled(2, force));
  }
}

}  // namespace

void relax_snake(std::vector<Point>& vertices, bool closed, const SnakeOptions& options,
                 const Attraction& attraction) {
  validate(options);
  if (vertices.size() < 3) return;
  // A zigzag is pulled back by four times its tension and sixteen times its stiffness: steps that overshoot
  // it less than once are stable.
  const double stiffest = 4 * options.tension + 16 * options.stiffness;
  const double step = std::min(0.25, 1 / std::max(stiffest, 1.0));
  const auto steps = static_cast<int>(std::ceil(options.duration / step));
  std::vector<Point> forces(vertices.size());
  for (int s = 0; s < steps; ++s) {
    for (std::size_t i = 0; i < vertices.size(); ++i)
      forces[i] = scaled(options.pull, attraction(i, vertices[i]));
    add_inner_forces(vertices, closed, options, forces);
    for (std::size_t i = closed ? 0 : 1; i + (closed ? 0 : 1) < vertices.size(); ++i)
      vertices[i] = sum(vertices[i], scaled(step, forces[i]));
  }
}

}  // namespace keenline
