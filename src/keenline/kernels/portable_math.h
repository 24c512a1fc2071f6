#pragma once

namespace keenline::kernels {

// The system's sin, cos, exp, log and atan2 pick an implementation by CPU and round differently. These use +
// - * / and exact operations only, so that the same options give the same points everywhere.

inline constexpr double pi = 3.14159265358979323846;

[[nodiscard]] constexpr double radians(double degrees) { return degrees * (pi / 180); }

struct SinCos {
  double sin;
  double cos;
};

/// Absolute error below 3e-16. \pre |radians| <= 1e5
[[nodiscard]] SinCos sin_cos(double radians);

/// e^x; relative error below 1e-15, and 0 below e^-708. \pre x <= 0, or minus infinity
[[nodiscard]] double exp_of_negative(double x);

/// Natural logarithm; relative error below 1e-15. \pre x is positive and finite
[[nodiscard]] double natural_log(double x);

/// Angle of (x, y) from the x axis, in (-pi, pi]; 0 for (0, 0). Relative error below 1e-15.
[[nodiscard]] double angle_of(double y, double x);

}  // namespace keenline::kernels
