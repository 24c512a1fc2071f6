#pragma once

#include <string>

#include "keenline/feature_graph.h"
#include "keenline/io/sink.h"
#include "keenline/progress.h"

namespace keenline::test {

/// Two corners, a crease between them with all that can be known of it, a closed border, and a loose end.
inline FeatureGraph sample_graph() {
  FeatureGraph graph;
  graph.crs = "EPSG:25832";
  graph.corners = {{{4500000.123, 5400000.001, 99.875}, 0.25}, {{4500010.123, 5400000.001, 0.1}, {}}};
  Polyline crease{
      .vertices = {graph.corners[0].position, {4500005.5, 5.4e6, 1e-7}, graph.corners[1].position}};
  crease.start_corner = 0;
  crease.end_corner = 1;
  crease.support = 12;
  crease.dihedral_deg = {90, 91, 95};
  crease.normals = {{{0, 0, 1}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}}, {{0, 0, 1}, {0.6, 0.8, 0}}};
  crease.residual = {0, 0.5, 0.125};
  const Polyline border{
      .vertices = {{0, 0, 0}, {1, 0, -0.0}, {0, 1, 1.0 / 3}}, .closed = true, .kind = LineKind::Border};
  Polyline loose{.vertices = {graph.corners[1].position, {1, 2, 3}}};
  loose.start_corner = 1;
  graph.polylines = {crease, border, loose};
  return graph;
}

/// What one of the writers makes of a graph.
template <typename Writer>
std::string written(Writer write, const FeatureGraph& graph) {
  StringSink sink;
  write(graph, sink, no_progress());
  return sink.text;
}

}  // namespace keenline::test
