#include "keenline/detect/gauss_map.h"

#include <algorithm>
#include <cmath>

#include "keenline/errors.h"
#include "keenline/kernels/symmetric3.h"

namespace keenline {

void GaussMap::collect(const std::vector<Point>& positions, const Point& p,
                       std::span<const std::uint32_t> neighbors) {
  double largest = gather_offsets(positions, p, neighbors, 1);
  // The difference of two large coordinates may leave the range of doubles; that of their halves does not.
  if (std::isinf(largest)) largest = gather_offsets(positions, p, neighbors, 0.5);
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  lengths_.clear();
  for (Point& offset : offsets_) {
    for (double& coordinate : offset) coordinate = std::ldexp(coordinate, exponent);
    lengths_.push_back(std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]));
  }
  x_.clear(), y_.clear(), z_.clear();
  for (std::size_t i = 0; i < offsets_.size(); ++i)
    for (std::size_t j = i + 1; j < offsets_.size(); ++j) add_line(i, j);
}

/// Fills offsets_ with factor * (q - p); returns the largest coordinate in absolute value.
double GaussMap::gather_offsets(const std::vector<Point>& positions, const Point& p,
                                std::span<const std::uint32_t> neighbors, double factor) {
  offsets_.clear();
  double largest = 0;
  for (const std::uint32_t q : neighbors) {
    Point& offset = offsets_.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      offset[axis] = positions[q][axis] * factor - p[axis] * factor;
      largest = std::max(largest, std::abs(offset[axis]));
    }
  }
  return largest;
}

void GaussMap::add_line(std::size_t i, std::size_t j) {
  const Point& a = offsets_[i];
  const Point& b = offsets_[j];
  const Point normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  if (!(length > 0) || length < min_sine_ * (lengths_[i] * lengths_[j])) return;
  x_.push_back(static_cast<float>(normal[0] / length));
  y_.push_back(static_cast<float>(normal[1] / length));
  z_.push_back(static_cast<float>(normal[2] / length));
}

template <typename Sum>
void GaussMap::cluster(std::vector<Sum>& sums) {
  const auto n = x_.size();
  sums.resize(n * n);
  kernels::line_angles(lines(), sums.data());
  const auto stop = [](const void* progress) { return static_cast<const Progress*>(progress)->cancelled(); };
  if (!kernels::average_linkage(sums.data(), static_cast<int>(n), workspace_, merges_.data(), stop,
                                progress_))
    throw Cancelled();
}

void GaussMap::clear() {
  offsets_.clear(), lengths_.clear();
  x_.clear(), y_.clear(), z_.clear();
  merges_.clear();
}

void GaussMap::cluster() {
  merges_.resize(x_.size() - 1);
  if (x_.size() <= kernels::largest_count_in_32_bits) cluster(sums32_);
  else cluster(sums64_);
}

Point GaussMap::common_direction() const {
  kernels::Symmetric3 tensor;
  for (std::size_t i = 0; i < x_.size(); ++i)
    kernels::add_outer_product(tensor, static_cast<double>(x_[i]), static_cast<double>(y_[i]),
                               static_cast<double>(z_[i]));
  return kernels::eigen_decomposition(tensor).vectors[0];
}

std::uint64_t GaussMap::memory(int neighbors) {
  const auto lines = static_cast<std::uint64_t>(neighbors) * static_cast<std::uint64_t>(neighbors - 1) / 2;
  return lines * lines * (lines <= kernels::largest_count_in_32_bits ? 4 : 8);
}

}  // namespace keenline
