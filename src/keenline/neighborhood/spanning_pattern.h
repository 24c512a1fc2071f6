#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/progress.h"

namespace keenline {

/// \pre a < b
struct WeightedEdge {
  std::uint32_t a;
  std::uint32_t b;
  double weight;  ///< smaller is better; not NaN
};

/// Nodes in a row, those in the middle of degree 2.
struct PatternChain {
  std::vector<std::uint32_t> nodes;  ///< a loop does not repeat its first
  bool is_loop = false;  ///< goes on from the last node to the first; that one alone may be a junction
};

/// Half the square root of the number of points, as many edges as Gumhold et al. ask of a cycle; not less
/// than `least`.
[[nodiscard]] std::size_t shortest_cycle_for(std::size_t points, std::size_t least);

/// \throw InvalidArgument unless 1 or more.
void require_cycle(int shortest_cycle);

/// A minimum spanning pattern: a minimum spanning forest that may close long cycles, so that loops of a
/// drawing stay loops. Gumhold, Wang, MacLeod 2001, "Feature Extraction from Point Clouds", section 4; Pauly,
/// Keiser, Gross 2003 cut their feature lines from the same.
/// Nodes of degree 1 are ends, of degree 2 on a line, of more junctions; of degree 0 not in the pattern.
class SpanningPattern {
 public:
  /// Kruskal's algorithm: the lightest edge first, equal ones by (a, b). An edge within a component is taken
  /// if the shortest way between its nodes so far has more than `longest_detour` edges.
  /// Cost: O(m log m), and for each of the edges within a component what lies within longest_detour edges.
  /// \pre all nodes are below node_count \throw Cancelled
  SpanningPattern(std::size_t node_count, std::vector<WeightedEdge> edges, std::size_t longest_detour,
                  const Progress& progress = no_progress());

  [[nodiscard]] std::size_t size() const { return neighbors_.size(); }
  /// Rising.
  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::uint32_t node) const {
    return neighbors_[node];
  }
  [[nodiscard]] std::size_t degree_of(std::uint32_t node) const { return neighbors_[node].size(); }

  /// Takes the edges out of every component of fewer nodes.
  void drop_components_below(std::size_t min_nodes);

  /// Takes out chains from an end to a junction with fewer edges, the shortest first (equal ones by their
  /// end), as long as there are any: what remains of a junction may be part of a longer chain.
  void prune_chains_below(std::size_t min_edges);

  /// Takes out whatever hangs on an end: loops stay, and what connects them.
  void keep_loops();

  /// Every edge once: first the chains that begin at an end or a junction, by that node and the next one,
  /// then the loops without a junction, from their smallest node on towards the smaller of its neighbours.
  [[nodiscard]] std::vector<PatternChain> chains() const;

 private:
  void disconnect(std::uint32_t a, std::uint32_t b);
  /// From `start` over `next` up to the first node that is not of degree 2, or back to start.
  [[nodiscard]] PatternChain chain_from(std::uint32_t start, std::uint32_t next) const;

  std::vector<std::vector<std::uint32_t>> neighbors_;
};

}  // namespace keenline
