#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/progress.h"

namespace keenline {

/// The nearest other points of every point: flat indices and offsets.
struct Neighborhoods {
  std::vector<std::uint64_t> offsets{0};  ///< size() + 1 positions into indices
  std::vector<std::uint32_t> indices;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
  /// Neighbours of point i, nearest first; equal distances in the order of their indices.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(indices).subspan(offsets[i], offsets[i + 1] - offsets[i]);
  }
};

inline constexpr int min_neighbors = 3;
inline constexpr int max_neighbors = 255;

/// \throw InvalidArgument unless min_neighbors <= count <= max_neighbors
void require_neighbor_count(int count);

/// The `count` nearest other points of every point, ordered by (distance, index).
/// Points that coincide with the query are not its neighbours; points that are not finite take no part.
/// Fewer than `count` are given where the cloud has no more.
/// Distances are exact to double precision: the cloud is scaled by a power of two when squares would leave
/// the range of doubles. In clouds that span more than 300 decades the smallest distances become ties.
/// Threads: any number, same bits. Cost: O(n log n) for well-spread points. Memory: 4 count + 8 bytes each.
/// \throw InvalidArgument unless min_neighbors <= count <= max_neighbors; OutOfMemory; Cancelled.
[[nodiscard]] Neighborhoods find_neighborhoods(const PointCloud& cloud, int count,
                                               Progress& progress = no_progress());

}  // namespace keenline
