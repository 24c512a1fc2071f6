#include "keenline/neighborhood/surroundings.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// Between two boxes; 0 where they touch.
double squared_distance(const Box& a, const Box& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double gap = std::max(0.0, std::max(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]));
    sum += gap * gap;
  }
  return sum;
}

/// These operations in this order decide which neighbour is nearer.
double squared_distance(const Point& a, const Point& b) {
  const Point d = difference(a, b);
  return dot(d, d);
}

}  // namespace

Surroundings::Surroundings(const BoxTree& tree, std::size_t count)
    : tree_(tree),
      count_(tree.location_count() == 0 ? 0 : std::min<std::size_t>(count, tree.location_count() - 1)) {}

void Surroundings::enter(const Box& box, std::uint32_t here) {
  box_ = box;
  reach_ = -1;
  // A guess that comes from sparser parts could bring in much of the cloud.
  const double bound = distance_along_curve(tree_.position_of(tree_.first_point_at(here)), here);
  radius_ = radius_ < 0 ? bound : std::min(radius_, bound);
}

/// Within which `count_` others lie for sure: those around it on the curve.
double Surroundings::distance_along_curve(const Point& query, std::uint32_t here) {
  const std::size_t first = here - std::min<std::size_t>(here, count_ / 2);
  const std::size_t last = std::min<std::size_t>(tree_.location_count(), here + 2 * count_);
  scratch_.clear();
  for (std::size_t l = first; l < last; ++l) {
    const std::uint32_t point = tree_.first_point_at(static_cast<std::uint32_t>(l));
    scratch_.push_back(squared_distance(query, tree_.position_of(point)));
  }
  if (scratch_.empty()) return 0;
  return std::sqrt(nth_smallest(scratch_, std::min(count_, scratch_.size() - 1)));
}

std::span<const Surroundings::Found> Surroundings::nearest(const Point& query, std::uint32_t location) {
  found_.clear();
  if (count_ == 0) return found_;
  constexpr double slack = 1.1;  // costs a fifth more candidates, and most queries succeed at once
  double growth = 1.25;
  bool measured = false;
  for (double limit = radius_ * slack;; limit *= growth, growth *= 1.25) {
    if (!(limit + 2 * resolution * unit_ <= reach_)) {
      gather(limit * slack);
      measured = false;
    }
    limit = std::max(limit, 4 * resolution * unit_);
    if (!measured) measure(query);
    measured = true;
    std::size_t chosen = choose(limit);
    if (chosen <= count_) continue;  // the query itself is one of them
    if (chosen > 2 * count_ + few) {
      limit = std::min(limit, limit_from_chosen(chosen));
      chosen = choose(limit);
    }
    decide(chosen, query, location);
    if (found_.size() < count_) continue;
    // Whatever is nearer than this, or as near, has been chosen.
    const double certain = limit - resolution * unit_;
    const double farthest = found_[count_ - 1].distance;
    if (farthest > certain * certain) continue;
    radius_ = std::sqrt(farthest);
    return found_;
  }
}

void Surroundings::gather(double reach) {
  const double diagonal = std::sqrt(squared_distance(box_.low, box_.high));
  reach = std::max(reach, diagonal / 4);  // single precision resolves no less anyway
  double largest = reach;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double half = (box_.high[axis] - box_.low[axis]) * 0.5;
    middle_[axis] = box_.low[axis] + half;
    largest = std::max(largest, half + reach);
  }
  constexpr int smallest_exponent = -500;  // its square is a normal number
  unit_ = std::ldexp(1.0, std::max(std::ilogb(largest), smallest_exponent));
  reach_ = std::max(reach, 8 * resolution * unit_);

  size_ = 0;
  const double squared_reach = reach_ * reach_;
  const auto nodes = tree_.nodes();
  for (std::uint32_t n = 0; n < nodes.size();) {
    if (squared_distance(box_, nodes[n].box) > squared_reach) {
      n = nodes[n].next;
      continue;
    }
    if (tree_.is_leaf(n)) gather(nodes[n], tree_.end_of(n), squared_reach);
    ++n;
  }
  const double per_unit = 1 / unit_;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < size_; ++i)
      local_[axis][i] = static_cast<float>((positions_[i][axis] - middle_[axis]) * per_unit);
}

