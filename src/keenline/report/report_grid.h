#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "keenline/cloud.h"

namespace keenline {

/// Whole numbers in place of coordinates: position = origin + step * place, 0 to 2^21 - 1 along each axis.
struct ReportGrid {
  Point origin{};
  double step = 1;  ///< a power of two

  static constexpr std::uint32_t last_place = (1U << 21U) - 1;
};

/// The finest grid that holds all finite positions; any finite coordinates.
[[nodiscard]] ReportGrid grid_for(std::span<const Point> positions);

/// The nearest place to a finite position, which may be outside the grid: then numbers are negative or too
/// large, as far as 32 bits go.
[[nodiscard]] std::array<std::int32_t, 3> place_in(const ReportGrid& grid, const Point& position);

}  // namespace keenline
