#include "keenline/io/graph_vertices.h"

#include <optional>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {

GraphVertices number_vertices(const FeatureGraph& graph) {
  std::uint64_t most = graph.corners.size();
  for (const Polyline& line : graph.polylines) most += line.vertices.size();
  if (most > max_points)
    throw InvalidArgument(fmt::format("{} vertices of lines; expected at most {}", most, max_points));

  GraphVertices result;
  result.positions.reserve(most);
  for (const GraphCorner& corner : graph.corners) result.positions.push_back(corner.position);
  result.lines.reserve(graph.polylines.size());
  for (const Polyline& line : graph.polylines) {
    std::vector<std::uint32_t>& numbers = result.lines.emplace_back();
    numbers.reserve(line.vertices.size());
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      std::optional<std::uint32_t> corner;
      if (i == 0) corner = line.start_corner;
      else if (i + 1 == line.vertices.size() && !line.closed) corner = line.end_corner;
      if (corner && result.positions[*corner] == line.vertices[i]) {
        numbers.push_back(*corner);
      } else {
        numbers.push_back(static_cast<std::uint32_t>(result.positions.size()));
        result.positions.push_back(line.vertices[i]);
      }
    }
  }
  return result;
}

}  // namespace keenline
