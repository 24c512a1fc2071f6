#pragma once

#include <cstdint>
#include <vector>

#include "keenline/feature_graph.h"

namespace keenline {

/// A graph as formats want it that number their vertices.
struct GraphVertices {
  std::vector<Point> positions;  ///< the corners in their order, then all other vertices, line by line
  /// Per polyline the numbers of its vertices. An end that lies in its corner is that corner.
  std::vector<std::vector<std::uint32_t>> lines;
};

/// \throw InvalidArgument when there are more than max_points vertices.
[[nodiscard]] GraphVertices number_vertices(const FeatureGraph& graph);

}  // namespace keenline
