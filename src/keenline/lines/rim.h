#pragma once

#include <optional>
#include <span>

#include "keenline/lines/find_sides.h"

namespace keenline {

/// Where the surface of `side` ends, as a wall that stands upright on its rim. Along the rim the outermost
/// two points of every 1.6 spacings say where it ends: as far beyond the first as that is beyond the second
/// (Robson and Whitlock 1964, "Estimation of a truncation point"), half of what one random point falls
/// short. A line of least squares goes through these ends. Nothing unless three pieces have two points.
/// \param offsets from the origin of the surface, in its spacings
[[nodiscard]] std::optional<Side> rim_of(const Side& side, std::span<const Point> offsets);

}  // namespace keenline
