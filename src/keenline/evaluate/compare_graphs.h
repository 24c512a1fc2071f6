#pragma once

#include <cstddef>
#include <optional>

#include "keenline/feature_graph.h"
#include "keenline/progress.h"

namespace keenline {

struct GraphComparisonOptions {
  /// h, the point spacing of the cloud: more than 0. Lines are sampled every h/10, and corners match within
  /// h. Without it these are a 2000th and a 200th of GraphComparison::diagonal.
  std::optional<double> spacing;
};

/// Distances from everything of one kind to the nearest of the other.
struct Deviation {
  double mean = 0;
  double largest = 0;
};

/// All distances in the unit of the coordinates; infinite where there is nothing to be near to, 0 where there
/// is nothing that could be far.
struct GraphComparison {
  GraphCounts found;
  GraphCounts truth;
  double length_ratio = 1;           ///< found to truth; 1 when both are 0
  Deviation found_to_truth;          ///< from the found lines to the true ones: what was invented
  Deviation truth_to_found;          ///< from the true lines to the found ones: what was missed
  Deviation corners;                 ///< from each true corner to the nearest found one
  std::size_t missed_corners = 0;    ///< true ones with no found one within the tolerance
  std::size_t invented_corners = 0;  ///< found ones with no true one within the tolerance
  double diagonal =
      0;  ///< of the bounding box of the true vertices and corners; of the found ones where there are none

  /// Mean distance between the curves, the mean of both ways.
  [[nodiscard]] double chamfer() const { return 0.5 * (found_to_truth.mean + truth_to_found.mean); }
  /// Largest distance between the curves, the larger of both ways.
  [[nodiscard]] double hausdorff() const;
};

/// Measures found lines against true ones, creases and borders alike. A line's mean distance is that of
/// points at equal steps along it, its largest that of these and its vertices; each is the exact distance to
/// the nearest straight piece of the other graph. There are at most a million points: longer lines have
/// longer steps. Threads: any number, same bits. \throw InvalidArgument for an invalid graph or a spacing
/// that is not more than 0 and finite; Cancelled.
[[nodiscard]] GraphComparison compare_graphs(const FeatureGraph& found, const FeatureGraph& truth,
                                             const GraphComparisonOptions& options = {},
                                             Progress& progress = no_progress());

}  // namespace keenline
