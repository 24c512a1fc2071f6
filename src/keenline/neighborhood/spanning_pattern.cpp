#include "keenline/neighborhood/spanning_pattern.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>

#include "keenline/neighborhood/disjoint_sets.h"
#include "keenline/require.h"

namespace keenline {
namespace {

using Neighbors = std::vector<std::vector<std::uint32_t>>;

/// Breadth first, from both nodes by turns: between two nodes that are far from each other most of what one
/// search would see is as far away as it may look.
class DetourSearch {
 public:
  explicit DetourSearch(const Neighbors& neighbors) : neighbors_(neighbors), seen_by_(neighbors.size()) {}

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
      for (const std::uint32_t neighbor : neighbors_[node]) {
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

  const Neighbors& neighbors_;
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

SpanningPattern::SpanningPattern(std::size_t node_count, std::vector<WeightedEdge> edges,
                                 std::size_t longest_detour, const Progress& progress)
    : neighbors_(node_count) {
  std::sort(edges.begin(), edges.end(), [](const WeightedEdge& x, const WeightedEdge& y) {
    return std::tie(x.weight, x.a, x.b) < std::tie(y.weight, y.a, y.b);
  });
  DisjointSets components(node_count);
  DetourSearch search(neighbors_);
  for (const WeightedEdge& edge : edges) {
    progress.check();
    if (!components.join(edge.a, edge.b) && search.reaches(edge.a, edge.b, longest_detour)) continue;
    neighbors_[edge.a].push_back(edge.b);
    neighbors_[edge.b].push_back(edge.a);
  }
  for (auto& neighbors : neighbors_) std::sort(neighbors.begin(), neighbors.end());
}

void SpanningPattern::disconnect(std::uint32_t a, std::uint32_t b) {
  std::erase(neighbors_[a], b);
  std::erase(neighbors_[b], a);
}

void SpanningPattern::drop_components_below(std::size_t min_nodes) {
  DisjointSets components(size());
  for (std::uint32_t node = 0; node < size(); ++node)
    for (const std::uint32_t neighbor : neighbors_[node]) components.join(node, neighbor);
  std::vector<std::size_t> count(size());
  for (std::uint32_t node = 0; node < size(); ++node) ++count[components.find(node)];
  for (std::uint32_t node = 0; node < size(); ++node)
    if (count[components.find(node)] < min_nodes) neighbors_[node].clear();
}

void SpanningPattern::prune_chains_below(std::size_t min_edges) {
  using Candidate = std::pair<std::size_t, std::uint32_t>;  // edges, end
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> candidates;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (degree_of(node) == 1) candidates.emplace(0, node);
  while (!candidates.empty()) {
    const auto [edges, end] = candidates.top();
    candidates.pop();
    const PatternChain chain = chain_from(end, neighbors_[end].front());
    const std::size_t edges_now = chain.nodes.size() - 1;
    if (edges_now >= min_edges || degree_of(chain.nodes.back()) == 1) continue;
    // A junction that others were taken from is none any more, and the chain goes on beyond it.
    if (edges_now > edges) candidates.emplace(edges_now, end);
    else
      for (std::size_t i = 1; i < chain.nodes.size(); ++i) disconnect(chain.nodes[i - 1], chain.nodes[i]);
  }
}

void SpanningPattern::keep_loops() {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (degree_of(node) == 1) ends.push_back(node);
  while (!ends.empty()) {
    const std::uint32_t end = ends.back();
    ends.pop_back();
    if (degree_of(end) != 1) continue;  // two ends of one edge
    const std::uint32_t next = neighbors_[end].front();
    disconnect(end, next);
    if (degree_of(next) == 1) ends.push_back(next);
  }
}

PatternChain SpanningPattern::chain_from(std::uint32_t start, std::uint32_t next) const {
  PatternChain chain{{start, next}, false};
  for (std::uint32_t before = start; degree_of(next) == 2;) {
    const auto& around = neighbors_[next];
    const std::uint32_t after = around[0] == before ? around[1] : around[0];
    before = next;
    next = after;
    if (next == start) break;
    chain.nodes.push_back(next);
  }
  if (next == start) chain.is_loop = true;
  return chain;
}

std::vector<PatternChain> SpanningPattern::chains() const {
  std::vector<PatternChain> result;
  std::vector<bool> is_done(size());  // of nodes of degree 2
  for (std::uint32_t node = 0; node < size(); ++node) {
    if (degree_of(node) == 2) continue;
    for (const std::uint32_t next : neighbors_[node]) {
      PatternChain chain = chain_from(node, next);
      const bool is_edge = chain.nodes.size() == 2;
      if (is_edge ? node > next : is_done[chain.nodes[1]]) continue;
      for (const std::uint32_t member : chain.nodes) is_done[member] = true;
      result.push_back(std::move(chain));
    }
  }
  for (std::uint32_t node = 0; node < size(); ++node) {
    if (degree_of(node) != 2 || is_done[node]) continue;
    PatternChain loop = chain_from(node, neighbors_[node].front());
    for (const std::uint32_t member : loop.nodes) is_done[member] = true;
    result.push_back(std::move(loop));
  }
  return result;
}

}  // namespace keenline
