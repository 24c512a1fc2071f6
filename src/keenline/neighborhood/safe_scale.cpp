#include "keenline/neighborhood/safe_scale.h"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include "keenline/order_statistics.h"

namespace keenline {
namespace {

constexpr double far = 0x1p500;  // its square, and the sum of three of them, are finite

/// Exponent of the median distance from the first finite point, of a sample; 0 when all coincide.
int median_exponent(const std::vector<Point>& positions) {
  constexpr std::size_t sample_size = 4096;
  const std::size_t step = positions.size() / sample_size + 1;
  std::vector<double> magnitudes;
  const Point* first = nullptr;
  for (std::size_t i = 0; i < positions.size(); i += step) {
    const Point& p = positions[i];
    if (!is_finite(p)) continue;
    if (first == nullptr) first = &p;
    // Halves, because the difference of two large coordinates may not be finite.
    double distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      distance = std::max(distance, std::abs(p[axis] * 0.5 - (*first)[axis] * 0.5));
    if (distance > 0) magnitudes.push_back(distance);
  }
  if (magnitudes.empty()) return 0;
  return std::ilogb(median(magnitudes)) + 1;
}

/// Of the absolute values of all finite points' coordinates that are not 0.
struct Magnitudes {
  double smallest = far;
  double largest = 0;
};

Magnitudes magnitudes_of(const std::vector<Point>& positions) {
  using Range = tbb::blocked_range<std::size_t>;
  return tbb::parallel_reduce(
      Range(0, positions.size(), 16384), Magnitudes{},
      [&](const Range& range, Magnitudes found) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          if (!is_finite(positions[i])) continue;
          for (const double coordinate : positions[i]) {
            const double magnitude = std::abs(coordinate);
            found.largest = std::max(found.largest, magnitude);
            found.smallest = std::min(found.smallest, magnitude == 0 ? far : magnitude);
          }
        }
        return found;
      },
      [](const Magnitudes& a, const Magnitudes& b) {
        return Magnitudes{std::min(a.smallest, b.smallest), std::max(a.largest, b.largest)};
      });
}

}  // namespace

int safe_exponent(const std::vector<Point>& positions) {
  const Magnitudes magnitudes = magnitudes_of(positions);
  // Different doubles of at least 2^-400 differ by 2^-452, which squares to a normal number.
  if (magnitudes.largest == 0 || (magnitudes.largest <= far && magnitudes.smallest >= 0x1p-400)) return 0;
  // All the room that squares have is below the largest coordinate; but one outlier at 1e308 must not push
  // everything else out of it: then the outlier is clamped.
  constexpr int highest = 500;
  constexpr int lowest_median = -350;
  return std::min(std::ilogb(magnitudes.largest) + 1 - highest, median_exponent(positions) - lowest_median);
}

Point safely_scaled(const Point& p, int exponent) {
  Point result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = std::clamp(std::ldexp(p[axis], -exponent), -far, far);
  return result;
}

}  // namespace keenline
