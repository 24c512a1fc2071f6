#include "keenline/kernels/line_angles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace keenline::kernels {
namespace {

float cosine(const Lines& lines, int i, int j) {
  return lines.x[i] * lines.x[j] + lines.y[i] * lines.y[j] + lines.z[i] * lines.z[j];
}

}  // namespace

std::uint32_t line_angle(float cosine) {
  // acos(c) = sqrt(1 - c) P(c), |error| <= 2e-8 rad: Abramowitz & Stegun 4.4.46. Not the C library's acos,
  // whose last bit depends on the CPU it runs on.
  const float c = std::min(std::abs(cosine), 1.0F);
  float p = -0.0012624911F;
  p = p * c + 0.0066700901F;
  p = p * c - 0.0170881256F;
  p = p * c + 0.0308918810F;
  p = p * c - 0.0501743046F;
  p = p * c + 0.0889789874F;
  p = p * c - 0.2145988016F;
  p = p * c + 1.5707963050F;
  constexpr float units_per_radian = 41711.327F;  // 65520 / (pi / 2)
  const float units = std::sqrt(1.0F - c) * p * units_per_radian + 0.5F;
  return std::min(static_cast<std::uint32_t>(units), right_angle);
}

template <typename Sum>
void line_angles(const Lines& lines, Sum* angles) {
  const auto n = static_cast<std::size_t>(lines.count);
  for (std::size_t i = 0; i < n; ++i) {
    angles[i * n + i] = 0;
    for (std::size_t j = i + 1; j < n; ++j) {
      const Sum angle = line_angle(cosine(lines, static_cast<int>(i), static_cast<int>(j)));
      angles[i * n + j] = angle;
      angles[j * n + i] = angle;
    }
  }
}

template void line_angles<std::uint32_t>(const Lines&, std::uint32_t*);
template void line_angles<std::uint64_t>(const Lines&, std::uint64_t*);

double mean_angle_to(const Lines& lines, float x, float y, float z) {
  std::uint64_t sum = 0;
  for (int i = 0; i < lines.count; ++i) sum += line_angle(lines.x[i] * x + lines.y[i] * y + lines.z[i] * z);
  return static_cast<double>(sum) / lines.count;
}

bool all_within(const Lines& lines, double units) {
  // Angles between lines obey the triangle inequality: half the distance to one of them is enough for all.
  // The smallest cosine has the largest angle; one unit less for what two roundings can add up to.
  float smallest = 1.0F;
  for (int i = 1; i < lines.count; ++i) smallest = std::min(smallest, std::abs(cosine(lines, 0, i)));
  return 2.0 * (line_angle(smallest) + 1.0) <= units;
}

}  // namespace keenline::kernels
