#pragma once

#include <cstddef>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

struct Segment {
  Point a{};
  Point b{};
};

/// Exact distance of a point to a segment; to a point where the ends are equal.
[[nodiscard]] double distance_to(const Segment& segment, const Point& p);

/// Finds the nearest of many segments: a balanced tree of bounding boxes. Built in O(n log^2 n). Queries are
/// const and may run in parallel.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<Segment> segments);

  /// Distance to the nearest segment, the same bits as trying each; infinite when there are none.
  [[nodiscard]] double distance_to_nearest(const Point& p) const;

 private:
  struct Node {
    Point low;
    Point high;
  };

  void build(std::size_t node, std::size_t begin, std::size_t end);
  void search(std::size_t node, std::size_t begin, std::size_t end, const Point& p, double& nearest) const;

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace keenline
