#include "keenline/lines/side_surface.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "keenline/lines/band_least_squares.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

using Terms = std::array<double, 6>;

Terms terms_at(double x, double y) { return {1, x, y, y * y, x * y, x * x}; }

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

std::array<double, 2> SideSurface::slopes(const Point& offset) const {
  const double u = dot(offset, x);
  const double v = dot(offset, y);
  return {height[1] + height[4] * v + 2 * height[5] * u, height[2] + 2 * height[3] * v + height[4] * u};
}

Point SideSurface::normal(const Point& offset) const {
  const auto [along_x, along_y] = slopes(offset);
  return unit(difference(z, sum(scaled(along_x, x), scaled(along_y, y))));
}

double SideSurface::distance(const Point& offset) const {
  if (is_plane()) return dot(offset, z) - height[0];  // most surfaces, and what most time is spent on
  const auto [along_x, along_y] = slopes(offset);
  return above(offset) / std::sqrt(1 + along_x * along_x + along_y * along_y);
}

std::optional<SideSurface> fit_surface(const SideSurface& frame, std::span<const Point> offsets,
                                       std::span<const double> weights, SurfaceTerms terms) {
  const auto size = static_cast<std::size_t>(terms);
  BandLeastSquares equations(size, size);
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    if (weights[p] == 0) continue;
    const Terms monomials = terms_at(dot(offsets[p], frame.x), dot(offsets[p], frame.y));
    const Point height{0, 0, dot(offsets[p], frame.z)};
    equations.add(0, std::span(monomials).first(size), height, weights[p]);
  }
  const std::optional<std::vector<Point>> factors = std::move(equations).solve();
  if (!factors) return std::nullopt;
  SideSurface surface = frame;
  surface.height.fill(0);
  for (std::size_t i = 0; i < size; ++i) surface.height[i] = (*factors)[i][2];
  return surface;
}

}  // namespace keenline
