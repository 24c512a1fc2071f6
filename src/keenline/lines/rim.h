#pragma once

#include <optional>
#include <span>

#include "keenline/lines/find_sides.h"

namespace keenline {

/// Where the surface of `side` ends, as a wall that stands upright on its rim. The rim is the line or
/// parabola over the surface's y axis that has all points of the surface behind it and the least area
/// between: the most likely one for random points (a convex hull, see de Berg et al. 2008, "Computational
/// Geometry", 1.1). It is a parabola only where a line leaves an area empty in which five more points were
/// to be expected. Then it is moved outwards by what it falls short of on average: the area of one point for
/// each of its two or three parameters. Nothing unless three points span 4 spacings or more along the rim.
/// \param offsets from the origin of the surface, in its spacings; farther out than 3 there are other
/// surfaces
[[nodiscard]] std::optional<Side> rim_of(const Side& side, std::span<const Point> offsets);

}  // namespace keenline
