#include "keenline/kernels/symmetric3.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace keenline::kernels {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Turns the plane of axes p and q so that a[p][q] becomes 0 (Golub & Van Loan, Matrix Computations, 8.5.2),
/// and the columns of v with it; unless it is as good as 0.
void rotate(Matrix& a, Matrix& v, std::size_t p, std::size_t q, double negligible) {
  if (std::abs(a[p][q]) <= negligible) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double sign = theta >= 0 ? 1.0 : -1.0;
  double t = sign / (2 * std::abs(theta));
  double c = 1;
  if (std::abs(theta) < 0x1p27) {  // else rounding makes that of it, too
    t = sign / (std::abs(theta) + std::sqrt(1 + theta * theta));
    c = 1 / std::sqrt(1 + t * t);
  }
  const double s = t * c;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = a[k][p];
    const double kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = a[p][k];
    const double qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
    const double vp = v[k][p];
    const double vq = v[k][q];
    v[k][p] = c * vp - s * vq;
    v[k][q] = s * vp + c * vq;
  }
  a[p][q] = a[q][p] = 0;
}

Symmetric3 scaled(double factor, const Symmetric3& m) {
  return {factor * m.xx, factor * m.xy, factor * m.xz, factor * m.yy, factor * m.yz, factor * m.zz};
}

Symmetric3 square(const Symmetric3& m) {
  return {m.xx * m.xx + m.xy * m.xy + m.xz * m.xz, m.xx * m.xy + m.xy * m.yy + m.xz * m.yz,
          m.xx * m.xz + m.xy * m.yz + m.xz * m.zz, m.xy * m.xy + m.yy * m.yy + m.yz * m.yz,
          m.xy * m.xz + m.yy * m.yz + m.yz * m.zz, m.xz * m.xz + m.yz * m.yz + m.zz * m.zz};
}

/// Its longest column, as a unit vector.
std::array<double, 3> longest_column(const Symmetric3& m) {
  std::array<double, 3> column{m.xx, m.xy, m.xz};
  if (m.yy > m.xx && m.yy >= m.zz) column = {m.xy, m.yy, m.yz};
  else if (m.zz > m.xx) column = {m.xz, m.yz, m.zz};
  const double length = std::sqrt(column[0] * column[0] + column[1] * column[1] + column[2] * column[2]);
  for (double& c : column) c /= length;
  return column;
}

}  // namespace

Eigen3 eigen_decomposition(const Symmetric3& matrix) {
  Matrix a{{{matrix.xx, matrix.xy, matrix.xz},
            {matrix.xy, matrix.yy, matrix.yz},
            {matrix.xz, matrix.yz, matrix.zz}}};
  Matrix v{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  // Far below the last place of the largest entry. Nothing less than that would be reached: what is 0 does
  // not stay it when the next plane is turned.
  const double negligible =
      0x1p-60 * std::max({std::abs(matrix.xx), std::abs(matrix.yy), std::abs(matrix.zz), std::abs(matrix.xy),
                          std::abs(matrix.xz), std::abs(matrix.yz)});
  const auto is_diagonal = [&] {
    return std::max({std::abs(a[0][1]), std::abs(a[0][2]), std::abs(a[1][2])}) <= negligible;
  };
  // Convergence is quadratic: a 3 x 3 matrix is diagonal to double precision after five sweeps at most; eight
  // are safe.
  for (int sweep = 0; sweep < 8 && !is_diagonal(); ++sweep) {
    rotate(a, v, 0, 1, negligible);
    rotate(a, v, 0, 2, negligible);
    rotate(a, v, 1, 2, negligible);
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  const auto put_in_order = [&](std::size_t& i, std::size_t& j) {
    if (a[i][i] < a[j][j]) std::swap(i, j);
  };
  put_in_order(order[0], order[1]);
  put_in_order(order[1], order[2]);
  put_in_order(order[0], order[1]);
  Eigen3 result{};
  for (std::size_t i = 0; i < 3; ++i) {
    result.values[i] = a[order[i]][order[i]];
    for (std::size_t k = 0; k < 3; ++k) result.vectors[i][k] = v[k][order[i]];
  }
  return result;
}

std::array<double, 3> largest_eigenvector(const Symmetric3& matrix) {
  const double size = trace(matrix);
  if (!(size > 0x1p-500 && size < 0x1p500)) return eigen_decomposition(matrix).vectors[0];
  Symmetric3 power = scaled(1 / size, matrix);
  // The matrix to the power of 64, where values of half the largest have come down to rounding.
  for (int squarings = 0; squarings < 6; ++squarings) {
    power = square(power);
    // The sum of the squares of the shares that the values had: 1 if there was but one, and now the others'
    // are squares of what was missing.
    const double squares = trace(power);
    power = scaled(1 / squares, power);
    if (squares > 1 - 0x1p-28) return longest_column(power);
  }
  return eigen_decomposition(matrix).vectors[0];
}

}  // namespace keenline::kernels
