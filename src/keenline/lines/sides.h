#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "keenline/feature_graph.h"
#include "keenline/lines/find_sides.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// What find_sides() said of places of one line: where the line has stayed it need not be asked again.
class KnownSides {
 public:
  /// Null where it was not asked; empty where it found nothing.
  [[nodiscard]] const std::optional<LineSides>* at(const Point& position, const Point& direction) const;
  void add(const Point& position, const Point& direction, const std::optional<LineSides>& sides);

 private:
  std::map<std::pair<Point, Point>, std::optional<LineSides>> sides_;
};

/// The sides of a line at every vertex, by find_sides(). Vertices nearer than options.reach to a corner that
/// the line ends in see what is that far from it, lest another face of the corner be taken for a side; where
/// a side is bent only options.stretch, because it cannot be continued so far. Vertices at which nothing is
/// found have the sides of the nearest one along the line that is at most options.reach away. Advances
/// `progress` by the vertices; the caller began the stage.
/// Threads: any number, same bits.
/// \param known of an earlier call for the same line, which may have moved, with the same cloud, spacing and
/// options, or still empty; becomes that of this call
/// \throw Cancelled
[[nodiscard]] std::vector<std::optional<LineSides>> sides_along(const Polyline& line, const PointCloud& cloud,
                                                                const NeighborSearch& search, double spacing,
                                                                const SidesOptions& options = {},
                                                                Progress& progress = no_progress(),
                                                                KnownSides* known = nullptr);

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
