#pragma once

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

struct TraceOptions {
  /// Lines that end loose, and those that lead from a corner back to it, are noise when shorter than so many
  /// spacings. At least 0.
  double min_length = 6;
};

/// From labelled points to a drawing, whatever method labelled them: thin lines with gaps, or bands several
/// spacings wide. Lines are walked along the surfaces that meet in them, not from candidate to candidate:
/// candidates say where a crease may be, the points around decide (see WedgeTracker), and carry the walk over
/// gaps. Edge and Corner points are candidates for creases, Border points for borders, and a peak that no
/// line comes near is a corner without lines (see add_peaks()). Corners are where lines come together,
/// whatever was labelled Corner. Details and constants: docs/lines.md.
///
/// Filled in are vertices, kind, closed, corners with their residual, and support: the candidates within 1.5
/// spacings of the line. The graph is valid, see validate(), and empty where there is nothing to trace.
/// \param spacing of the cloud, see estimate_spacing(); nothing is traced unless it is more than 0
/// \pre search is in the cloud's positions; labels.size() == cloud.size()
/// \throw InvalidArgument when an option is out of range or labels are not those of the cloud; Cancelled.
/// Threads: any number, same bits. Cost: O(candidates + length of the lines), about 0.1 ms each, and that
/// of estimate_noise(). Memory: 400 bytes per candidate.
[[nodiscard]] FeatureGraph trace_lines(const PointCloud& cloud, const NeighborSearch& search,
                                       const FeatureLabels& labels, double spacing,
                                       const TraceOptions& options = {}, Progress& progress = no_progress());

}  // namespace keenline
