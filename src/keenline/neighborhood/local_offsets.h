#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/vectors.h"

namespace keenline {

/// From one point to its neighbours, in a unit of length that suits them: so far from the origin and however
/// small or large the shape is, offsets keep all their digits, and their squares neither overflow nor vanish.
class LocalOffsets {
 public:
  /// False when there is nothing to work with: no neighbours, all of them at the point, or so far away that a
  /// double cannot say how far. Everything else below asks for true first.
  bool gather(const std::vector<Point>& positions, std::size_t point,
              std::span<const std::uint32_t> neighbors);

  /// In the order of the neighbours; the largest coordinate is between 1 and 2 in absolute value, less where
  /// it is below 1e-300 in the cloud's own unit.
  [[nodiscard]] std::span<const Point> offsets() const { return offsets_; }
  /// The local unit in the cloud's own: a power of two.
  [[nodiscard]] double unit() const { return unit_; }
  /// Its reciprocal, exact too.
  [[nodiscard]] double per_unit() const { return per_unit_; }

 private:
  std::vector<Point> offsets_;
  double unit_ = 1;
  double per_unit_ = 1;
};

/// Scatter, about their mean, of a point and its neighbours at `offsets`: the sum of squares, not divided.
[[nodiscard]] kernels::Symmetric3 scatter_of(std::span<const Point> offsets);

}  // namespace keenline
