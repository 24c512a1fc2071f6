#include "keenline/neighborhood/local_offsets.h"

#include <algorithm>
#include <cmath>

namespace keenline {

bool LocalOffsets::gather(const std::vector<Point>& positions, std::size_t point,
                          std::span<const std::uint32_t> neighbors) {
  const Point& p = positions[point];
  offsets_.clear();
  double largest = 0;
  for (const std::uint32_t neighbor : neighbors) {
    const Point offset = difference(positions[neighbor], p);
    largest = std::max({largest, std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])});
    offsets_.push_back(offset);
  }
  if (!(largest > 0) || std::isinf(largest)) return false;
  // Reciprocals of powers of two within these limits are normal numbers, and so is every product below.
  const int exponent = std::clamp(std::ilogb(largest), -1000, 1000);
  unit_ = std::ldexp(1.0, exponent);
  per_unit_ = std::ldexp(1.0, -exponent);
  for (Point& offset : offsets_)
    for (double& coordinate : offset) coordinate *= per_unit_;
  return true;
}

kernels::Symmetric3 scatter_of(std::span<const Point> offsets) {
  const double count = static_cast<double>(offsets.size()) + 1;  // the point itself is at 0
  Point mean{};
  for (const Point& offset : offsets)
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += offset[axis] / count;
  kernels::Symmetric3 scatter;
  add_square(scatter, mean, 1);
  for (const Point& o : offsets) add_square(scatter, difference(o, mean), 1);
  return scatter;
}

}  // namespace keenline
