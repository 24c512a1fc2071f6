#pragma once

#include "keenline/feature_graph.h"

namespace keenline {

struct SmoothLinesOptions {
  int neighbors = 5;  ///< 2 to 1000: vertices on either side that a vertex is averaged with
};

/// The lines without the unrest of their vertices. Every vertex goes to where a parabola over arc length is
/// there, fitted to it and its neighbours with weights that fall to nothing behind the last of them
/// (Cleveland 1979, "Robust locally weighted regression and smoothing scatterplots", without the robust
/// rounds). As parabolas are bent like the line, nothing shrinks: a circle of 20 vertices or more keeps its
/// length within 0.1 %. Of a closed line at most a tenth of the vertices are taken on either side, but two.
/// The ends of open lines and corners stay; sharp bends that are no corners are rounded. Values of vertices
/// stay as they are; curves that were fitted to the lines are dropped.
/// Threads: any number, same bits. Cost: O(vertices neighbors).
/// \throw InvalidArgument for an invalid graph or an option out of range.
[[nodiscard]] FeatureGraph smooth_lines(const FeatureGraph& graph, const SmoothLinesOptions& options = {});

}  // namespace keenline
