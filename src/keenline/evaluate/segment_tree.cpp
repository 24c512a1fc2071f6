#include "keenline/evaluate/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr std::size_t leaf_size = 4;

}  // namespace

double distance_to(const Segment& segment, const Point& p) {
  const Point along = difference(segment.b, segment.a);
  const Point to_p = difference(p, segment.a);
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(to_p, along) / square, 0.0, 1.0) : 0.0;
  Point gap{};
  // From the nearer end, so that a point there is at distance 0 whatever t was rounded to.
  const Point& end = t < 0.5 ? segment.a : segment.b;
  const double from_end = t < 0.5 ? t : t - 1;
  for (std::size_t axis = 0; axis < 3; ++axis) gap[axis] = (p[axis] - end[axis]) - from_end * along[axis];
  return std::sqrt(dot(gap, gap));
}

SegmentTree::SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  std::size_t nodes = 1;
  for (std::size_t size = segments_.size(); size > leaf_size; size = size - size / 2) nodes = 2 * nodes + 1;
  nodes_.resize(nodes);
  build(0, 0, segments_.size());
}

// Node i has the children 2i + 1 and 2i + 2, which hold the first and the second half of its segments.
void SegmentTree::build(std::size_t node, std::size_t begin, std::size_t end) {
  Node& box = nodes_[node];
  box.low = box.high = segments_[begin].a;
  for (std::size_t i = begin; i < end; ++i) {
    for (const Point* p : {&segments_[i].a, &segments_[i].b}) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], (*p)[axis]);
        box.high[axis] = std::max(box.high[axis], (*p)[axis]);
      }
    }
  }
  if (end - begin <= leaf_size) return;
  const Point size = difference(box.high, box.low);
  const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const std::size_t middle = begin + (end - begin) / 2;
  const auto first = segments_.begin();
  const auto at = [&](std::size_t i) { return first + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end), [&](const Segment& s, const Segment& t) {
    return 0.5 * s.a[axis] + 0.5 * s.b[axis] < 0.5 * t.a[axis] + 0.5 * t.b[axis];
  });
  build(2 * node + 1, begin, middle);
  build(2 * node + 2, middle, end);
}

double SegmentTree::distance_to_nearest(const Point& p) const {
  double nearest = std::numeric_limits<double>::infinity();
  if (!segments_.empty()) search(0, 0, segments_.size(), p, nearest);
  return nearest;
}

void SegmentTree::search(std::size_t node, std::size_t begin, std::size_t end, const Point& p,
                         double& nearest) const {
  if (end - begin <= leaf_size) {
    for (std::size_t i = begin; i < end; ++i) nearest = std::min(nearest, distance_to(segments_[i], p));
    return;
  }
  const auto gap_to = [&](std::size_t child) {
    Point gap{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      gap[axis] = std::max({nodes_[child].low[axis] - p[axis], p[axis] - nodes_[child].high[axis], 0.0});
    return std::sqrt(dot(gap, gap));
  };
  const std::size_t middle = begin + (end - begin) / 2;
  const std::size_t left = 2 * node + 1;
  const std::size_t right = 2 * node + 2;
  const double left_gap = gap_to(left);
  const double right_gap = gap_to(right);
  // The slack is more than rounding can make of a distance: no segment that is nearest is passed over.
  const auto is_worth = [&](double gap) { return gap * (1 - 1e-12) <= nearest; };
  const auto search_left = [&] {
    if (is_worth(left_gap)) search(left, begin, middle, p, nearest);
  };
  const auto search_right = [&] {
    if (is_worth(right_gap)) search(right, middle, end, p, nearest);
  };
  if (left_gap <= right_gap) {
    search_left();
    search_right();
  } else {
    search_right();
    search_left();
  }
}

}  // namespace keenline
