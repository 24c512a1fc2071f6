#include "keenline/detect/voters.h"

#include <algorithm>
#include <cmath>

#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/tensor_votes.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr std::size_t fewest_voters = 16;

/// Voters so much nearer than the others that their distance has no square have no direction to vote from.
constexpr double smallest_square = 1e-290;

}  // namespace

int voters_within(double sigma) {
  constexpr double radius_in_sigma = 2.4;
  const double radius = radius_in_sigma * sigma;
  return static_cast<int>(std::min<double>(std::ceil(kernels::pi * radius * radius), max_neighbors));
}

bool Voters::gather(const std::vector<Point>& positions, std::size_t point,
                    std::span<const std::uint32_t> neighbors, double sigma) {
  neighbors_ = neighbors;
  offsets_.clear();
  if (neighbors.size() < fewest_voters || !local_.gather(positions, point, neighbors)) return false;
  const auto offsets = local_.offsets();
  const double spacing = spacing_within(offsets.back(), offsets.size());
  if (!(spacing * spacing > smallest_square)) return false;
  const double per_sigma = -1 / (sigma * spacing);
  for (const Point& offset : offsets) offsets_.push_back(scaled(per_sigma, offset));
  return true;
}

Stick Voters::stick_from_balls() const {
  kernels::Symmetric3 tensor{1, 0, 0, 1, 0, 1};
  for (const Point& offset : offsets_)
    if (dot(offset, offset) > smallest_square) kernels::add_ball_vote(tensor, offset);
  const kernels::Eigen3 axes = kernels::eigen_decomposition(tensor);
  return {axes.vectors[0], kernels::saliency_of(axes).surface};
}

kernels::Symmetric3 Voters::stick_votes(std::span<const Stick> sticks, double curvature_weight) const {
  kernels::Symmetric3 tensor;
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const Stick& stick = sticks[neighbors_[i]];
    if (stick.saliency > 0 && dot(offsets_[i], offsets_[i]) > smallest_square)
      kernels::add_stick_vote(tensor, stick.normal, offsets_[i], curvature_weight, stick.saliency);
  }
  return tensor;
}

}  // namespace keenline
