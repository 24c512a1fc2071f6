#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "keenline/lines/foot.h"

namespace keenline {

/// Which feet of paths are near a position, in cells of a hash table. Lengths are in the trace's frame.
class FootGrid {
 public:
  struct Entry {
    std::size_t path;
    std::ptrdiff_t place;  ///< along the path, from its seed
    Foot foot;
  };

  void insert(const Entry& entry);

  /// Calls `visit` with every entry within `reach` of the position, and with some farther ones, in an
  /// order that depends on the entries only. Cost: O(reach^3 + entries there), O(entries) at most.
  template <typename Visit>
  void near(const Point& position, double reach, const Visit& visit) const {
    const Cell low = cell_of({position[0] - reach, position[1] - reach, position[2] - reach});
    const Cell high = cell_of({position[0] + reach, position[1] + reach, position[2] + reach});
    double cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) cells *= static_cast<double>(high[axis] - low[axis]) + 1;
    if (cells > static_cast<double>(entries_.size())) {
      for (const Entry& entry : entries_) visit(entry);
      return;
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x) {
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          const auto cell = cells_.find({x, y, z});
          if (cell == cells_.end()) continue;
          for (const std::size_t i : cell->second) visit(entries_[i]);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& cell) const;
  };
  static Cell cell_of(const Point& position);

  std::vector<Entry> entries_;
  std::unordered_map<Cell, std::vector<std::size_t>, Hash> cells_;
};

}  // namespace keenline
