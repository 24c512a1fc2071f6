#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

/// Nodes in a row; those inside have no other neighbours.
struct NetChain {
  std::vector<std::uint32_t> nodes;  ///< a closed one does not repeat its first
  bool is_closed = false;            ///< without a junction
};

/// Nodes in space and the straight pieces between them, on the way from a graph of candidates to lines: ends
/// have one neighbour, junctions more than two. Everything happens in the order of the nodes' indices.
class LineNet {
 public:
  explicit LineNet(std::vector<Point> positions)
      : positions_(std::move(positions)), neighbors_(positions_.size()) {}

  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] const Point& position_of(std::uint32_t node) const { return positions_[node]; }
  void move(std::uint32_t node, const Point& position) { positions_[node] = position; }
  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::uint32_t node) const {
    return neighbors_[node];
  }
  [[nodiscard]] std::size_t degree_of(std::uint32_t node) const { return neighbors_[node].size(); }
  /// Nodes of degree 1, rising.
  [[nodiscard]] std::vector<std::uint32_t> ends() const;

  /// Nothing happens where they are connected, or one node.
  void connect(std::uint32_t a, std::uint32_t b);
  void disconnect(std::uint32_t a, std::uint32_t b);

  /// Takes out every connected part whose pieces are shorter together.
  void drop_parts_below(double min_length);

  /// Takes out the chains from an end to a junction that are shorter, the shortest first, as long as there
  /// are any: with one gone, what remains of its junction may be the middle of a longer one.
  void prune_branches_below(double min_length);

  /// Takes out all that hangs on an end: what is left has none.
  void drop_branches();

  /// Makes one node of all junctions that are closer together than `distance` and no more than twice as far
  /// along the net, and of what lies between them. It is at the mean of the junctions.
  void merge_junctions(double distance);

  /// Takes out the chains that lead from a junction back to it and are shorter.
  void drop_eyelets_below(double min_length);

  /// Length of the shortest way along the net; infinite where it is `limit` or more.
  [[nodiscard]] double way_between(std::uint32_t a, std::uint32_t b, double limit) const;

  /// Every piece once: first the chains that begin at an end or a junction, then the closed ones.
  [[nodiscard]] std::vector<NetChain> chains() const;

 private:
  [[nodiscard]] NetChain chain_from(std::uint32_t start, std::uint32_t next) const;
  [[nodiscard]] double length_of(const NetChain& chain) const;
  void take_out(const NetChain& chain);
  void isolate(std::uint32_t node);

  std::vector<Point> positions_;
  std::vector<std::vector<std::uint32_t>> neighbors_;  // rising
};

}  // namespace keenline
