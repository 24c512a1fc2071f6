#pragma once

#include <cstdint>

namespace keenline::kernels {

/// Angles between lines are whole numbers of 1/728 degree. So many, because 90 degrees = 65520 = 2^4 3^2 5 7
/// 13 units fit 16 bits and 90, 60, 45, 30, 20, 15 … degrees are whole; whole at all, because sums of whole
/// numbers are exact: what follows from them depends neither on the order of summation nor on the CPU.
inline constexpr double angle_units_per_degree = 728.0;
inline constexpr std::uint32_t right_angle = 65520;

/// Unit vectors, one array per coordinate. A line and its reverse are the same.
struct Lines {
  const float* x;
  const float* y;
  const float* z;
  int count;
};

/// The angle between two lines, in units: 0 to right_angle, within one unit of the exact angle from 0.03
/// degrees on.
[[nodiscard]] std::uint32_t line_angle(float cosine);

/// All pairs: angles[i * count + j], symmetric, 0 on the diagonal. Sum is std::uint32_t or std::uint64_t.
template <typename Sum>
void line_angles(const Lines& lines, Sum* angles);

/// Mean angle of all lines to the line along (x, y, z), a unit vector, in units. \pre lines.count > 0
[[nodiscard]] double mean_angle_to(const Lines& lines, float x, float y, float z);

/// True only if all lines lie so close to the first that no two of them are further apart than `units`.
[[nodiscard]] bool all_within(const Lines& lines, double units);

}  // namespace keenline::kernels
