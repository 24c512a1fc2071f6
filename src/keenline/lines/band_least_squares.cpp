#include "keenline/lines/band_least_squares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "keenline/vectors.h"

namespace keenline {

BandLeastSquares::BandLeastSquares(std::size_t unknowns, std::size_t band)
    : band_(band), matrix_(unknowns * band, 0.0), right_(unknowns, Point{}) {}

void BandLeastSquares::add(std::size_t first, std::span<const double> factors, const Point& value,
                           double weight) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const double factor = weight * factors[i];
    for (std::size_t j = 0; j <= i; ++j) at(first + i, first + j) += factor * factors[j];
    right_[first + i] = sum(right_[first + i], scaled(factor, value));
  }
}

std::optional<std::vector<Point>> BandLeastSquares::solve() && {
  constexpr double least_pivot = 1e-10;  // of what it was before what depends on others was taken off
  const std::size_t size = right_.size();
  const auto first_of = [&](std::size_t i) { return i < band_ ? 0 : i - band_ + 1; };
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = first_of(i); j < i; ++j) {
      for (std::size_t k = std::max(first_of(i), first_of(j)); k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      at(i, j) /= at(j, j);
    }
    const double whole = at(i, i);
    for (std::size_t k = first_of(i); k < i; ++k) at(i, i) -= at(i, k) * at(i, k);
    if (!(at(i, i) > least_pivot * whole)) return std::nullopt;
    at(i, i) = std::sqrt(at(i, i));
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = first_of(i); k < i; ++k)
      right_[i] = difference(right_[i], scaled(at(i, k), right_[k]));
    right_[i] = scaled(1 / at(i, i), right_[i]);
  }
  for (std::size_t i = size; i-- > 0;) {
    right_[i] = scaled(1 / at(i, i), right_[i]);
    for (std::size_t k = first_of(i); k < i; ++k)
      right_[k] = difference(right_[k], scaled(at(i, k), right_[i]));
  }
  return std::move(right_);
}

}  // namespace keenline
