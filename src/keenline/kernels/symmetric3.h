#pragma once

#include <array>

namespace keenline::kernels {

/// A symmetric 3 x 3 matrix.
struct Symmetric3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

[[nodiscard]] inline Symmetric3 sum(const Symmetric3& a, const Symmetric3& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz};
}

/// The sum of the eigenvalues.
[[nodiscard]] inline double trace(const Symmetric3& matrix) { return matrix.xx + matrix.yy + matrix.zz; }

/// matrix += weight v vᵀ
inline void add_square(Symmetric3& matrix, const std::array<double, 3>& v, double weight) {
  const std::array<double, 3> w{weight * v[0], weight * v[1], weight * v[2]};
  matrix.xx += w[0] * v[0];
  matrix.xy += w[0] * v[1];
  matrix.xz += w[0] * v[2];
  matrix.yy += w[1] * v[1];
  matrix.yz += w[1] * v[2];
  matrix.zz += w[2] * v[2];
}

/// matrix += v vᵀ for v = (x, y, z)
inline void add_outer_product(Symmetric3& matrix, double x, double y, double z) {
  add_square(matrix, {x, y, z}, 1);
}

/// Eigenvalues in falling order, each with a unit eigenvector.
struct Eigen3 {
  std::array<double, 3> values;
  std::array<std::array<double, 3>, 3> vectors;
};

/// By Jacobi rotations in a fixed order, with + - * / and square roots only: the same bits on every CPU.
/// Accurate to a few units in the last place of the largest entry. \pre all entries are finite
[[nodiscard]] Eigen3 eigen_decomposition(const Symmetric3& matrix);

/// The first of those vectors alone: a fraction of the time where its value is well above the others. By
/// squaring the matrix until its columns are multiples of the vector. \pre no value is negative
[[nodiscard]] std::array<double, 3> largest_eigenvector(const Symmetric3& matrix);

}  // namespace keenline::kernels
