#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

/// Unknowns that satisfy linear equations as well as they can: the least weighted sum of squared misses. The
/// unknowns are points, or numbers in one coordinate of points. By normal equations and Cholesky's
/// decomposition of a band matrix, additions in the order of the equations: same bits on every CPU.
class BandLeastSquares {
 public:
  /// \param band how many unknowns in a row one equation has at most
  BandLeastSquares(std::size_t unknowns, std::size_t band);

  /// Adds the equation: the sum of factors[i] times unknown first + i is `value`.
  /// \pre factors.size() <= band, and the last unknown exists
  void add(std::size_t first, std::span<const double> factors, const Point& value, double weight = 1);

  /// Nothing where the equations do not determine the unknowns, beyond rounding.
  /// Cost: O(unknowns band^2).
  [[nodiscard]] std::optional<std::vector<Point>> solve() &&;

 private:
  /// Of the normal matrix: row i, column j, where j <= i < j + band_.
  [[nodiscard]] double& at(std::size_t i, std::size_t j) { return matrix_[i * band_ + (i - j)]; }

  std::size_t band_;
  std::vector<double> matrix_;
  std::vector<Point> right_;
};

}  // namespace keenline
