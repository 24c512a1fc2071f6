#include "keenline/detect/gauss_map.h"

#include <algorithm>
#include <cmath>

#include "keenline/errors.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/kernels/triangle_lines.h"
#include "keenline/kernels/triangle_shapes.h"
#include "keenline/vectors.h"

namespace keenline {

void GaussMap::collect(const std::vector<Point>& positions, const Point& p,
                       std::span<const std::uint32_t> neighbors) {
  double largest = gather_offsets(positions, p, neighbors, 1);
  // The difference of two large coordinates may leave the range of doubles; that of their halves does not.
  if (std::isinf(largest)) largest = gather_offsets(positions, p, neighbors, 0.5);
  // A power of two, in two halves that both are numbers when the whole is not.
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  const double half = std::ldexp(1.0, exponent / 2);
  const double other_half = std::ldexp(1.0, exponent - exponent / 2);
  lengths_.resize(offsets_.size());
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    for (double& coordinate : offsets_[i]) coordinate = coordinate * half * other_half;
    lengths_[i] = length(offsets_[i]);
  }
  find_lines();
}

/// Fills offsets_ with factor * (q - p); returns the largest coordinate in absolute value.
double GaussMap::gather_offsets(const std::vector<Point>& positions, const Point& p,
                                std::span<const std::uint32_t> neighbors, double factor) {
  offsets_.resize(neighbors.size());
  double largest = 0;
  for (std::size_t i = 0; i < neighbors.size(); ++i) {
    const Point& q = positions[neighbors[i]];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double offset = q[axis] * factor - p[axis] * factor;
      offsets_[i][axis] = offset;
      largest = std::max(largest, std::abs(offset));
    }
  }
  return largest;
}

void GaussMap::find_lines() {
  const auto neighbors = static_cast<int>(offsets_.size());
  const std::size_t triangles = offsets_.size() * (offsets_.size() - 1) / 2;
  for (auto* coordinate : {&x_, &y_, &z_}) coordinate->resize(triangles + kernels::line_slack);
  const double* const offsets = neighbors == 0 ? nullptr : offsets_.front().data();
  int count = 0;
  if (triangles_ && static_cast<std::size_t>(*triangles_) < triangles) {
    shapes_.resize(triangles + kernels::shape_slack);
    kernels::triangle_shapes(offsets, neighbors, shapes_.data());
    const std::uint8_t least =
        kernels::shape_of_best(shapes_.data(), triangles, static_cast<std::size_t>(*triangles_));
    count = kernels::triangle_lines(offsets, lengths_.data(), neighbors, min_sine_, shapes_.data(), least,
                                    x_.data(), y_.data(), z_.data());
  } else {
    count = kernels::triangle_lines(offsets, lengths_.data(), neighbors, min_sine_, x_.data(), y_.data(),
                                    z_.data());
  }
  for (auto* coordinate : {&x_, &y_, &z_}) coordinate->resize(static_cast<std::size_t>(count));
}

template <typename Sum>
void GaussMap::cluster(std::vector<Sum>& sums, int rest) {
  const auto n = static_cast<int>(x_.size());
  sums.resize(x_.size() * kernels::row_length(n));
  kernels::line_angles(lines(), sums.data());
  const auto stop = [](const void* progress) { return static_cast<const Progress*>(progress)->cancelled(); };
  const std::optional<int> merges =
      kernels::average_linkage(sums.data(), n, rest, workspace_, merges_.data(), stop, progress_);
  if (!merges) throw Cancelled();
  merges_.resize(static_cast<std::size_t>(*merges));
}

void GaussMap::clear() {
  offsets_.clear(), lengths_.clear();
  x_.clear(), y_.clear(), z_.clear();
  merges_.clear();
}

void GaussMap::cluster(int rest) {
  merges_.resize(x_.size() - 1);
  if (x_.size() <= kernels::largest_count_in_32_bits) cluster(sums32_, rest);
  else cluster(sums64_, rest);
}

Point GaussMap::common_direction() const {
  const auto add = [&](std::size_t i, kernels::Symmetric3& sum) {
    kernels::add_outer_product(sum, static_cast<double>(x_[i]), static_cast<double>(y_[i]),
                               static_cast<double>(z_[i]));
  };
  // Two sums side by side: one would wait for its every addition.
  kernels::Symmetric3 tensor;
  kernels::Symmetric3 other;
  std::size_t i = 0;
  for (; i + 2 <= x_.size(); i += 2) {
    add(i, tensor);
    add(i + 1, other);
  }
  if (i < x_.size()) add(i, tensor);
  return kernels::largest_eigenvector(kernels::sum(tensor, other));
}

std::uint64_t GaussMap::memory(int neighbors) {
  const auto lines = static_cast<std::uint64_t>(neighbors) * static_cast<std::uint64_t>(neighbors - 1) / 2;
  return lines * kernels::row_length(static_cast<int>(lines)) *
         (lines <= kernels::largest_count_in_32_bits ? 4 : 8);
}

}  // namespace keenline
