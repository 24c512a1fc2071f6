#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "keenline/feature_graph.h"
#include "keenline/lines/arc_length.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"
#include "keenline/synth/true_lines.h"
#include "keenline/vectors.h"

namespace keenline::test {

/// How far lines are from the true ones, in spacings.
struct Roughness {
  double vertices = 0.3;
  double corners = 1;
  double gap = 3;  ///< now and then without a vertex
};

/// What a tracer might have made of true lines: a vertex every spacing or so, all of them off to some side,
/// some missing, corners astray. The same on every platform.
inline FeatureGraph roughened(const FeatureGraph& truth, double spacing, const Roughness& roughness = {}) {
  std::mt19937 generator(7);
  const auto uniform = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  const auto moved = [&](const Point& p, double by) {
    Point way{1, 1, 1};
    while (dot(way, way) > 1) {
      for (double& coordinate : way) coordinate = 2 * uniform() - 1;
    }
    return sum(p, scaled(by * spacing, way));
  };
  FeatureGraph rough = truth;
  for (GraphCorner& corner : rough.corners) corner = {moved(corner.position, roughness.corners), {}};
  for (Polyline& line : rough.polylines) {
    Polyline traced = line;
    const ArcLength arc(line);
    traced.vertices.clear();
    for (double place = 0; place < arc.total();) {
      traced.vertices.push_back(moved(arc.point(place), roughness.vertices));
      const bool is_gap = uniform() < 0.1;
      place += spacing * (0.6 + (is_gap ? roughness.gap : 0.8 * uniform()));
    }
    if (!line.closed) traced.vertices.push_back(moved(line.vertices.back(), roughness.vertices));
    if (line.start_corner) traced.vertices.front() = rough.corners[*line.start_corner].position;
    if (line.end_corner && !line.closed) traced.vertices.back() = rough.corners[*line.end_corner].position;
    line = std::move(traced);
  }
  return rough;
}

/// A shape with everything that the stages after detection need, and its true lines.
struct LineScene {
  explicit LineScene(const SynthOptions& options)
      : synth(synthesize(options)), search(synth.cloud.positions) {
    truth = true_lines(synth);
    spacing = estimate_spacing(synth.cloud, search);
  }

  SynthCloud synth;
  NeighborSearch search;
  FeatureGraph truth;
  double spacing;
};

inline SynthOptions shape_options(const std::string& shape, std::uint64_t points, double noise = 0) {
  SynthOptions options;
  options.shape = shape;
  options.points = points;
  options.noise.amount = noise;
  return options;
}

}  // namespace keenline::test
