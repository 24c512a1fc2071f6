#pragma once

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

struct TraceDemarsinOptions {
  double extra_reach = 4;  ///< 0 to 100 spacings: clusters within it are connected, each to the nearest six
  /// 0 to 100 spacings: an open end is connected to what is within it. More than extra_reach and min_branch
  /// together: so long is the gap where a loop was cut near a junction.
  double close_reach = 10;
  double close_ratio = 3;  ///< 1 to 100: if the way there along the lines is so many times as long
  /// Branches that end loose and lines that are shorter are noise. 0 to 1000 spacings.
  double min_branch = 5;
  /// Take out all that ends loose: the method is for closed edges.
  bool closed_only = true;
  int smooth_rounds = 10;  ///< 0 to 1000
};

/// Lines by a graph of clusters: candidates at one place are a node; nodes whose candidates are neighbours,
/// and near ones, are connected; of the minimum spanning tree all short branches are taken out; its open
/// ends, one for every loop, are connected to what is near them in space but far along the lines; what ends
/// loose then is taken out, junctions close to each other become one, and lines are smoothed. Lines are
/// creases; vertices, corners and support (the candidates of the nodes) are filled in.
/// Paper: Demarsin, Vanderstraeten, Volodine, Roose, "Detection of closed sharp edges in point clouds using
/// normal estimation and graph theory", 2007, section 4. Departures: see docs/methods/demarsin.md.
/// \param spacing of the cloud, see estimate_spacing(); nothing is traced unless it is more than 0
/// \pre search is in the cloud's positions
/// \throw InvalidArgument when an option is out of range or labels are not those of the cloud; OutOfMemory;
/// Cancelled.
/// Threads: any number, same bits. Cost: O(candidates log candidates). Memory: that of Candidates, and 200
/// bytes per candidate.
[[nodiscard]] FeatureGraph trace_demarsin(const PointCloud& cloud, const NeighborSearch& search,
                                          const FeatureLabels& labels, double spacing,
                                          const TraceDemarsinOptions& options = {},
                                          Progress& progress = no_progress());

}  // namespace keenline
