#pragma once

#include <vector>

#include "keenline/feature_graph.h"
#include "keenline/lines/foot.h"
#include "keenline/progress.h"

namespace keenline {

/// Joins paths into a graph: ends that face each other become one line, ends that meet at an angle, or run
/// into another line, a corner. A corner lies where the planes of all its lines come together (least
/// squares). A line that ends loose, or leads back to its own corner, and is shorter than `min_length` is
/// left out.
/// \param paths and min_length in the frame
/// \throw Cancelled
[[nodiscard]] FeatureGraph connect_paths(std::vector<Path> paths, const TraceFrame& frame, double min_length,
                                         const Progress& progress = no_progress());

}  // namespace keenline
