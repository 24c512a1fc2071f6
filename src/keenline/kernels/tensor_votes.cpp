#include "keenline/kernels/tensor_votes.h"

#include <algorithm>
#include <cmath>

#include "keenline/kernels/portable_math.h"
#include "keenline/vectors.h"

namespace keenline::kernels {
namespace {

/// tensor += strength v vᵀ
void add_vote(Symmetric3& tensor, const Point& v, double strength) {
  Symmetric3 square;
  add_square(square, v, 1);
  tensor.xx += strength * square.xx;
  tensor.xy += strength * square.xy;
  tensor.xz += strength * square.xz;
  tensor.yy += strength * square.yy;
  tensor.yz += strength * square.yz;
  tensor.zz += strength * square.zz;
}

void add_identity(Symmetric3& sum, double s) {
  sum.xx += s;
  sum.yy += s;
  sum.zz += s;
}

/// v mirrored in the plane across `direction`, whose squared length is `square`.
Point mirrored(const Point& v, const Point& direction, double square) {
  return difference(v, scaled(2 * dot(v, direction) / square, direction));
}

/// asin(u) / u for u = sqrt(square) in [0, 1].
double arc_over_sine(double square) {
  if (square < 1e-12) return 1;  // it is 1 + u² / 6
  const double sine = std::sqrt(square);
  return angle_of(sine, std::sqrt(1 - square)) / sine;
}

}  // namespace

void add_stick_vote(Symmetric3& tensor, const Point& normal, const Point& offset, double curvature_weight,
                    double weight) {
  const double square = dot(offset, offset);
  const double across = dot(normal, offset);
  const double squared_sine = across * across / square;  // of the angle off the tangent plane
  constexpr double largest_squared_sine = 0.5;           // 45 degrees
  if (squared_sine > largest_squared_sine) return;
  const double arc_per_chord = arc_over_sine(squared_sine);
  const double squared_arc = square * arc_per_chord * arc_per_chord;
  const double squared_curvature = 4 * squared_sine / square;
  const double fade = exp_of_negative(-(squared_arc + curvature_weight * squared_curvature));
  add_vote(tensor, mirrored(normal, offset, square), weight * fade);
}

void add_ball_vote(Symmetric3& tensor, const Point& offset, double weight) {
  const double square = dot(offset, offset);
  const double strength = 0.8 * weight * exp_of_negative(-square);
  add_identity(tensor, strength);
  add_vote(tensor, offset, -0.5 * strength / square);
}

Saliency saliency_of(const Eigen3& tensor) {
  const double largest = tensor.values[0];
  if (!(largest > 0)) return {};
  const double second = std::max(0.0, tensor.values[1]);  // rounding may leave less than 0
  const double third = std::max(0.0, tensor.values[2]);
  return {(largest - second) / largest, (second - third) / largest, third / largest};
}

}  // namespace keenline::kernels
