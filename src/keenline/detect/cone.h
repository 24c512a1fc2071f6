#pragma once

#include <optional>
#include <span>

#include "keenline/cloud.h"

namespace keenline {

/// A circular cone: the points q with |q - apex| = slope · (q - apex). The slope is the unit vector of the
/// axis, from the apex into the cone, divided by the cosine of half the opening; the equation is linear in
/// it.
struct Cone {
  Point apex{0, 0, 0};
  Point slope{0, 0, 0};

  /// Squared sine of half the opening; that of no cone, whose slope is shorter than 1, is negative.
  [[nodiscard]] double squared_sine() const;
};

/// Is it a tip? From 11 degrees of opening, as narrower ones are wires, without a surface to speak of, to
/// 135: the tips that coarse sampling cuts off curved surfaces are wider.
[[nodiscard]] bool is_pointed(const Cone& cone);

/// The cone with the least weighted sum of squared differences of the equation's sides, by the method of
/// Levenberg and Marquardt from the best cone whose apex is `apex`. None where the search leaves the points,
/// farther from there than all of them: as it does where they are on no tip. With + - * / and square roots
/// only. Cost: O(points), a dozen times at most, three times on no tip.
/// \pre as many weights as points; coordinates of about 1
[[nodiscard]] std::optional<Cone> fitted_cone(std::span<const Point> points, std::span<const double> weights,
                                              const Point& apex);

/// Weighted mean of the squared distances from the cone, to first order.
/// \pre as many weights as points
[[nodiscard]] double mean_square_off(const Cone& cone, std::span<const Point> points,
                                     std::span<const double> weights);

/// The same distance from the smooth surface of as many parameters that fits best: the paraboloid
/// c₀ + c₁x + c₂y + c₃x² + c₄xy + c₅y² over the plane across the cone's axis, taken as steep as the cone is.
/// 0 where none fits best.
/// \pre as many weights as points
[[nodiscard]] double mean_square_off_paraboloid(const Cone& cone, std::span<const Point> points,
                                                std::span<const double> weights);

/// Do the points lie all around the axis? Not where one of them has no other within the half turn after it.
/// Cost: O(points²), less where they do.
[[nodiscard]] bool encloses_axis(const Cone& cone, std::span<const Point> points);

}  // namespace keenline
