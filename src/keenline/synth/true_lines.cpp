#include "keenline/synth/true_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace keenline {
namespace {

/// The corner at `end`, which then becomes that corner to the bit: both were computed in their own way.
std::optional<std::uint32_t> snap_to_corner(Point& end, std::span<const GraphCorner> corners) {
  constexpr double same_place = 1e-9;
  const auto is_here = [&](const GraphCorner& corner) {
    return std::max({std::abs(corner.position[0] - end[0]), std::abs(corner.position[1] - end[1]),
                     std::abs(corner.position[2] - end[2])}) < same_place;
  };
  const auto found = std::find_if(corners.begin(), corners.end(), is_here);
  if (found == corners.end()) return std::nullopt;
  end = found->position;
  return static_cast<std::uint32_t>(found - corners.begin());
}

}  // namespace

FeatureGraph true_lines(const SynthCloud& synth) {
  FeatureGraph graph;
  for (const auto* const points : {&synth.corners, &synth.border_corners, &synth.peaks})
    for (const Point& p : *points) graph.corners.push_back({p, 0.0});
  for (const TruthCurve& curve : synth.curves) {
    Polyline line{.vertices = curve.vertices, .closed = curve.closed};
    line.kind = curve.border ? LineKind::Border : LineKind::Crease;
    line.start_corner = snap_to_corner(line.vertices.front(), graph.corners);
    line.end_corner = line.closed ? line.start_corner : snap_to_corner(line.vertices.back(), graph.corners);
    graph.polylines.push_back(std::move(line));
  }
  return graph;
}

}  // namespace keenline
