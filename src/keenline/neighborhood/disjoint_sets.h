#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace keenline {

/// Sets of the numbers below `count`, each alone at first, that grow together (union-find).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count);

  /// The smallest member of the set that it is in. Cost: O(log count) on average.
  [[nodiscard]] std::uint32_t find(std::uint32_t member);
  /// False when they were in one set already.
  bool join(std::uint32_t a, std::uint32_t b);

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace keenline
