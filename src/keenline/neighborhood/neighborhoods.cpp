#include "keenline/neighborhood/neighborhoods.h"

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighbor_search.h"

namespace keenline {

void require_neighbor_count(int count) {
  if (count < min_neighbors || count > max_neighbors)
    throw InvalidArgument(
        fmt::format("neighbors: found {}, expected {} to {}", count, min_neighbors, max_neighbors));
}

Neighborhoods find_neighborhoods(const PointCloud& cloud, int count, Progress& progress) {
  require_neighbor_count(count);
  // Neighbours and offset of each point, and the search while it runs: refused before it is built.
  const std::size_t table_bytes =
      static_cast<std::size_t>(count) * sizeof(std::uint32_t) + sizeof(std::uint64_t);
  constexpr std::size_t search_bytes = 16;
  require_memory(cloud.size() * (table_bytes + search_bytes), "finding neighbours");
  progress.begin("neighborhoods", cloud.size());
  return NeighborSearch(cloud.positions, progress).all(count, progress);
}

}  // namespace keenline
