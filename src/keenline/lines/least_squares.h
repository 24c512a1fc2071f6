#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace keenline {

/// Least squares in a few unknowns, by the normal equations; the same bits everywhere.
template <std::size_t N>
class LeastSquares {
 public:
  void add(const std::array<double, N>& row, double value, double weight = 1) {
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) matrix_[i][j] += weight * row[i] * row[j];
      right_[i] += weight * row[i] * value;
    }
    squares_ += weight * value * value;
  }

  /// Sum of the squared differences that the best solution leaves: by Cholesky's decomposition, unknowns that
  /// those before them determine are left out.
  [[nodiscard]] double residual() const {
    auto l = matrix_;
    auto y = right_;
    double left = squares_;
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        for (std::size_t k = 0; k < j; ++k) l[i][j] -= l[i][k] * l[j][k];
        if (i != j) l[i][j] = l[j][j] > 0 ? l[i][j] / l[j][j] : 0;
      }
      constexpr double dependent = 1e-12;
      l[i][i] = l[i][i] > dependent * matrix_[i][i] ? std::sqrt(l[i][i]) : 0;
      for (std::size_t k = 0; k < i; ++k) y[i] -= l[i][k] * y[k];
      y[i] = l[i][i] > 0 ? y[i] / l[i][i] : 0;
      left -= y[i] * y[i];
    }
    return left > 0 ? left : 0;
  }

 private:
  std::array<std::array<double, N>, N> matrix_{};  // lower triangle
  std::array<double, N> right_{};
  double squares_ = 0;
};

}  // namespace keenline
