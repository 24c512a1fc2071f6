#include "keenline/neighborhood/neighborhoods.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include <fmt/format.h>
// When memory runs out nanoflann prints before it throws std::bad_alloc; this library never prints.
#define fprintf(...) static_cast<void>(0)
#include <nanoflann.hpp>
#undef fprintf
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

#include "keenline/errors.h"
#include "keenline/memory.h"

namespace keenline {
namespace {

constexpr double far = 0x1p500;  // its square, and the sum of three of them, are finite

/// Exponent of the median distance from the first finite point, of a sample; 0 when all coincide.
int median_exponent(const std::vector<Point>& positions) {
  constexpr std::size_t sample_size = 4096;
  const std::size_t step = positions.size() / sample_size + 1;
  std::vector<double> magnitudes;
  const Point* first = nullptr;
  for (std::size_t i = 0; i < positions.size(); i += step) {
    const Point& p = positions[i];
    if (!is_finite(p)) continue;
    if (first == nullptr) first = &p;
    // Halves, because the difference of two large coordinates may not be finite.
    double distance = 0;
    for (int axis = 0; axis < 3; ++axis)
      distance = std::max(distance, std::abs(p[axis] * 0.5 - (*first)[axis] * 0.5));
    if (distance > 0) magnitudes.push_back(distance);
  }
  if (magnitudes.empty()) return 0;
  const auto middle = magnitudes.begin() + static_cast<std::ptrdiff_t>(magnitudes.size() / 2);
  std::nth_element(magnitudes.begin(), middle, magnitudes.end());
  return std::ilogb(*middle) + 1;
}

/// Exponent e such that distances of coordinates times 2^-e square safely: 0 for all but extreme clouds.
int scale_exponent(const std::vector<Point>& positions) {
  double largest = 0;
  double smallest = far;
  for (const Point& p : positions) {
    if (!is_finite(p)) continue;
    for (const double coordinate : p) {
      largest = std::max(largest, std::abs(coordinate));
      if (coordinate != 0) smallest = std::min(smallest, std::abs(coordinate));
    }
  }
  // Different doubles of at least 2^-400 differ by 2^-452, which squares to a normal number.
  if (largest == 0 || (largest <= far && smallest >= 0x1p-400)) return 0;
  // All the room that squares have is below the largest coordinate; but one outlier at 1e308 must not push
  // everything else out of it: then the outlier is clamped.
  constexpr int highest = 500;
  constexpr int lowest_median = -350;
  return std::min(std::ilogb(largest) + 1 - highest, median_exponent(positions) - lowest_median);
}

/// One stored position per distinct location, and the points that lie there.
struct Locations {
  std::vector<Point> positions;        // scaled
  std::vector<std::uint32_t> first;    // location -> its first entry in members; one more at the end
  std::vector<std::uint32_t> members;  // point indices, rising within a location

