#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/neighborhood/safe_scale.h"
#include "keenline/progress.h"

namespace keenline {

/// Axis-parallel; a point where low == high.
struct Box {
  Point low{};
  Point high{};
};

/// The finite points of a cloud along a Morton curve, and a binary tree of tight boxes around them: what is
/// near in the tree is near in space. Points that coincide share one location.
/// Memory: 4 bytes per point and 56 per node, together about 11 per point; 4 per location more where points
/// coincide; 24 per point more where coordinates had to be scaled (see safe_exponent()).
class BoxTree {
 public:
  /// Nodes lie depth first: the first child of an inner node i is i + 1, the second is nodes()[i + 1].next.
  struct Node {
    Box box;
    std::uint32_t begin;  ///< its first location; its last is before end_of()
    std::uint32_t next;   ///< the node after it and all nodes inside it
  };

  static constexpr std::uint32_t leaf_capacity = 24;

  /// The positions must outlive the tree and stay as they are.
  /// Threads: any number, same tree. Cost: O(n log n).
  /// \throw Cancelled
  explicit BoxTree(const std::vector<Point>& positions, const Progress& progress);
  BoxTree(const BoxTree&) = delete;
  BoxTree& operator=(const BoxTree&) = delete;
  ~BoxTree() = default;

  [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
  [[nodiscard]] bool is_leaf(std::uint32_t node) const { return nodes_[node].next == node + 1; }
  [[nodiscard]] std::uint32_t end_of(std::uint32_t node) const {
    const std::uint32_t next = nodes_[node].next;
    return next < nodes_.size() ? nodes_[next].begin : location_count_;
  }

  [[nodiscard]] std::uint32_t location_count() const { return location_count_; }
  /// All finite points, location after location.
  [[nodiscard]] std::span<const std::uint32_t> points() const { return points_; }
  [[nodiscard]] bool has_coincident_points() const { return !first_.empty(); }
  /// The points at a location, rising.
  [[nodiscard]] std::span<const std::uint32_t> points_at(std::uint32_t location) const {
    if (first_.empty()) return points().subspan(location, 1);
    return points().subspan(first_[location], first_[location + 1] - first_[location]);
  }
  [[nodiscard]] std::uint32_t first_point_at(std::uint32_t location) const {
    return points_[first_.empty() ? location : first_[location]];
  }
  /// Of a point; none when it is not finite. Cost: O(log n) for well-spread points.
  [[nodiscard]] std::optional<std::uint32_t> location_of(std::uint32_t point) const;
  /// Scaled, if that was needed: distances between these square safely.
  [[nodiscard]] const Point& position_of(std::uint32_t point) const { return positions_[point]; }
  /// Any finite position of space as position_of() would give it.
  [[nodiscard]] Point scaled(const Point& position) const {
    return exponent_ == 0 ? position : safely_scaled(position, exponent_);
  }

 private:
  int exponent_;
  std::vector<Point> scaled_;  // empty where the cloud's own coordinates will do
  const Point* positions_;
  std::vector<std::uint32_t> points_;
  std::vector<std::uint32_t> first_;  // location -> its first entry in points_; empty when none coincide
  std::uint32_t location_count_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace keenline
