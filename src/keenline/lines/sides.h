#pragma once

#include <optional>
#include <vector>

#include "keenline/feature_graph.h"
#include "keenline/lines/find_sides.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// The sides of a line at every vertex, by find_sides(). Vertices nearer than options.reach to a corner that
/// the line ends in see what is that far from it, lest another face of the corner be taken for a side; where
/// a side is bent only options.stretch, because it cannot be continued so far. Vertices at which nothing is
/// found have the sides of the nearest one along the line that is at most options.reach away. Advances
/// `progress` by the vertices; the caller began the stage.
/// Threads: any number, same bits.
/// \throw Cancelled
[[nodiscard]] std::vector<std::optional<LineSides>> sides_along(const Polyline& line, const PointCloud& cloud,
                                                                const NeighborSearch& search, double spacing,
                                                                const SidesOptions& options = {},
                                                                Progress& progress = no_progress());

/// What the sides of a line say at each vertex: dihedral_deg (not of borders), normals and, as they were
/// fitted, residual. Vertices without sides take the values of the nearest one along the line that has some;
/// if there is none the vectors become empty.
/// \pre as many sides as vertices
void describe(Polyline& line, const std::vector<std::optional<LineSides>>& sides);

/// describe() for every line, at the vertices as they are; residuals that are known are kept.
/// Threads: any number, same bits.
/// \pre the search is of this cloud
/// \throw InvalidArgument for an invalid graph or unless spacing > 0 and finite; Cancelled.
void measure_sides(FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search, double spacing,
                   Progress& progress = no_progress());

}  // namespace keenline
