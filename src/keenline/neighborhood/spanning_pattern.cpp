#include "keenline/neighborhood/spanning_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "keenline/neighborhood/disjoint_sets.h"
#include "keenline/require.h"

namespace keenline {
namespace {

/// Breadth first, from both nodes by turns: between two nodes that are far from each other most of what one
/// search would see is as far away as it may look.
class DetourSearch {
 public:
  explicit DetourSearch(const NodeGraph& graph) : graph_(graph), seen_by_(graph.size()) {}

  /// Is there a way from a to b, which differ, of at most `longest` edges?
  bool reaches(std::uint32_t a, std::uint32_t b, std::size_t longest) {
    fronts_[0].assign(1, a);
    fronts_[1].assign(1, b);
    seen_by_[a] = 1;
    seen_by_[b] = 2;
    touched_.assign({a, b});
    bool met = false;
    for (std::size_t length = 0; length < longest && !met; ++length) {
      const std::size_t side = fronts_[0].size() <= fronts_[1].size() ? 0 : 1;
      if (fronts_[side].empty()) break;
      met = widen(side);
    }
    for (const std::uint32_t node : touched_) seen_by_[node] = 0;
    return met;
  }

 private:
  /// By one edge; true when the other side is met.
  bool widen(std::size_t side) {
    const auto own = static_cast<std::uint8_t>(side + 1);
    next_.clear();
    for (const std::uint32_t node : fronts_[side]) {
      for (const std::uint32_t neighbor : graph_.neighbors_of(node)) {
        if (seen_by_[neighbor] == own) continue;
        if (seen_by_[neighbor] != 0) return true;
        seen_by_[neighbor] = own;
        touched_.push_back(neighbor);
        next_.push_back(neighbor);
      }
    }
    fronts_[side].swap(next_);
    return false;
  }

  const NodeGraph& graph_;
  std::vector<std::uint8_t> seen_by_;  // 0, or the side + 1
  std::vector<std::uint32_t> touched_;
  std::array<std::vector<std::uint32_t>, 2> fronts_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

std::size_t shortest_cycle_for(std::size_t points, std::size_t least) {
  return std::max(least, static_cast<std::size_t>(std::sqrt(static_cast<double>(points)) / 2));
}

void require_cycle(int shortest_cycle) {
  require_in_range("shortest_cycle", shortest_cycle, 1, std::numeric_limits<double>::infinity());
}

NodeGraph spanning_pattern(std::size_t node_count, std::vector<WeightedEdge> edges,
                           std::size_t longest_detour, const Progress& progress) {
  std::sort(edges.begin(), edges.end(), [](const WeightedEdge& x, const WeightedEdge& y) {
    return std::tie(x.weight, x.a, x.b) < std::tie(y.weight, y.a, y.b);
  });
  NodeGraph pattern(node_count);
  DisjointSets components(node_count);
  DetourSearch search(pattern);
  for (const WeightedEdge& edge : edges) {
    progress.check();
    if (!components.join(edge.a, edge.b) && search.reaches(edge.a, edge.b, longest_detour)) continue;
    pattern.connect(edge.a, edge.b);
  }
  return pattern;
}

}  // namespace keenline
