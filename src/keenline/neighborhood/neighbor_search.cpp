#include "keenline/neighborhood/neighbor_search.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/box_tree.h"
#include "keenline/neighborhood/surroundings.h"

namespace keenline {
namespace {

constexpr std::uint32_t group_capacity = 40;
constexpr std::size_t groups_per_block = 16;
constexpr std::size_t points_per_block = 4096;  // at most: thousands may coincide

using Range = tbb::blocked_range<std::size_t>;

/// Appends the points at the found locations in the order (distance, index), at most `count`.
void append_points(const BoxTree& tree, std::span<const Surroundings::Found> found, std::size_t count,
                   std::vector<std::uint32_t>& points) {
  if (!tree.has_coincident_points()) {
    for (const Surroundings::Found& f : found.first(std::min(found.size(), count))) points.push_back(f.point);
    return;
  }
  const std::size_t full = points.size() + count;
  for (std::size_t begin = 0; begin < found.size() && points.size() < full;) {
    // Locations at one distance share the order of their points' indices.
    const auto tied = static_cast<std::ptrdiff_t>(points.size());
    std::size_t end = begin;
    for (; end < found.size() && found[end].distance == found[begin].distance; ++end) {
      const auto there = tree.points_at(found[end].location);
      const auto enough = there.first(std::min(there.size(), count));
      points.insert(points.end(), enough.begin(), enough.end());
    }
    std::sort(points.begin() + tied, points.end());
    begin = end;
  }
  if (points.size() > full) points.resize(full);
}

/// What one thread fills blocks with, one after another.
class BlockWriter {
 public:
  BlockWriter(const BoxTree& tree, std::size_t count, const NeighborSearch::Visit& visit, Progress& progress)
      : tree_(tree), count_(count), visit_(visit), progress_(progress), surroundings_(tree, count) {}

  void write(std::span<const std::uint32_t> groups) {
    progress_.check();
    clear();
    for (const std::uint32_t group : groups) {
      const BoxTree::Node& node = tree_.nodes()[group];
      surroundings_.enter(node.box, node.begin);
      for (std::uint32_t location = node.begin; location < tree_.end_of(group); ++location) {
        const Point& position = tree_.position_of(tree_.first_point_at(location));
        neighbors_.clear();
        append_points(tree_, surroundings_.nearest(position, location), count_, neighbors_);
        for (const std::uint32_t point : tree_.points_at(location)) add(point);
      }
    }
    flush();
  }

 private:
  void add(std::uint32_t point) {
    points_.push_back(point);
    block_.indices.insert(block_.indices.end(), neighbors_.begin(), neighbors_.end());
    block_.offsets.push_back(block_.indices.size());
    if (points_.size() == points_per_block) flush();
  }

  void flush() {
    if (points_.empty()) return;
    visit_(points_, block_);
    progress_.advance(points_.size());
    clear();
  }

  void clear() {
    points_.clear();
    block_.offsets.resize(1);
    block_.indices.clear();
  }

  const BoxTree& tree_;
  std::size_t count_;
  const NeighborSearch::Visit& visit_;
  Progress& progress_;
  Surroundings surroundings_;
  std::vector<std::uint32_t> neighbors_;  // of one location
  std::vector<std::uint32_t> points_;
  Neighborhoods block_;
};

/// The largest nodes of at most group_capacity locations, and leaves.
std::vector<std::uint32_t> groups_of(const BoxTree& tree) {
  std::vector<std::uint32_t> groups;
  const auto nodes = tree.nodes();
  for (std::uint32_t n = 0; n < nodes.size();) {
    const bool is_group = tree.is_leaf(n) || tree.end_of(n) - nodes[n].begin <= group_capacity;
    if (is_group) groups.push_back(n);
    n = is_group ? nodes[n].next : n + 1;
  }
  return groups;
}

/// From a position to the box of a node, squared; 0 inside. Rounded like the distances to the points in the
/// box, it is larger than none of them.
double squared_distance(const Point& position, const Box& box) {
  double squares = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max({0.0, box.low[axis] - position[axis], position[axis] - box.high[axis]});
    squares += gap * gap;
  }
  return squares;
}

constexpr std::uint32_t nowhere = 0xFFFF'FFFFU;

/// The nearest points to a position, found by opening the nearest node again and again.
class Nearest {
 public:
  /// \param position as BoxTree::position_of() has it \param without a location that does not count, or
  /// nowhere
  Nearest(const BoxTree& tree, const Point& position, int count, std::uint32_t without)
      : tree_(tree), position_(position), count_(static_cast<std::size_t>(count)), without_(without) {}

  std::vector<std::uint32_t> find() {
    if (!tree_.nodes().empty()) await(0);
    while (!open_.empty() && !is_beyond(open_.front().first)) {
      std::pop_heap(open_.begin(), open_.end(), std::greater<>());
      const std::uint32_t node = open_.back().second;
      open_.pop_back();
      if (tree_.is_leaf(node)) {
        visit(node);
      } else {
        await(node + 1);
        await(tree_.nodes()[node + 1].next);
      }
    }
    std::sort_heap(found_.begin(), found_.end());
    std::vector<std::uint32_t> points;
    points.reserve(found_.size());
    for (const Ranked& found : found_) points.push_back(found.second);
    return points;
  }

