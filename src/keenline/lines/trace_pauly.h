#pragma once

#include <optional>

#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/lines/snake.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct TracePaulyOptions {
  /// Weight of an edge's length, in spacings, against the scores of its ends: 0 to 1. More makes ways shorter
  /// and leads them off the crest of the scores.
  double length_weight = 0.1;
  /// Cycles have more edges than this, components at least as many points, branches half as many edges. 1 or
  /// more. Empty = half the square root of the number of points, at least 5.
  std::optional<int> shortest_cycle;
  SnakeOptions snake;  ///< in spacings; with a duration of 0 vertices are points of the cloud
};

/// Lines as the minimum spanning graph of the labelled points, whatever method labelled them, light where
/// both ends of an edge have a large score; then relaxed as snakes that the scores around attract. Corners
/// are in the middle of their junctions. Filled in are vertices, kind, closed, corners and support. The graph
/// is valid, see validate(). Paper: Pauly, Keiser, Gross 2003, "Multi-scale Feature Extraction on
/// Point-Sampled Surfaces", the stages after classification. Departures: see docs/methods/pauly.md. Threads:
/// any number, same bits.
/// \param spacing of the cloud, see estimate_spacing(); nothing is traced unless it is more than 0
/// \pre search is in the cloud's positions
/// \throw InvalidArgument when an option is out of range or labels are not those of the cloud; OutOfMemory;
/// Cancelled.
[[nodiscard]] FeatureGraph trace_pauly(const PointCloud& cloud, const NeighborSearch& search,
                                       const FeatureLabels& labels, double spacing,
                                       const TracePaulyOptions& options = {},
                                       Progress& progress = no_progress());

}  // namespace keenline
