#pragma once

#include <optional>
#include <span>

#include "keenline/feature_graph.h"

namespace keenline {

/// The circle through the first and last of the points, or of a closed line any circle, from which the
/// squared distances of the points are least, in the plane from which they are least (of an open line: that
/// contains both ends); of it the part from the first point past the middle one to the last. Nothing where
/// the points are fewer than 3, in one line or in one place. Gauss and Newton from an algebraic start (Kasa
/// 1976, "A circle fitting procedure and its error analysis").
[[nodiscard]] std::optional<FittedArc> fit_arc(std::span<const Point> points, bool closed);

/// The nearest point of an arc; of those equally near, one.
[[nodiscard]] Point nearest_on(const FittedArc& arc, const Point& p);

}  // namespace keenline
