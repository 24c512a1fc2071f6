#include "keenline/neighborhood/box_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <oneapi/tbb/parallel_sort.h>

namespace keenline {
namespace {

using Range = tbb::blocked_range<std::size_t>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

void include(Box& box, const Point& low, const Point& high) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], low[axis]);
    box.high[axis] = std::max(box.high[axis], high[axis]);
  }
}

/// The box of position(first) … position(last - 1); of those that are finite.
template <typename Position>
Box bounding_box(std::size_t first, std::size_t last, const Position& position) {
  return tbb::parallel_reduce(
      Range(first, last, 16384), empty_box,
      [&](const Range& range, Box box) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Point& p = position(i);
          if (is_finite(p)) include(box, p, p);
        }
        return box;
      },
      [](Box a, const Box& b) {
        include(a, b.low, b.high);
        return a;
      });
}

/// The 21 lowest bits, two zeros after each.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0x1FFFFFU;
  bits = (bits | bits << 32U) & 0x1F00000000FFFFU;
  bits = (bits | bits << 16U) & 0x1F0000FF0000FFU;
  bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
  bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

/// Places along a Morton curve through a cube around the box: cells are cubes, however flat the cloud is.
class MortonCurve {
 public:
  explicit MortonCurve(const Box& box) : low_(box.low) {
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) extent = std::max(extent, box.high[axis] - box.low[axis]);
    cells_per_unit_ = cells / extent;
    if (!std::isfinite(cells_per_unit_)) cells_per_unit_ = 0;
  }

  [[nodiscard]] std::uint64_t place_of(const Point& p) const {
    std::uint64_t place = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = std::min((p[axis] - low_[axis]) * cells_per_unit_, cells);
      place |= spread(static_cast<std::uint64_t>(cell)) << axis;
    }
    return place;
  }

 private:
  static constexpr double cells = 2097151;  // 2^21 - 1
  Point low_;
  double cells_per_unit_ = 0;
};

struct Entry {
  std::uint64_t place;
  std::uint32_t point;
};

constexpr std::uint64_t nowhere = std::numeric_limits<std::uint64_t>::max();  // after all places

/// By the highest bits of the place in one pass, then bucket by bucket: no sort sees more than the cache
/// holds, unless nearly all points are in one bucket.
template <typename Less>
void sort_by_place(std::vector<Entry>& entries, const Less& less) {
  constexpr unsigned low_bits = 48;
  constexpr std::size_t buckets = (std::size_t{1} << (63U - low_bits)) + 1;  // the last one is nowhere
  const auto bucket_of = [](const Entry& entry) {
    return std::min<std::size_t>(entry.place >> low_bits, buckets - 1);
  };
  std::vector<std::uint32_t> next(buckets + 1, 0);
  for (const Entry& entry : entries) ++next[bucket_of(entry) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<Entry> sorted(entries.size());
  for (const Entry& entry : entries) sorted[next[bucket_of(entry)]++] = entry;
  entries.swap(sorted);
  sorted = {};
  // Now next[b] is the end of bucket b.
  tbb::parallel_for(Range(0, buckets, 16), [&](const Range& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(b == 0 ? 0 : next[b - 1]);
      const auto end = entries.begin() + static_cast<std::ptrdiff_t>(next[b]);
      constexpr std::ptrdiff_t worth_sharing = 1 << 16;
      if (end - begin < worth_sharing) std::sort(begin, end, less);
      else tbb::parallel_sort(begin, end, less);
    }
  });
}

/// All finite points, ordered by (place on the curve, position, index).
std::vector<Entry> sorted_along_curve(const std::vector<Point>& positions, const Point* scaled,
                                      const Progress& progress) {
  std::vector<Entry> entries(positions.size());
  const MortonCurve curve(
      bounding_box(0, positions.size(), [&](std::size_t i) -> const Point& { return scaled[i]; }));
  tbb::parallel_for(Range(0, entries.size(), 16384), [&](const Range& range) {
    progress.check();
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      entries[i] = {is_finite(positions[i]) ? curve.place_of(scaled[i]) : nowhere,
                    static_cast<std::uint32_t>(i)};
  });
  constexpr std::uint32_t points_per_check = 256;
  sort_by_place(entries, [&](const Entry& a, const Entry& b) {
    if (a.point % points_per_check == 0) progress.check();
    if (a.place != b.place) return a.place < b.place;
    if (a.place == nowhere) return a.point < b.point;  // NaN has no order
    const Point& p = positions[a.point];
    const Point& q = positions[b.point];
    // operator== on doubles: -0 and 0 are one location, as their difference is 0.
    return p < q || (p == q && a.point < b.point);
  });
  while (!entries.empty() && entries.back().place == nowhere) entries.pop_back();
  return entries;
}

struct Location {
  std::uint64_t place;
  std::uint32_t first;  // of its points, among the sorted entries
  std::uint32_t count;
};

std::vector<Location> distinct_locations(const std::vector<Entry>& entries,
                                         const std::vector<Point>& positions) {
  std::vector<Location> locations;
  locations.reserve(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const bool coincides = i > 0 && entries[i].place == entries[i - 1].place &&
                           positions[entries[i].point] == positions[entries[i - 1].point];
    if (coincides) ++locations.back().count;
    else locations.push_back({entries[i].place, static_cast<std::uint32_t>(i), 1});
  }
  return locations;
}

