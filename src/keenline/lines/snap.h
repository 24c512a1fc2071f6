#pragma once

#include "keenline/feature_graph.h"
#include "keenline/lines/find_sides.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// Lengths in spacings.
struct SnapOptions {
  double largest_move = 2;         ///< more than 0: of a vertex
  double largest_corner_move = 3;  ///< more than 0: of a corner, from which a rounding takes more
  int rounds = 2;                  ///< 1 to 10; each looks at the sides from where the one before led to
  SidesOptions sides{};            ///< which points tell of the surfaces
};

/// The lines where the surfaces beside them meet, continued: of a rounded or worn edge the one that was
/// designed. Every vertex goes to the nearest point of both its sides (see sides_along()), perpendicular to
/// the line; a vertex of a border to the rim of its surface (see rim_of()). Corners go to the point of least
/// squares of the sides of all lines that end there, as far as these fix it: along directions in which they
/// leave it open, because fewer than three surfaces differ by 6 degrees or more, it does not move. A corner
/// without lines stays.
/// What would move farther than it may, has no credible sides or would end up farther than 0.35 spacings from
/// them stays where it is. Vertices that would then lie behind the one before, or beyond the corner, are left
/// out. Fills dihedral angles, normals and residuals: of a vertex the root mean square distance of the points
/// from their sides (the larger of the two), or its own from the sides if that is larger; of a corner the
/// root mean square of its distances from the sides. Curves that were fitted to the lines are dropped.
/// Threads: any number, same bits. Cost: about 0.5 ms per vertex and core.
/// \pre the search is of this cloud
/// \throw InvalidArgument for an invalid graph, or unless spacing > 0 and finite and the options are in
/// range; Cancelled.
[[nodiscard]] FeatureGraph snap_lines(const FeatureGraph& graph, const PointCloud& cloud,
                                      const NeighborSearch& search, double spacing,
                                      const SnapOptions& options = {}, Progress& progress = no_progress());

}  // namespace keenline
