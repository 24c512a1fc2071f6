#include "keenline/io/graph_ply.h"

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "keenline/io/graph_vertices.h"
#include "keenline/io/ply.h"
#include "keenline/progress.h"

namespace keenline {

void write_graph_ply(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  GraphVertices vertices = number_vertices(graph);
  std::vector<std::uint32_t> from;
  std::vector<std::uint32_t> to;
  std::vector<std::uint32_t> line;
  std::vector<std::uint8_t> kind;
  for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
    const std::vector<std::uint32_t>& numbers = vertices.lines[i];
    for (std::size_t k = 0; k < segment_count(graph.polylines[i]); ++k) {
      from.push_back(numbers[k]);
      to.push_back(numbers[k + 1 < numbers.size() ? k + 1 : 0]);
      line.push_back(static_cast<std::uint32_t>(i));
      kind.push_back(static_cast<std::uint8_t>(graph.polylines[i].kind));
    }
  }
  std::vector<std::int32_t> corner(vertices.positions.size(), -1);
  std::iota(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(graph.corners.size()), 0);

  PointCloud cloud;
  cloud.positions = std::move(vertices.positions);
  cloud.attributes.emplace_back("corner", corner);
  cloud.tables.push_back(
      {"edge",
       from.size(),
       {Column("vertex1", from), Column("vertex2", to), Column("line", line), Column("kind", kind)}});
  (void)write_ply(cloud, sink, progress);
}

}  // namespace keenline
