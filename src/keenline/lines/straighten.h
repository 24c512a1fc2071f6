#pragma once

#include "keenline/feature_graph.h"

namespace keenline {

/// Lines that are straight as far as anyone can tell become straight. Made for scans, where mouldings, joints
/// and coarse sampling leave no two surfaces to move a line onto, so that it stays as it was traced and its
/// residuals say how little is known: such a line wavers. Every vertex is taken to be known to its residual
/// (one spacing, where there is none). A stretch of 10 spacings or more whose vertices are known, by their
/// median, no better than to a fifth of a spacing is put on the straight line that fits it best, if that
/// leaves nobody farther off than he may be, three times his residual or that median, and the root mean
/// square within one, and the stretch is not bent: no parabola explains half of what the line does not,
/// unless it rises less than 0.35 spacings. A line that is not straight as a whole is divided where it is
/// farthest from its chord, and its parts are tried. What stands on surfaces that were found is left alone,
/// and so are closed lines. Corners that are known no better than to 0.35 spacings move onto the straight
/// lines that end there, by 1 spacing at most; others stay. The residual of what has moved is at least the
/// way that it went. Inner vertices that would go back along their line are dropped, and so are curves that
/// were fitted to it. Cost: O(n log n) for lines that are not divided all too unevenly.
/// \pre spacing > 0 \throw InvalidArgument for an invalid graph.
[[nodiscard]] FeatureGraph straighten_lines(const FeatureGraph& graph, double spacing);

}  // namespace keenline