void Surroundings::gather(const BoxTree::Node& leaf, std::uint32_t end, double squared_reach) {
  const std::size_t most = size_ + (end - leaf.begin);
  if (most > positions_.size()) resize(2 * most);
  for (std::uint32_t location = leaf.begin; location < end; ++location) {
    const Point& p = tree_.position_of(tree_.first_point_at(location));
    positions_[size_] = p;
    locations_[size_] = location;
    size_ += squared_distance(box_, {p, p}) <= squared_reach ? 1 : 0;  // or it is overwritten
  }
}

void Surroundings::resize(std::size_t size) {
  positions_.resize(size);
  locations_.resize(size);
  for (std::vector<float>& coordinates : local_) coordinates.resize(size);
  distances_.resize(size);
  chosen_.resize(size);
}

void Surroundings::measure(const Point& query) {
  std::array<float, 3> q{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    q[axis] = static_cast<float>((query[axis] - middle_[axis]) / unit_);
  const float* const x = local_[0].data();
  const float* const y = local_[1].data();
  const float* const z = local_[2].data();
  float* const distances = distances_.data();
  const std::size_t size = size_;
  for (std::size_t i = 0; i < size; ++i) {
    const float dx = x[i] - q[0];
    const float dy = y[i] - q[1];
    const float dz = z[i] - q[2];
    distances[i] = dx * dx + dy * dy + dz * dz;
  }
}

/// Lists the slots within `limit`, and says how many there are.
std::size_t Surroundings::choose(double limit) {
  const auto local = static_cast<float>(limit / unit_);
  const float squared = local * local;
  std::size_t count = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    chosen_[count] = static_cast<std::uint32_t>(i);
    count += distances_[i] <= squared ? 1 : 0;
  }
  return count;
}

/// One that leaves about as many candidates as are asked for.
double Surroundings::limit_from_chosen(std::size_t chosen) {
  scratch_.clear();
  for (std::size_t c = 0; c < chosen; ++c) scratch_.push_back(static_cast<double>(distances_[chosen_[c]]));
  return (std::sqrt(nth_smallest(scratch_, count_)) + 3 * resolution) * unit_;
}

void Surroundings::decide(std::size_t chosen, const Point& query, std::uint32_t location) {
  found_.clear();
  for (const std::uint32_t slot : nearly_ordered(chosen)) {
    const std::uint32_t other = locations_[slot];
    if (other == location) continue;
    found_.push_back({squared_distance(positions_[slot], query), tree_.first_point_at(other), other});
  }
  if (chosen > few) {
    std::sort(found_.begin(), found_.end());
    return;
  }
  for (std::size_t i = 1; i < found_.size(); ++i) {
    const Found moving = found_[i];
    std::size_t to = i;
    for (; to > 0 && moving < found_[to - 1]; --to) found_[to] = found_[to - 1];
    found_[to] = moving;
  }
}

/// A few candidates by their rank, counted in vectors instead of sorted with a branch per comparison. Keys
/// are the bits of the distances, which order like integers; the lowest ones give way to a number that makes
/// each key unique.
std::span<const std::uint32_t> Surroundings::nearly_ordered(std::size_t chosen) {
  if (chosen > few) return std::span(chosen_).first(chosen);
  constexpr auto number_mask = static_cast<std::uint32_t>(std::bit_ceil(few) - 1);
  std::array<std::int32_t, few> keys{};
  std::array<std::int32_t, few> ranks{};
  for (std::size_t c = 0; c < chosen; ++c) {
    const auto bits = std::bit_cast<std::uint32_t>(distances_[chosen_[c]]);
    keys[c] = static_cast<std::int32_t>((bits & ~number_mask) | static_cast<std::uint32_t>(c));
  }
  for (std::size_t other = 0; other < chosen; ++other)
    for (std::size_t c = 0; c < few; ++c) ranks[c] += keys[other] < keys[c] ? 1 : 0;
  for (std::size_t c = 0; c < chosen; ++c) ordered_[static_cast<std::size_t>(ranks[c])] = chosen_[c];
  return std::span(ordered_).first(chosen);
}

}  // namespace keenline