  // What nanoflann's distances call.
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const { return positions[i][axis]; }
};

Point scaled(const Point& p, int exponent) {
  Point result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = std::clamp(exponent == 0 ? p[axis] : std::ldexp(p[axis], -exponent), -far, far);
  return result;
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

/// Places along a Morton curve through the bounding box: what is near on the curve is near in space.
class MortonCurve {
 public:
  explicit MortonCurve(const std::vector<Point>& points) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point high{-infinity, -infinity, -infinity};
    low_ = {infinity, infinity, infinity};
    for (const Point& p : points)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low_[axis] = std::min(low_[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double extent = high[axis] - low_[axis];
      cells_per_unit_[axis] = extent > 0 ? cells / extent : 0;
      if (!std::isfinite(cells_per_unit_[axis])) cells_per_unit_[axis] = 0;
    }
  }

  [[nodiscard]] std::uint64_t place_of(const Point& p) const {
    std::uint64_t place = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = std::min((p[axis] - low_[axis]) * cells_per_unit_[axis], cells);
      place |= spread(static_cast<std::uint64_t>(cell)) << axis;
    }
    return place;
  }

 private:
  static constexpr double cells = 2097151;  // 2^21 - 1
  Point low_{};
  Point cells_per_unit_{};
};

/// Locations in the order of a Morton curve, so that queries one after another touch the same memory.
Locations distinct_locations(const PointCloud& cloud, const Progress& progress) {
  Locations locations;
  std::vector<Point>& positions = locations.positions;
  const int exponent = scale_exponent(cloud.positions);
  std::vector<std::uint32_t> finite;
  finite.reserve(cloud.size());
  positions.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (is_finite(cloud.positions[i])) {
      finite.push_back(static_cast<std::uint32_t>(i));
      positions.push_back(scaled(cloud.positions[i], exponent));
    }
  progress.check();

  constexpr std::uint32_t points_per_check = 256;
  struct Key {
    std::uint64_t place;
    std::uint32_t point;
  };
  const MortonCurve curve(positions);
  std::vector<Key> keys(finite.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 16384),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        keys[i] = {curve.place_of(positions[i]), finite[i]};
                    });
  positions.clear();
  tbb::parallel_sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    if (a.point % points_per_check == 0) progress.check();
    if (a.place != b.place) return a.place < b.place;
    const Point& p = cloud.positions[a.point];
    const Point& q = cloud.positions[b.point];
    // operator== on doubles: -0 and 0 are one location, as their difference is 0.
    return p < q || (p == q && a.point < b.point);
  });
  progress.check();

  locations.members.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    locations.members.push_back(keys[i].point);
    const Point& p = cloud.positions[keys[i].point];
    if (i > 0 && p == cloud.positions[keys[i - 1].point]) continue;
    locations.first.push_back(static_cast<std::uint32_t>(i));
    positions.push_back(scaled(p, exponent));
  }
  locations.first.push_back(static_cast<std::uint32_t>(keys.size()));
  return locations;
}

/// The best locations seen so far, for nanoflann, as a total order on (distance, first point of the
/// location).
class NearestLocations {
 public:
  struct Entry {
    double distance;         // squared
    std::uint32_t smallest;  // smallest point index there: decides ties
    std::uint32_t location;
    bool operator<(const Entry& other) const {
      return distance < other.distance || (distance == other.distance && smallest < other.smallest);
    }
  };

  NearestLocations(const Locations& locations, std::size_t capacity)
      : locations_(locations), capacity_(capacity) {
    entries_.reserve(capacity + 1);
  }
  void start(std::uint32_t query) {
    query_ = query;
    entries_.clear();
  }
  [[nodiscard]] std::span<const Entry> entries() const { return entries_; }

  // What nanoflann calls.
  [[nodiscard]] bool full() const { return entries_.size() == capacity_; }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  void sort() {}  // they always are
  /// A little more than the worst kept distance: nanoflann compares with "less" and sums box distances with
  /// rounding, and a tie at the border must still be seen.
  [[nodiscard]] double worstDist() const {
    return full() ? entries_.back().distance * (1 + 1e-12) + std::numeric_limits<double>::min()
                  : std::numeric_limits<double>::max();
  }
  bool addPoint(double distance, std::uint32_t location) {
    if (location == query_) return true;
    const Entry entry{distance, locations_.members[locations_.first[location]], location};
    if (full()) {
      if (!(entry < entries_.back())) return true;
      entries_.pop_back();
    }
    entries_.insert(std::upper_bound(entries_.begin(), entries_.end(), entry), entry);
    return true;
  }

 private:
  const Locations& locations_;
  std::size_t capacity_;
  std::uint32_t query_ = 0;
  std::vector<Entry> entries_;
};

/// What nanoflann builds its tree from, on one thread; that takes seconds for a large cloud and can be
/// cancelled here only.
class TreeSource {
 public:
  TreeSource(const Locations& locations, const Progress& progress)
      : locations_(locations), progress_(progress) {}
  /// Distances take the positions from there, without the detour.
  operator const Locations&() const { return locations_; }  // NOLINT(google-explicit-constructor)

