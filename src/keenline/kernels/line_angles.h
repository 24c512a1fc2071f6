#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace keenline::kernels {

/// Angles between lines are whole numbers of 1/728 degree. So many, because 90 degrees = 65520 = 2^4 3^2 5 7
/// 13 units fit 16 bits and 90, 60, 45, 30, 20, 15 … degrees are whole; whole at all, because sums of whole
/// numbers are exact: what follows from them depends neither on the order of summation nor on the CPU.
inline constexpr double angle_units_per_degree = 728.0;
inline constexpr std::uint32_t right_angle = 65520;

/// The arc cosine of 0 <= c <= 1 is sqrt(1 - c) P(c), in units, highest power first: the form of Abramowitz &
/// Stegun 4.4.46 with as many terms as units ask for. |error| <= 0.03 units, and exact at 0. Not the C
/// library's acos, whose last bit depends on the CPU it runs on. Every target evaluates it by the same
/// multiplications and additions, none of them fused.
inline constexpr std::array<float, 6> arc_cosine_polynomial{-210.72471F, 874.4677F,   -1928.2734F,
                                                            3682.4426F,  -8949.5596F, 65520.0F};

/// Floats so large are whole numbers: added to an angle it leaves that angle, rounded, in the last bits.
inline constexpr float whole_number_offset = 0x1p23F;

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

/// Matrices of angles have rows of whole vectors: `count` rounded up to an odd multiple of 16. Odd, because
/// the entries of a column would otherwise crowd in a few sets of the cache.
[[nodiscard]] constexpr std::size_t row_length(int count) {
  return ((static_cast<std::size_t>(count) + 15) / 16 | 1U) * 16;
}

/// All pairs: angles[i * row_length(count) + j], symmetric, 0 on the diagonal; what follows j = count - 1 in
/// a row is undefined. Sum is std::uint32_t or std::uint64_t. \pre count rows
template <typename Sum>
void line_angles(const Lines& lines, Sum* angles);

/// The smallest |cosine| between a line and the line along (x, y, z), a unit vector: that of the largest
/// angle. 1 without lines.
[[nodiscard]] float smallest_cosine_to(const Lines& lines, float x, float y, float z);

/// True only if all lines lie so close to the first that no two of them are further apart than `units`.
[[nodiscard]] bool all_within(const Lines& lines, double units);

}  // namespace keenline::kernels
