#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/progress.h"

namespace keenline {

class LocalOffsets;
class NeighborSearch;

/// The normal of the plane of a point and its neighbours, up to its sign: their axis of least variance (Hoppe
/// et al. 1992, "Surface reconstruction from unorganized points"). {0, 0, 0} where there are less than 3
/// neighbours or all lie in one row. `workspace` is overwritten.
[[nodiscard]] Point plane_normal(const std::vector<Point>& positions, std::size_t point,
                                 std::span<const std::uint32_t> neighbors, LocalOffsets& workspace);

struct SegmentOptions {
  int normal_neighbors = 10;  ///< that a normal is taken from
  int region_neighbors = 8;   ///< that a region grows to
  /// Between the normals of neighbours in one region, at most. Empty = three times what it is for most
  /// points, the median of bend_deg, but 5 to 10 degrees.
  std::optional<double> angle_deg{};
};

/// Smooth pieces of the surface: regions of points whose neighbours' normals differ little.
struct Segments {
  std::vector<Point> normals;           ///< of every point, see plane_normal()
  std::vector<float> bend_deg;          ///< largest angle between the normals of a point and its neighbours
  std::vector<std::uint32_t> segment;   ///< of every point
  std::vector<std::uint32_t> interior;  ///< of every segment: points whose neighbours are all in it
  double angle_deg = 0;                 ///< SegmentOptions::angle_deg, or what was chosen
};

/// First-order segmentation: regions grow from the flattest point that is left, breadth first, always from
/// neighbour to neighbour, so that curved faces stay whole. A point without a normal is a segment of its own.
/// Source: Demarsin, Vanderstraeten, Volodine, Roose 2007. Threads: any number, same result. Cost: O(n k).
/// Advances `progress` by the points; the caller began the stage.
/// \pre the search is that of the positions, the options are in range \throw OutOfMemory; Cancelled
[[nodiscard]] Segments segment_by_normals(const std::vector<Point>& positions, const NeighborSearch& search,
                                          const SegmentOptions& options, Progress& progress = no_progress());

}  // namespace keenline
