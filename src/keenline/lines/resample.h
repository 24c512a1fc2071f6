#pragma once

#include "keenline/feature_graph.h"
#include "keenline/progress.h"

namespace keenline {

/// The same lines with vertices at equal steps. Each line, and each part of it between sharp bends, is
/// divided into as many equal pieces as make them most nearly `step` long; a closed line into at least
/// three. New vertices lie on the old straight pieces. Ends, corners and sharp bends stay: vertices at which
/// the line, over a step to either side, turns by more than 45 degrees and more than at any other within a
/// step. A closed line with bends but no corner begins at the first of them. Values of vertices are
/// interpolated along the line, normals as directions. Curves that were fitted to the lines are dropped.
/// Cost: O(old and new vertices).
/// \param step more than 0, in the unit of the graph
/// \throw InvalidArgument for an invalid graph or a step out of range; OutOfMemory for a step so small that
/// a line would have more than max_points vertices; Cancelled.
[[nodiscard]] FeatureGraph resample_lines(const FeatureGraph& graph, double step,
                                          const Progress& progress = no_progress());

}  // namespace keenline
