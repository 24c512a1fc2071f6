#pragma once

#include <optional>

#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct TraceGumholdOptions {
  int neighbors = 16;  ///< that a point's penalties are taken from, 3 to 255
  /// Cycles have more edges than this, components at least as many points, branches half as many edges. 1 or
  /// more. Empty = half the square root of the number of points, at least 5.
  std::optional<int> shortest_cycle;
};

/// Lines as the minimum spanning pattern of the labelled points, whatever method labelled them, by the
/// penalties of detect_gumhold(): the way along a crease is the lightest. Vertices are points of the cloud,
/// and zigzag with them; corners are in the middle of their junctions. Filled in are vertices, kind, closed,
/// corners and support. The graph is valid, see validate().
/// Paper: Gumhold, Wang, MacLeod 2001, "Feature Extraction from Point Clouds", section 4. Departures: see
/// docs/methods/gumhold.md. Threads: any number, same bits.
/// \param spacing of the cloud, see estimate_spacing(); nothing is traced unless it is more than 0
/// \pre search is in the cloud's positions
/// \throw InvalidArgument when an option is out of range or labels are not those of the cloud; OutOfMemory;
/// Cancelled.
[[nodiscard]] FeatureGraph trace_gumhold(const PointCloud& cloud, const NeighborSearch& search,
                                         const FeatureLabels& labels, double spacing,
                                         const TraceGumholdOptions& options = {},
                                         Progress& progress = no_progress());

}  // namespace keenline
