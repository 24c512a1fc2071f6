#pragma once

#include <cstddef>
#include <cstdint>

namespace keenline::kernels {

/// Bytes beyond the last shape that triangle_shapes() may write.
inline constexpr std::size_t shape_slack = 8;

/// Squares of sums of squared sides that are smaller are too small to divide by.
inline constexpr float least_square = 1e-30F;

/// How well shaped the triangles (0, a_i, a_j) are, i < j, in the order of (i, j): 256 q², rounded down and
/// 255 at most, where q = 4 sqrt(3) area / (sum of the squares of the sides) is 1 for an equilateral triangle
/// and 0 for one without area (Bank & Smith, "Mesh smoothing using a posteriori error estimates", 1997).
/// Triangles of less than 1e-7 of the unit have shape 0. In single precision, the same bits on every target.
/// \param offsets  count points, three coordinates each, 2 at most
/// \param shapes   out: room for count (count - 1) / 2 + shape_slack
/// \pre 0 <= count <= 255; finite coordinates
void triangle_shapes(const double* offsets, int count, std::uint8_t* shapes);

/// The shape of the best-th best: so many shapes, or more if there are equal ones, are at least this. 0 when
/// there are not so many. \pre best >= 1
[[nodiscard]] std::uint8_t shape_of_best(const std::uint8_t* shapes, std::size_t count, std::size_t best);

}  // namespace keenline::kernels
