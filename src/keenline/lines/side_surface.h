#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "keenline/cloud.h"
#include "keenline/vectors.h"

namespace keenline {

/// A smooth surface near one place: its height over a plane is a polynomial. All lengths are counted in
/// spacings from the origin, so that neither the scale nor the place of the cloud costs digits.
struct SideSurface {
  Point origin{};  ///< in the cloud's own coordinates
  double spacing = 1;
  Point x{1, 0, 0};  ///< x and y span the plane, z is up; unit vectors perpendicular to each other
  Point y{0, 1, 0};
  Point z{0, 0, 1};
  std::array<double, 6> height{};  ///< factors of 1, x, y, y², x y, x²

  /// Level over the plane, as it is first laid through points.
  [[nodiscard]] bool is_plane() const {
    return std::all_of(height.begin() + 1, height.end(), [](double factor) { return factor == 0; });
  }
  /// What the factors multiply.
  [[nodiscard]] static std::array<double, 6> terms_at(double x, double y) {
    return {1, x, y, y * y, x * y, x * x};
  }
  [[nodiscard]] Point offset_of(const Point& position) const;
  /// The offset by its coordinates along x, y and z.
  [[nodiscard]] Point in_frame(const Point& offset) const {
    return {dot(offset, x), dot(offset, y), dot(offset, z)};
  }

  /// By how much the offset lies above the surface, along z.
  [[nodiscard]] double above(const Point& offset) const {
    if (is_plane()) return dot(offset, z) - height[0];  // most surfaces, and what most time is spent on
    return above_in_frame(in_frame(offset));
  }
  /// Unit normal, on the side of z, where the surface is above or below the offset.
  [[nodiscard]] Point normal(const Point& offset) const;
  /// To first order, in spacings; positive on the side of z.
  [[nodiscard]] double distance(const Point& offset) const { return distance_in_frame(in_frame(offset)); }
  /// The same of a place that is in_frame().
  [[nodiscard]] double distance_in_frame(const Point& place) const {
    if (is_plane()) return place[2] - height[0];
    const auto [along_x, along_y] = slopes_in_frame(place);
    return above_in_frame(place) / std::sqrt(1 + along_x * along_x + along_y * along_y);
  }
  /// By how much the surface rises along x and y, where it is above or below the offset.
  [[nodiscard]] std::array<double, 2> slopes(const Point& offset) const {
    return slopes_in_frame(in_frame(offset));
  }

 private:
  [[nodiscard]] double above_in_frame(const Point& place) const {
    const std::array<double, 6> terms = terms_at(place[0], place[1]);
    double above = place[2];
    for (std::size_t i = 0; i < terms.size(); ++i) above -= height[i] * terms[i];
    return above;
  }
  [[nodiscard]] std::array<double, 2> slopes_in_frame(const Point& place) const {
    const auto [u, v, w] = place;
    return {height[1] + height[4] * v + 2 * height[5] * u, height[2] + 2 * height[3] * v + height[4] * u};
  }
};

/// Which of the factors may differ from 0: so many from the first.
enum class SurfaceTerms : std::uint8_t { Plane = 3, BentAlongY = 4, Quadric = 6 };

/// The polynomial over the plane of `frame` that fits best: least weighted sum of squared heights. None
/// where the points do not determine it.
/// \param places of the points, in_frame()
/// \pre as many weights as places
[[nodiscard]] std::optional<SideSurface> fit_surface(const SideSurface& frame, std::span<const Point> places,
                                                     std::span<const double> weights, SurfaceTerms terms);

}  // namespace keenline
