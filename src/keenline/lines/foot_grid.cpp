#include "keenline/lines/foot_grid.h"

#include <algorithm>
#include <cmath>

namespace keenline {

void FootGrid::insert(const Entry& entry) {
  cells_[cell_of(entry.foot.position)].push_back(entries_.size());
  entries_.push_back(entry);
}

std::size_t FootGrid::Hash::operator()(const Cell& cell) const {
  std::uint64_t hash = 0;
  for (const std::int64_t c : cell)
    hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15U ^ hash >> 29U;
  return hash;
}

FootGrid::Cell FootGrid::cell_of(const Point& position) {
  constexpr double side = 4;
  constexpr double farthest = 1e15;  // where cells still differ by 1
  Cell cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double place = position[axis] / side;
    if (!std::isnan(place))
      cell[axis] = static_cast<std::int64_t>(std::floor(std::clamp(place, -farthest, farthest)));
  }
  return cell;
}

}  // namespace keenline
