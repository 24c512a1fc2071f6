#pragma once

#include <cstdint>

namespace keenline::kernels {

/// Floats beyond the last line that triangle_lines() may write.
inline constexpr int line_slack = 8;

/// The lines through the origin along the normals of the triangles (0, a_i, a_j), i < j, in the order of (i,
/// j); those are left out whose sine at the origin is below `min_sine`, or which have no normal. \param
/// offsets  count points, three coordinates each \param lengths  their distances from the origin, in double
/// precision \param x,y,z    out: unit vectors; room for count (count - 1) / 2 + line_slack \return how many.
/// \pre 0 <= count <= 255; finite coordinates, squares of their products too
[[nodiscard]] int triangle_lines(const double* offsets, const double* lengths, int count, double min_sine,
                                 float* x, float* y, float* z);

/// The same of the triangles whose shape is `least_shape` or more. \param shapes  of triangle_shapes()
[[nodiscard]] int triangle_lines(const double* offsets, const double* lengths, int count, double min_sine,
                                 const std::uint8_t* shapes, std::uint8_t least_shape, float* x, float* y,
                                 float* z);

}  // namespace keenline::kernels
