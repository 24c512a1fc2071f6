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

/// The lines in which the surfaces beside them, continued, meet: of a rounded or worn edge the one that was
/// drawn. Every vertex goes to the nearest point of both its sides (see sides_along()) and of those of its
/// neighbours up to 3 spacings along the line, perpendicular to it; a vertex of a border to the rim of its
/// surface (see rim_of()). Corners go to the point of least squares of the sides of all lines that end
/// there, as far as these fix it: along directions that they leave open, because fewer than three surfaces
/// differ by 6 degrees or more, a corner does not move. A corner in which no line ends stays. What would
/// move farther than it may, has no credible sides or would end up farther than 0.35 spacings from them
/// stays where it is. Of vertices that would then have changed places the one goes that moved farther. Fills
/// dihedral angles, normals and residuals: of a vertex how far the points are from their sides (root mean
/// square, the larger of the two), or the vertex itself, if that is farther; of a corner the root mean
/// square of its distances from the sides. Curves that were fitted to the lines are dropped.
/// Threads: any number, same bits. Cost: about 0.2 ms per vertex, round and core.
/// \pre the search is of this cloud
/// \throw InvalidArgument for an invalid graph, or unless spacing > 0 and finite and the options are in
/// range; Cancelled.
[[nodiscard]] FeatureGraph snap_lines(const FeatureGraph& graph, const PointCloud& cloud,
                                      const NeighborSearch& search, double spacing,
                                      const SnapOptions& options = {}, Progress& progress = no_progress());

}  // namespace keenline
