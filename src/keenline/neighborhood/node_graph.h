#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace keenline {

/// Nodes in a row, those in the middle of degree 2.
struct NodeChain {
  std::vector<std::uint32_t> nodes;  ///< a loop does not repeat its first
  bool is_loop = false;  ///< goes on from the last node to the first; that one alone may be a junction
};

/// Nodes, by number, and the edges between them: what lines are before they are drawn. Nodes of degree 1 are
/// ends, of degree 2 on a line, of more junctions; of degree 0 on nothing. Everything happens in the order
/// of the nodes.
class NodeGraph {
 public:
  explicit NodeGraph(std::size_t node_count) : neighbors_(node_count) {}

  [[nodiscard]] std::size_t size() const { return neighbors_.size(); }
  /// Rising.
  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::uint32_t node) const {
    return neighbors_[node];
  }
  [[nodiscard]] std::size_t degree_of(std::uint32_t node) const { return neighbors_[node].size(); }
  /// Nodes of degree 1, rising.
  [[nodiscard]] std::vector<std::uint32_t> ends() const;

  /// Nothing happens where they are connected, or one node.
  void connect(std::uint32_t a, std::uint32_t b);
  void disconnect(std::uint32_t a, std::uint32_t b);
  /// Takes out all edges of a node.
  void isolate(std::uint32_t node);
  /// Takes out all edges of a chain.
  void take_out(const NodeChain& chain);

  /// Takes out every connected part of fewer nodes.
  void drop_small_parts(std::size_t min_nodes);

  /// Takes out the chains from an end to a junction with fewer edges, the shortest first (equal ones by their
  /// end), as long as there are any: what remains of their junction may be the middle of a longer one.
  void prune_short_branches(std::size_t min_edges);

  /// Takes out all that hangs on an end: what is left has none.
  void drop_branches();

  /// Every edge once: first the chains that begin at an end or a junction, by that node and the next one,
  /// then the loops without a junction, from their smallest node on towards the smaller of its neighbours.
  [[nodiscard]] std::vector<NodeChain> chains() const;

 protected:
  using ChainLength = std::function<double(const NodeChain&)>;
  using PartSize = std::function<double(std::span<const std::uint32_t>)>;

  /// prune_short_branches() and drop_small_parts() by another measure, which grows with every edge. A part is
  /// all of its nodes, breadth first from the smallest.
  void prune_branches(double min_length, const ChainLength& length);
  void drop_parts(double min_size, const PartSize& size);

 private:
  /// From `start` over `next` up to the first node that is not of degree 2, or back to start.
  [[nodiscard]] NodeChain chain_from(std::uint32_t start, std::uint32_t next) const;

  std::vector<std::vector<std::uint32_t>> neighbors_;  // rising
};

}  // namespace keenline
