#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/neighborhood/local_offsets.h"

namespace keenline {

/// What ball votes make of a point: a piece of surface.
struct Stick {
  Point normal{};       ///< unit vector, up to its sign
  double saliency = 0;  ///< 0 to 1, what the votes say of a surface; 0 where nobody voted
};

/// In spacings: its voters are the most that a neighbourhood can have.
inline constexpr double largest_voting_scale = 3.7;

/// So many nearest points lie within 2.4 sigma on a surface; what is left out of a vote is one part in 300.
/// `sigma` is in spacings.
[[nodiscard]] int voters_within(double sigma);

/// The nearest points of a point as voters of tensor voting (kernels/tensor_votes.h). Sigma goes with the
/// spacing around the point, so that sparse and dense parts of a cloud are seen alike. Every thread has its
/// own.
class Voters {
 public:
  /// `neighbors` are the nearest of `point`, nearest first; `sigma` in spacings. False where there are too
  /// few, less than 16, to know the spacing from; everything else asks for true first.
  bool gather(const std::vector<Point>& positions, std::size_t point,
              std::span<const std::uint32_t> neighbors, double sigma);

  /// Their ball votes at the point, with a ball of its own: the first pass.
  [[nodiscard]] Stick stick_from_balls() const;

  /// Their stick votes at the point: the second pass. `sticks` are those of the whole cloud.
  [[nodiscard]] kernels::Symmetric3 stick_votes(std::span<const Stick> sticks, double curvature_weight) const;

 private:
  std::span<const std::uint32_t> neighbors_;
  LocalOffsets local_;
  std::vector<Point> offsets_;  // from the voter to the point, in sigma
};

}  // namespace keenline