/// Divides the locations where their places first differ: into halves of a cube, then halves of those, ….
/// What a cell of the curve cannot tell apart gets a finer curve of its own, so that neither an outlier nor a
/// dense spot makes large leaves.
class TreeBuilder {
 public:
  TreeBuilder(const std::vector<Entry>& entries, const Point* scaled, std::vector<Location>& locations,
              std::vector<BoxTree::Node>& nodes, const Progress& progress)
      : entries_(entries), scaled_(scaled), locations_(locations), nodes_(nodes), progress_(progress) {}

  void build() {
    if (locations_.empty()) return;
    divide(0, locations_.size());
    set_boxes();
  }

 private:
  void divide(std::size_t begin, std::size_t end) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({empty_box, static_cast<std::uint32_t>(begin), 0});
    if (end - begin > BoxTree::leaf_capacity) {
      progress_.check();
      const std::size_t middle = split(begin, end);
      divide(begin, middle);
      divide(middle, end);
    }
    nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
  }

  std::size_t split(std::size_t begin, std::size_t end) {
    if (locations_[begin].place == locations_[end - 1].place) refine(begin, end);
    const std::uint64_t difference = locations_[begin].place ^ locations_[end - 1].place;
    if (difference == 0) return begin + (end - begin) / 2;  // scaled to one place
    const std::uint64_t bit = std::bit_floor(difference);
    const auto first = locations_.begin();
    const auto middle = std::partition_point(
        first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
        [&](const Location& location) { return (location.place & bit) == 0; });
    return static_cast<std::size_t>(middle - first);
  }

  void refine(std::size_t begin, std::size_t end) {
    const auto position = [&](std::size_t i) -> const Point& { return position_at(locations_[i]); };
    const MortonCurve curve(bounding_box(begin, end, position));
    for (std::size_t i = begin; i < end; ++i) locations_[i].place = curve.place_of(position(i));
    const auto first = locations_.begin();
    tbb::parallel_sort(first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end),
                       [](const Location& a, const Location& b) {
                         return a.place < b.place || (a.place == b.place && a.first < b.first);
                       });
  }

  void set_boxes() {
    tbb::parallel_for(Range(0, nodes_.size(), 256), [&](const Range& range) {
      progress_.check();
      for (std::size_t n = range.begin(); n < range.end(); ++n) {
        BoxTree::Node& node = nodes_[n];
        if (node.next != n + 1) continue;
        const std::size_t end = node.next < nodes_.size() ? nodes_[node.next].begin : locations_.size();
        for (std::size_t i = node.begin; i < end; ++i)
          include(node.box, position_at(locations_[i]), position_at(locations_[i]));
      }
    });
    for (std::size_t n = nodes_.size(); n-- > 0;) {  // children come after their parents
      if (nodes_[n].next == n + 1) continue;
      for (const std::size_t child : {n + 1, std::size_t{nodes_[n + 1].next}})
        include(nodes_[n].box, nodes_[child].box.low, nodes_[child].box.high);
    }
  }

  [[nodiscard]] const Point& position_at(const Location& location) const {
    return scaled_[entries_[location.first].point];
  }

  const std::vector<Entry>& entries_;
  const Point* scaled_;
  std::vector<Location>& locations_;
  std::vector<BoxTree::Node>& nodes_;
  const Progress& progress_;
};

}  // namespace

BoxTree::BoxTree(const std::vector<Point>& positions, const Progress& progress)
    : exponent_(safe_exponent(positions)), positions_(positions.data()) {
  progress.check();
  if (exponent_ != 0) {
    scaled_.reserve(positions.size());
    for (const Point& p : positions) scaled_.push_back(is_finite(p) ? scaled(p) : p);
    positions_ = scaled_.data();
  }
  const std::vector<Entry> entries = sorted_along_curve(positions, positions_, progress);
  progress.check();
  std::vector<Location> locations = distinct_locations(entries, positions);
  location_count_ = static_cast<std::uint32_t>(locations.size());
  TreeBuilder(entries, positions_, locations, nodes_, progress).build();
  nodes_.shrink_to_fit();

  points_.reserve(entries.size());
  const bool all_distinct = locations.size() == entries.size();
  if (!all_distinct) first_.reserve(locations.size() + 1);
  for (const Location& location : locations) {
    if (!all_distinct) first_.push_back(static_cast<std::uint32_t>(points_.size()));
    for (std::uint32_t i = 0; i < location.count; ++i) points_.push_back(entries[location.first + i].point);
  }
  if (!all_distinct) first_.push_back(static_cast<std::uint32_t>(points_.size()));
}

std::optional<std::uint32_t> BoxTree::location_of(std::uint32_t point) const {
  const Point& p = positions_[point];
  const auto is_in = [&](const Box& box) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside = inside && box.low[axis] <= p[axis] && p[axis] <= box.high[axis];
    return inside;
  };
  for (std::uint32_t n = 0; n < nodes_.size();) {
    if (!is_in(nodes_[n].box)) {
      n = nodes_[n].next;
      continue;
    }
    for (std::uint32_t location = nodes_[n].begin; is_leaf(n) && location < end_of(n); ++location) {
      const auto there = points_at(location);
      if (std::binary_search(there.begin(), there.end(), point)) return location;
    }
    ++n;
  }
  return std::nullopt;
}

}  // namespace keenline
