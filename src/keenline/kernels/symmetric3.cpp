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

}  // namespace keenline::kernels
