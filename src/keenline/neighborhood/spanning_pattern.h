#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "keenline/neighborhood/node_graph.h"
#include "keenline/progress.h"

namespace keenline {

/// \pre a < b
struct WeightedEdge {
  std::uint32_t a;
  std::uint32_t b;
  double weight;  ///< smaller is better; not NaN
};

/// Half the square root of the number of points, as many edges as Gumhold et al. ask of a cycle; not less
/// than `least`.
[[nodiscard]] std::size_t shortest_cycle_for(std::size_t points, std::size_t least);

/// \throw InvalidArgument unless 1 or more.
void require_cycle(int shortest_cycle);

/// A minimum spanning pattern: a minimum spanning forest that may close long cycles, so that loops of a
/// drawing stay loops. Gumhold, Wang, MacLeod 2001, "Feature Extraction from Point Clouds", section 4; Pauly,
/// Keiser, Gross 2003 cut their feature lines from the same.
/// Kruskal's algorithm: the lightest edge first, equal ones by (a, b). An edge within a component is taken if
/// the shortest way between its nodes so far has more than `longest_detour` edges.
/// Cost: O(m log m), and for each of the edges within a component what lies within longest_detour edges.
/// \pre all nodes are below node_count \throw Cancelled
[[nodiscard]] NodeGraph spanning_pattern(std::size_t node_count, std::vector<WeightedEdge> edges,
                                         std::size_t longest_detour,
                                         const Progress& progress = no_progress());

}  // namespace keenline
