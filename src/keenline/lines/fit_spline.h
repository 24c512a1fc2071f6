#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "keenline/feature_graph.h"

namespace keenline {

struct SplineFit {
  FittedSpline spline;
  std::vector<double> parameters;  ///< where the points are on it
};

/// The cubic B-spline of so many control points that goes through the first and last point (of a closed line
/// round to where it began, without a kink there) and to which the squared distances of the others are
/// least. Parameters begin as arc length and are moved three times towards where the curve is nearest
/// (Hoschek 1988, "Intrinsic parametrization for approximation"); knots follow them (Piegl and Tiller 1997,
/// "The NURBS Book", 9.69). Nothing where the points do not determine it.
/// \pre 4 (closed: 5) <= controls <= points.size() (closed: + 1)
[[nodiscard]] std::optional<SplineFit> fit_spline(std::span<const Point> points, bool closed,
                                                  std::size_t controls);

/// \pre knots[3] <= parameter <= knots[knots.size() - 4]
[[nodiscard]] Point point_on(const FittedSpline& spline, double parameter);

}  // namespace keenline