  // What nanoflann calls.
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return locations_.positions.size(); }
  [[nodiscard]] double kdtree_get_pt(std::size_t i, std::size_t axis) const {
    constexpr unsigned calls_per_check = 4096;
    if (++calls_ % calls_per_check == 0) progress_.check();
    return locations_.kdtree_get_pt(i, axis);
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;  // nanoflann computes it
  }

 private:
  const Locations& locations_;
  const Progress& progress_;
  mutable unsigned calls_ = 0;
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<
    nanoflann::L2_Simple_Adaptor<double, Locations, double, std::uint32_t>, TreeSource, 3, std::uint32_t>;

/// The points at the found locations in the order (distance, index), at most `count`.
void expand(const Locations& locations, std::span<const NearestLocations::Entry> entries, std::size_t count,
            std::vector<std::uint32_t>& neighbors) {
  neighbors.clear();
  for (std::size_t begin = 0; begin < entries.size() && neighbors.size() < count;) {
    // Locations at one distance share the order of their points' indices.
    std::size_t end = begin + 1;
    while (end < entries.size() && entries[end].distance == entries[begin].distance) ++end;
    const std::size_t old_size = neighbors.size();
    for (std::size_t e = begin; e < end; ++e) {
      const std::uint32_t location = entries[e].location;
      const std::uint32_t* const members = locations.members.data();
      const std::uint32_t last = std::min<std::uint32_t>(
          locations.first[location + 1], locations.first[location] + static_cast<std::uint32_t>(count));
      neighbors.insert(neighbors.end(), members + locations.first[location], members + last);
    }
    std::sort(neighbors.begin() + static_cast<std::ptrdiff_t>(old_size), neighbors.end());
    begin = end;
  }
  if (neighbors.size() > count) neighbors.resize(count);
}

}  // namespace

Neighborhoods find_neighborhoods(const PointCloud& cloud, int count, Progress& progress) {
  if (count < min_neighbors || count > max_neighbors)
    throw InvalidArgument(
        fmt::format("neighbors: found {}, expected {} to {}", count, min_neighbors, max_neighbors));
  const auto capacity = static_cast<std::size_t>(count);
  // Neighbours and offset; position, key of the curve and three indices while they are found.
  constexpr std::size_t fixed_bytes = 8 + sizeof(Point) + 16 + 3 * sizeof(std::uint32_t);
  require_memory(cloud.size() * (capacity * sizeof(std::uint32_t) + fixed_bytes), "finding neighbours");
  progress.begin("neighborhoods", cloud.size());

  const Locations locations = distinct_locations(cloud, progress);
  progress.check();

  // Every finite point finds the same number: all others, up to count, that do not coincide with it.
  Neighborhoods result;
  result.offsets.assign(cloud.size() + 1, 0);
  const std::size_t distinct = locations.positions.size();
  for (std::size_t location = 0; location < distinct; ++location) {
    const std::size_t others =
        locations.members.size() - (locations.first[location + 1] - locations.first[location]);
    for (std::uint32_t m = locations.first[location]; m < locations.first[location + 1]; ++m)
      result.offsets[locations.members[m] + 1] = std::min(others, capacity);
  }
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.indices.resize(result.offsets.back());
  if (distinct < 2) return result;

  const TreeSource tree_source(locations, progress);
  const Tree tree(3, tree_source, nanoflann::KDTreeSingleIndexAdaptorParams(10));  // builds it
  progress.check();

  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, distinct, 512), [&](const tbb::blocked_range<std::size_t>& range) {
        progress.check();
        NearestLocations nearest(locations, capacity);
        std::vector<std::uint32_t> neighbors;
        std::uint64_t points = 0;
        for (std::size_t location = range.begin(); location < range.end(); ++location) {
          nearest.start(static_cast<std::uint32_t>(location));
          tree.findNeighbors(nearest, locations.positions[location].data(), {});
          expand(locations, nearest.entries(), capacity, neighbors);
          for (std::uint32_t m = locations.first[location]; m < locations.first[location + 1]; ++m, ++points)
            std::copy(
                neighbors.begin(), neighbors.end(),
                result.indices.begin() + static_cast<std::ptrdiff_t>(result.offsets[locations.members[m]]));
        }
        progress.advance(points);
      });
  return result;
}

}  // namespace keenline