 private:
  using Ranked = std::pair<double, std::uint32_t>;  // squared distance; node or point

  [[nodiscard]] bool is_beyond(double distance) const {
    return found_.size() == count_ && distance > found_.front().first;
  }

  void await(std::uint32_t node) {
    open_.emplace_back(squared_distance(position_, tree_.nodes()[node].box), node);
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  }

  void visit(std::uint32_t leaf) {
    for (std::uint32_t location = tree_.nodes()[leaf].begin; location < tree_.end_of(leaf); ++location) {
      if (location == without_) continue;
      const Point& there = tree_.position_of(tree_.first_point_at(location));
      const double distance = squared_distance(position_, {there, there});
      for (const std::uint32_t point : tree_.points_at(location))
        if (!offer({distance, point})) break;  // nor the next, whose index is higher
    }
  }

  bool offer(const Ranked& candidate) {
    if (found_.size() == count_) {
      if (candidate > found_.front()) return false;
      std::pop_heap(found_.begin(), found_.end());
      found_.pop_back();
    }
    found_.push_back(candidate);
    std::push_heap(found_.begin(), found_.end());
    return true;
  }

  const BoxTree& tree_;
  Point position_;
  std::size_t count_;
  std::uint32_t without_;
  std::vector<Ranked> open_;   // nodes, the nearest in front
  std::vector<Ranked> found_;  // points, the farthest in front
};

}  // namespace

NeighborSearch::NeighborSearch(const std::vector<Point>& positions, const Progress& progress)
    : size_(positions.size()) {
  constexpr std::size_t bytes_while_built = 48;
  require_memory(size_ * bytes_while_built, "finding neighbours");
  tree_ = std::make_unique<const BoxTree>(positions, progress);
  groups_ = groups_of(*tree_);
}

NeighborSearch::~NeighborSearch() = default;

std::vector<std::uint32_t> NeighborSearch::nearest(std::uint32_t point, int count) const {
  require_neighbor_count(count);
  if (point >= size_)
    throw InvalidArgument(fmt::format("point: found {}, expected 0 to {}", point, size_ - 1));
  const std::optional<std::uint32_t> location = tree_->location_of(point);
  if (!location) return {};
  return Nearest(*tree_, tree_->position_of(point), count, *location).find();
}

std::vector<std::uint32_t> NeighborSearch::nearest_to(const Point& position, int count) const {
  if (count < 1) throw InvalidArgument(fmt::format("nearest points: found {}, expected at least 1", count));
  if (!is_finite(position)) return {};
  return Nearest(*tree_, tree_->scaled(position), count, nowhere).find();
}

std::vector<std::uint32_t> NeighborSearch::first_coincident() const {
  std::vector<std::uint32_t> first(size_);
  std::iota(first.begin(), first.end(), 0U);
  if (!tree_->has_coincident_points()) return first;
  for (std::uint32_t location = 0; location < tree_->location_count(); ++location)
    for (const std::uint32_t point : tree_->points_at(location))
      first[point] = tree_->first_point_at(location);
  return first;
}

void NeighborSearch::for_each_block(int count, const Visit& visit, Progress& progress) const {
  require_neighbor_count(count);
  const std::size_t blocks = (groups_.size() + groups_per_block - 1) / groups_per_block;
  tbb::enumerable_thread_specific<BlockWriter> writers(
      [&] { return BlockWriter(*tree_, static_cast<std::size_t>(count), visit, progress); });
  tbb::parallel_for(Range(0, blocks), [&](const Range& range) {
    BlockWriter& writer = writers.local();
    for (std::size_t block = range.begin(); block < range.end(); ++block) {
      const std::size_t first = block * groups_per_block;
      const std::size_t length = std::min(groups_per_block, groups_.size() - first);
      writer.write(std::span(groups_).subspan(first, length));
    }
  });
}

Neighborhoods NeighborSearch::all(int count, Progress& progress) const {
  require_neighbor_count(count);
  const auto capacity = static_cast<std::size_t>(count);
  require_memory(size_ * (capacity * sizeof(std::uint32_t) + sizeof(std::uint64_t)), "finding neighbours");
  // Every finite point finds the same number: all others, up to count, that do not coincide with it.
  Neighborhoods result;
  result.offsets.assign(size_ + 1, 0);
  tbb::parallel_for(Range(0, tree_->location_count(), 4096), [&](const Range& range) {
    for (std::size_t location = range.begin(); location < range.end(); ++location) {
      const auto there = tree_->points_at(static_cast<std::uint32_t>(location));
      for (const std::uint32_t point : there)
        result.offsets[point + 1] = std::min(tree_->points().size() - there.size(), capacity);
    }
  });
  std::partial_sum(result.offsets.begin(), result.offsets.end(), result.offsets.begin());
  result.indices.resize(result.offsets.back());
  const auto copy = [&](std::span<const std::uint32_t> points, const Neighborhoods& block) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto neighbors = block.of(i);
      std::copy(neighbors.begin(), neighbors.end(),
                result.indices.begin() + static_cast<std::ptrdiff_t>(result.offsets[points[i]]));
    }
  };
  for_each_block(count, copy, progress);
  return result;
}

}  // namespace keenline
