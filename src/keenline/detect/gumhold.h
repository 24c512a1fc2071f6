#pragma once

#include <optional>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct GumholdOptions {
  /// Neighbours in the graph that the pattern is taken from; with fewer a point is undecided. 3 to 255.
  int neighbors = 16;
  /// An edge of the graph may be part of a crease where its penalty is smaller, 0 to 2: 2 is a plane, 0.2 an
  /// edge of 90 degrees, 0.6 one of 120. The paper's is 1.7, for its own penalties; less where there is
  /// noise.
  double crease_limit = 1.4;
  /// Points with a sector of the plane without neighbours that is wider may be part of a border. Degrees,
  /// 0 to 360.
  double border_gap_deg = 100;
  /// Cycles of a pattern have more edges, its components at least as many nodes, its branches at least half
  /// as many edges. 1 or more. Empty = half the square root of the number of points, as in the paper.
  std::optional<int> shortest_cycle;
  /// The paper's penalties, each point's curvature against the largest of all.
  bool plain = false;
};

/// Features as minimum spanning patterns of the neighbour graph. Every edge of the graph has a penalty for
/// being part of a crease, low where both ends are bent and the edge runs along the crease; edges below
/// crease_limit make a spanning forest that may close long cycles, and short branches are cut off. The points
/// of that pattern are edges, its junctions corners. Points of the same pattern over the rim of the surface
/// are borders: there only loops stay. The rest is flat, or curved where it bends.
///
/// The score is 1 minus the penalty of the point itself, 0 to 1. Paper: Gumhold, Wang, MacLeod 2001, "Feature
/// Extraction from Point Clouds". Departures: see docs/methods/gumhold.md. Threads: any number, same bits.
/// Cost: O(n neighbors); on one thread O(m log m) for the m edges below the limit, and for each of them that
/// would close a cycle a search of the pattern so far, up to shortest_cycle edges far. Memory: 140 bytes per
/// point, 16 to 48 for each of those edges, which are not known before: they are not asked for.
/// \pre search is in the cloud's positions
/// \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_gumhold(const PointCloud& cloud, const NeighborSearch& search,
                                           const GumholdOptions& options = {},
                                           Progress& progress = no_progress());

}  // namespace keenline
