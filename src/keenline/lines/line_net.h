#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/neighborhood/node_graph.h"

namespace keenline {

/// A graph of nodes that have a place, on the way from candidates to lines: its edges are straight pieces,
/// and have a length.
class LineNet : public NodeGraph {
 public:
  explicit LineNet(std::vector<Point> positions)
      : NodeGraph(positions.size()), positions_(std::move(positions)) {}

  [[nodiscard]] const Point& position_of(std::uint32_t node) const { return positions_[node]; }
  void move(std::uint32_t node, const Point& position) { positions_[node] = position; }

  /// Takes out every connected part whose pieces are shorter together.
  void drop_parts_below(double min_length);

  /// As prune_short_branches(), by length.
  void prune_branches_below(double min_length);

  /// Makes one node of all junctions that are closer together than `distance` and no more than twice as far
  /// along the net, and of what lies between them. It is at the mean of the junctions.
  void merge_junctions(double distance);

  /// Takes out the chains that lead from a junction back to it and are shorter.
  void drop_eyelets_below(double min_length);

  /// Length of the shortest way along the net; infinite where it is `limit` or more.
  [[nodiscard]] double way_between(std::uint32_t a, std::uint32_t b, double limit) const;

 private:
  [[nodiscard]] double length_of(const NodeChain& chain) const;

  std::vector<Point> positions_;
};

}  // namespace keenline
