#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/lines/foot.h"

namespace keenline {

class NeighborSearch;

/// Points of a cloud that lines may run through, one for every place.
struct PlacedPoints {
  TraceFrame frame;  ///< its origin is in the middle of them
  std::vector<std::uint32_t>
      points;                    ///< their numbers in the cloud, rising; of those that coincide the first
  std::vector<Point> positions;  ///< in the frame
  std::vector<std::uint32_t> copies;  ///< so many lie at each place, itself among them

  [[nodiscard]] std::size_t size() const { return points.size(); }
};

/// The chosen points of a cloud, without those that a drawing cannot hold; none where the spacing is not a
/// positive number. The origin is their median, axis by axis: a stray point far away leaves the others their
/// digits. Where points coincide each would be a neighbour of all that is near: as one they are not.
/// Cost: O(n). Memory: 8 bytes per point of the cloud, 40 per chosen one, 32 of them to stay.
/// \pre is_chosen.size() == cloud.size(); search is in the cloud's positions
[[nodiscard]] PlacedPoints place_points(const PointCloud& cloud, const NeighborSearch& search,
                                        const std::vector<bool>& is_chosen, double spacing);

}  // namespace keenline
