#include "keenline/report/report_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keenline/feature_graph.h"

namespace keenline {

ReportGrid grid_for(std::span<const Point> positions) {
  Extent extent;
  for (const Point& p : positions)
    if (is_finite(p)) extent.include(p);
  ReportGrid grid;
  if (extent.is_empty()) return grid;
  grid.origin = extent.low;
  double widest = 0;  // in steps, with a step that no extent can overflow by
  constexpr double unit = 1.0 / ReportGrid::last_place;
  for (std::size_t axis = 0; axis < 3; ++axis)
    widest = std::max(widest, extent.high[axis] * unit - extent.low[axis] * unit);
  if (widest < std::numeric_limits<double>::min()) return grid;  // one place, as far as can be told
  int exponent = 0;
  (void)std::frexp(widest, &exponent);  // widest < 2^exponent
  grid.step = std::ldexp(1.0, exponent);
  return grid;
}

std::array<std::int32_t, 3> place_in(const ReportGrid& grid, const Point& position) {
  std::array<std::int32_t, 3> place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Divided before they are subtracted: the difference of the largest doubles overflows.
    const double steps = std::nearbyint(position[axis] / grid.step - grid.origin[axis] / grid.step);
    constexpr double limit = std::numeric_limits<std::int32_t>::max();
    place[axis] = static_cast<std::int32_t>(std::clamp(steps, -limit, limit));
  }
  return place;
}

}  // namespace keenline
