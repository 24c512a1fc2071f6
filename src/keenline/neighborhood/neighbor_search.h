#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/progress.h"

namespace keenline {

class BoxTree;

/// Finds the nearest other points of the points of a cloud, by the rules of find_neighborhoods(): of one, or
/// of all in blocks, so that the table of a huge cloud never has to be whole.
/// Memory: about 11 bytes per point beside the positions; 4 more where points coincide, 24 more where
/// coordinates are too large or small to be squared; 36 more while it is built.
class NeighborSearch {
 public:
  /// The positions must outlive the search and stay as they are.
  /// Threads: any number, same search. Cost: O(n log n).
  /// \throw OutOfMemory; Cancelled.
  explicit NeighborSearch(const std::vector<Point>& positions, const Progress& progress = no_progress());
  ~NeighborSearch();
  NeighborSearch(const NeighborSearch&) = delete;
  NeighborSearch& operator=(const NeighborSearch&) = delete;

  /// Of one point; none when it is not finite.
  /// Threads: may be called from many at once. Cost: O(log n + count log count) for well-spread points.
  /// \throw InvalidArgument unless min_neighbors <= count <= max_neighbors and there is such a point.
  [[nodiscard]] std::vector<std::uint32_t> nearest(std::uint32_t point, int count) const;

  /// The `count` points nearest to any position of space, ordered by (distance, index). Unlike nearest(),
  /// points at the position itself come first, and count may be any number from 1. None when the position is
  /// not finite; all where there are no more.
  /// Threads: may be called from many at once. Cost: O(log n + count log count) for well-spread points and a
  /// position near them.
  /// \throw InvalidArgument unless count >= 1
  [[nodiscard]] std::vector<std::uint32_t> nearest_to(const Point& position, int count) const;

  /// Of every point the first one that lies at the same place: itself, where no earlier one does or it is not
  /// finite. Cost: O(n).
  [[nodiscard]] std::vector<std::uint32_t> first_coincident() const;

  /// neighborhoods.of(i) are the neighbours of points[i]; both are overwritten after the call.
  using Visit =
      std::function<void(std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods)>;

  /// Calls `visit`, from many threads at once, with every finite point once, in blocks of some hundred that
  /// lie together. Blocks are the same for any number of threads; their order is not. Advances `progress` by
  /// the points that are done; the caller began the stage. \throw InvalidArgument unless min_neighbors <=
  /// count <= max_neighbors; Cancelled; what visit throws.
  void for_each_block(int count, const Visit& visit, Progress& progress = no_progress()) const;

  /// Of all points. \throw as for_each_block()
  [[nodiscard]] Neighborhoods all(int count, Progress& progress = no_progress()) const;

 private:
  std::size_t size_;  // of the cloud
  std::unique_ptr<const BoxTree> tree_;
  std::vector<std::uint32_t> groups_;  // nodes that hold all points, each the queries of one Surroundings
};

}  // namespace keenline
