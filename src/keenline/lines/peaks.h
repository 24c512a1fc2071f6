#pragma once

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/lines/foot.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// Adds the peaks that no line comes near, as corners without lines. They are looked for around points
/// labelled Peak, the sharpest first, then around other sharp points without a line within 3 spacings: with
/// noise a detector that looks at a few neighbours takes an apex for edges. A circular cone is fitted to the
/// 80 points around (Tukey's weights); its apex is the corner, so it need not be a point of the cloud, and
/// its residual the root mean square distance of the points from the cone. The cone has to fit far better
/// than the smooth surface of as many parameters, to 0.15 spacings, enclose its axis and reach up to its
/// apex, and that at most 3 spacings from where it was looked for. Where it does not, a point labelled Peak
/// stays a corner as it is, without a residual. Of peaks within 3 spacings of each other the first remains.
/// \pre search is in the cloud's positions; labels.size() == cloud.size(); frame.spacing > 0
/// \throw Cancelled. Threads: may be called from many at once. Cost: about 0.5 ms for each place.
void add_peaks(FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search,
               const FeatureLabels& labels, const TraceFrame& frame,
               const Progress& progress = no_progress());

}  // namespace keenline
