#include "keenline/lines/side_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keenline/vectors.h"

namespace keenline {
namespace {

using Terms = std::array<double, 6>;

Terms terms_at(double x, double y) { return {1, x, y, y * y, x * y, x * x}; }

/// Solves a symmetric system by Cholesky's decomposition; false unless it is positive definite beyond
/// rounding.
bool solve(std::array<Terms, 6>& a, Terms& b, std::size_t size) {
  double largest = 0;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, a[i][i]);
  for (std::size_t j = 0; j < size; ++j) {
    for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
    if (!(a[j][j] > 1e-10 * largest)) return false;
    a[j][j] = std::sqrt(a[j][j]);
    for (std::size_t i = j + 1; i < size; ++i) {
      for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
      a[i][j] /= a[j][j];
    }
  }
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
    b[i] /= a[i][i];
  }
  for (std::size_t i = size; i-- > 0;) {
    for (std::size_t k = i + 1; k < size; ++k) b[i] -= a[k][i] * b[k];
    b[i] /= a[i][i];
  }
  return true;
}

}  // namespace

Point SideSurface::offset_of(const Point& position) const {
  return scaled(1 / spacing, difference(position, origin));
}

double SideSurface::above(const Point& offset) const {
  const Terms terms = terms_at(dot(offset, x), dot(offset, y));
  double above = dot(offset, z);
  for (std::size_t i = 0; i < terms.size(); ++i) above -= height[i] * terms[i];
  return above;
}

Point SideSurface::normal(const Point& offset) const {
  const double u = dot(offset, x);
  const double v = dot(offset, y);
  const double along_x = height[1] + height[4] * v + 2 * height[5] * u;
  const double along_y = height[2] + 2 * height[3] * v + height[4] * u;
  return unit(difference(z, sum(scaled(along_x, x), scaled(along_y, y))));
}

double SideSurface::distance(const Point& offset) const { return above(offset) * dot(normal(offset), z); }

std::optional<SideSurface> fit_surface(const SideSurface& frame, std::span<const Point> offsets,
                                       std::span<const double> weights, SurfaceTerms terms) {
  const auto size = static_cast<std::size_t>(terms);
  std::array<Terms, 6> squares{};
  Terms right{};
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    if (weights[p] == 0) continue;
    const Terms monomials = terms_at(dot(offsets[p], frame.x), dot(offsets[p], frame.y));
    const double z = dot(offsets[p], frame.z);
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j <= i; ++j) squares[i][j] += weights[p] * monomials[i] * monomials[j];
      right[i] += weights[p] * monomials[i] * z;
    }
  }
  if (!solve(squares, right, size)) return std::nullopt;
  SideSurface surface = frame;
  surface.height.fill(0);
  std::copy_n(right.begin(), size, surface.height.begin());
  return surface;
}

}  // namespace keenline
