#include "keenline/lines/side_surface.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "keenline/lines/band_least_squares.h"
#include "keenline/vectors.h"

namespace keenline {

Point SideSurface::offset_of(const Point& position) const {
  return scaled(1 / spacing, difference(position, origin));
}

Point SideSurface::normal(const Point& offset) const {
  const auto [along_x, along_y] = slopes(offset);
  return unit(difference(z, sum(scaled(along_x, x), scaled(along_y, y))));
}

std::optional<SideSurface> fit_surface(const SideSurface& frame, std::span<const Point> places,
                                       std::span<const double> weights, SurfaceTerms terms) {
  const auto size = static_cast<std::size_t>(terms);
  BandLeastSquares equations(size, size);
  for (std::size_t p = 0; p < places.size(); ++p) {
    if (weights[p] == 0) continue;
    const std::array<double, 6> monomials = SideSurface::terms_at(places[p][0], places[p][1]);
    const Point height{0, 0, places[p][2]};
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
