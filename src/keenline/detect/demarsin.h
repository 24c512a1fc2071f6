#pragma once

#include <optional>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct DemarsinOptions {
  /// Neighbours that a normal is taken from, 3 to 255. More bear more noise and blur edges over a wider band.
  int normal_neighbors = 10;
  /// Neighbours that a region grows to, 3 to 255.
  int region_neighbors = 8;
  /// Angle between the normals of neighbours in one region, at most. Degrees, 1 to 45: less than noise and
  /// curvature turn normals breaks faces up, more lets regions leak over obtuse edges. Empty = 5 to 10, see
  /// SegmentOptions.
  std::optional<double> segment_angle_deg{};
  /// Points with all their neighbours in the same region that make it a patch, a face of the shape. >= 1.
  int min_patch = 10;
};

/// A point sees patches among so many nearest neighbours, about four spacings.
inline constexpr int demarsin_view = 50;

/// Sharp features as what is left between smooth regions. Points are grouped by segment_by_normals(); large
/// regions are the faces of the shape. In between, where normals turn fast, the regions are small or single
/// points: these are sharp if they see patches in two directions, more than 10 degrees apart; in three that
/// span space, among the 28 nearest, it is a corner. What sees only one is curved. In a patch, points are
/// flat where neighbours' normals are within half of `segment_angle_deg`, else curved; without a normal
/// undecided.
///
/// The score is the largest angle between the normals of a point and its `region_neighbors`, in degrees.
/// Paper: Demarsin, Vanderstraeten, Volodine, Roose, "Detection of closed sharp edges in point clouds using
/// normal estimation and graph theory", 2007. Departures: see docs/methods/demarsin.md. Threads: any number,
/// same bits. Cost: O(n k). Memory: 60 bytes a point and 4 for each of its region_neighbors.
/// \pre the search is that of cloud.positions
/// \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_demarsin(const PointCloud& cloud, const NeighborSearch& search,
                                            const DemarsinOptions& options = {},
                                            Progress& progress = no_progress());

}  // namespace keenline
