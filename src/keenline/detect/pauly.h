#pragma once

#include <optional>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct PaulyOptions {
  /// The neighbourhoods looked at are the nearest smallest_scale, smallest_scale + scale_step, … points, up
  /// to largest_scale. 3 to 255 each, smallest_scale <= largest_scale.
  int smallest_scale = 8;
  int largest_scale = 32;
  int scale_step = 4;  ///< 1 to 255
  /// A scale speaks for a feature where the surface variation is larger: above 0, up to 1/3. An edge has
  /// 0.085 where faces meet at 90 degrees, 0.038 at 120, 0.010 at 150; half of what is wanted is a good
  /// choice. Empty = from the cloud, 0.01 to 0.08: six tenths of what a fifth of its points exceed.
  std::optional<double> variation;
  /// Share of its scales that must speak for a point from which a feature grows, 0 to 1.
  double seed_share = 0.95;
  /// Share that a point needs to belong to a feature that grew up to it. 0 to seed_share.
  double grow_share = 0.9;
  /// Where the normal turns by more from one scale to the next, another sheet of the surface has come in and
  /// larger scales are not looked at. Degrees, 0 to 90; at 90 none is left out.
  double turn_deg = 30;
  /// A sector without neighbours that makes a point, which is no feature, a border. Degrees, 0 to 360.
  double border_gap_deg = 120;
};

/// Features by surface variation at many scales: how much of the variance of a neighbourhood is across the
/// surface, for every size of neighbourhood; a feature is where it is large at nearly all of them.
///
/// Points with seed_share are features, and points with grow_share that lie among the 16 nearest of a feature
/// (hysteresis). Corners are those that vary as no two half planes do; borders, which have no variation of
/// their own, those at which the neighbours leave a sector empty. The rest is curved where the variation
/// grows with the scale, and flat elsewhere. The score is the mean surface variation, 0 to 1/3. Paper: Pauly,
/// Keiser, Gross 2003, "Multi-scale Feature Extraction on Point-Sampled Surfaces", sections 2 and 3; the
/// lines of its later sections are trace_pauly(). Departures: see docs/methods/pauly.md. Points with fewer
/// than smallest_scale neighbours are undecided. Threads: any number, same bits. Cost: O(n (largest_scale +
/// scales)). Memory: 4 bytes per point and scale, 20 per point beside.
/// \pre the search is that of cloud.positions
/// \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_pauly(const PointCloud& cloud, const NeighborSearch& search,
                                         const PaulyOptions& options = {},
                                         Progress& progress = no_progress());

}  // namespace keenline
