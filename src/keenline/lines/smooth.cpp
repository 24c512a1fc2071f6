#include "keenline/lines/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/lines/arc_length.h"
#include "keenline/lines/band_least_squares.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// Where a parabola through the neighbours says that vertex `i` is.
Point smoothed(const Polyline& line, const ArcLength& arc, std::size_t i, std::size_t reach) {
  struct Neighbor {
    double way;  // along the line from vertex i
    Point offset;
  };
  std::vector<Neighbor> neighbors;
  const std::size_t count = line.vertices.size();
  const bool goes_round = line.closed && !line.start_corner;
  double farthest = 0;
  for (std::size_t k = 0; k <= 2 * reach; ++k) {
    const bool is_inside = i + k >= reach && i + k - reach < count + (line.closed ? 1 : 0);
    if (!goes_round && !is_inside) continue;
    const std::size_t j = (i + k + count - reach) % count;
    double way = arc.at(j) - arc.at(i);
    if (k < reach && j > i) way -= arc.total();
    if (k > reach && j < i) way += arc.total();
    neighbors.push_back({way, difference(line.vertices[j], line.vertices[i])});
    farthest = std::max(farthest, std::abs(way));
  }
  // Beyond the last neighbour by about a step, where the next one would be.
  const double end = farthest * (1 + 1 / static_cast<double>(reach));
  if (!(end > 0)) return line.vertices[i];
  BandLeastSquares equations(3, 3);
  for (const auto& [way, offset] : neighbors) {
    const double x = way / end;
    const double tricube = 1 - std::abs(x * x * x);
    equations.add(0, std::array{1.0, x, x * x}, offset, tricube * tricube * tricube);
  }
  const std::optional<std::vector<Point>> parabola = std::move(equations).solve();
  return parabola ? sum(line.vertices[i], parabola->front()) : line.vertices[i];
}

Polyline smoothed(const Polyline& line, std::size_t neighbors) {
  const ArcLength arc(line);
  const std::size_t count = line.vertices.size();
  const bool has_ends = !line.closed || line.start_corner;
  const std::size_t reach =
      has_ends ? neighbors : std::min(neighbors, std::max<std::size_t>(count >= 5 ? 2 : 1, count / 10));
  Polyline result = line;
  result.fitted = {};
  const std::size_t first = has_ends ? 1 : 0;
  const std::size_t last = line.closed ? count : count - 1;
  tbb::parallel_for(first, last, [&](std::size_t i) { result.vertices[i] = smoothed(line, arc, i, reach); });
  return result;
}

}  // namespace

FeatureGraph smooth_lines(const FeatureGraph& graph, const SmoothLinesOptions& options) {
  validate(graph);
  if (options.neighbors < 2 || options.neighbors > 1000)
    throw InvalidArgument(fmt::format("neighbors: found {}, expected 2 to 1000", options.neighbors));
  FeatureGraph result = graph;
  for (Polyline& line : result.polylines) line = smoothed(line, static_cast<std::size_t>(options.neighbors));
  return result;
}

}  // namespace keenline
