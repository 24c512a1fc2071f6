#include "keenline/detect/peak.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "keenline/cloud.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// A cone has six parameters: fewer points fit too well by chance.
constexpr std::size_t smallest_count = 12;
/// Length of the mean direction to the neighbours. On a plane it is 0.2 by chance; at an apex the cosine of
/// half the opening, and still a third where the nearest sample of a cone of 120 degrees is far off its apex.
constexpr double smallest_mean_direction = 0.25;
/// Squared inverse cosines of half the opening. 11 degrees: narrower is a wire, without a surface to speak
/// of. 135 degrees: the tips that coarse sampling cuts off curved surfaces are wider.
constexpr double smallest_slope = 1.01;
constexpr double largest_slope = 6.83;
/// How far the apex may lie from its nearest sample, in distances to the farthest neighbour: on cones, 0.84
/// at most in hundreds. Farther off, points on both sides may each seem the nearest.
constexpr double largest_apex_distance = 0.85;
/// Root mean square distance from the cone, in distances to the farthest neighbour times the sine of half
/// the opening (the cone's radius there). Random corners of five equal faces have 0.015 to 0.04, one in 60
/// less, those of fewer faces above 0.045.
constexpr double largest_residual = 0.015;
/// The same distance compared with that from the paraboloid. Coarse smooth surfaces have 0.7 to 5, an apex 0
/// without noise.
constexpr double largest_ratio = 0.5;

using Vector6 = std::array<double, 6>;
using Matrix6 = std::array<Vector6, 6>;  // the lower triangle

/// One more equation row · x = value, in least squares.
void add_equation(Matrix6& matrix, Vector6& right, const Vector6& row, double value) {
  for (std::size_t i = 0; i < 6; ++i) {
    right[i] += row[i] * value;
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += row[i] * row[j];
  }
}

/// By Cholesky decomposition; empty where the matrix is not positive definite.
std::optional<Vector6> solution(Matrix6 matrix, Vector6 x) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      if (i != j) matrix[i][j] = sum / matrix[j][j];
      else if (sum > 0) matrix[i][i] = std::sqrt(sum);
      else return std::nullopt;
    }
    for (std::size_t k = 0; k < i; ++k) x[i] -= matrix[i][k] * x[k];
    x[i] /= matrix[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) x[i] -= matrix[k][i] * x[k];
    x[i] /= matrix[i][i];
  }
  return x;
}

/// The point, at the origin, and its neighbours.
template <typename Function>
void for_each_point(const GaussMap& map, const Function& function) {
  function(Point{0, 0, 0});
  for (const Point& offset : map.offsets()) function(offset);
}

/// The points q with |q - apex| = slope · (q - apex): slope is the axis divided by the cosine of half the
/// opening, and the equation is linear in it.
struct Cone {
  Point apex{0, 0, 0};
  Point slope{0, 0, 0};
};

/// Sum of the squares of the equation's two sides' difference.
double misfit(const GaussMap& map, const Cone& cone) {
  double sum = 0;
  for_each_point(map, [&](const Point& q) {
    const Point u = difference(q, cone.apex);
    const double residual = std::sqrt(dot(u, u)) - dot(u, cone.slope);
    sum += residual * residual;
  });
  return sum;
}

/// One step of Gauss and Newton, damped; the cone itself where the equations have no solution.
Cone improved(const GaussMap& map, const Cone& cone, double damping) {
  Matrix6 matrix{};
  Vector6 right{};
  for_each_point(map, [&](const Point& q) {
    const Point u = difference(q, cone.apex);
    const double length = std::sqrt(dot(u, u));
    if (!(length > 0)) return;  // in the apex: on the cone, whatever it is
    Vector6 row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = cone.slope[axis] - u[axis] / length;
      row[3 + axis] = -u[axis];
    }
    add_equation(matrix, right, row, dot(u, cone.slope) - length);
  });
  for (std::size_t i = 0; i < 6; ++i) matrix[i][i] += damping * matrix[i][i] + 1e-12;
  Cone result = cone;
  if (const auto step = solution(matrix, right)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.apex[axis] += (*step)[axis];
      result.slope[axis] += (*step)[3 + axis];
    }
  }
  return result;
}

/// The best cone whose apex is the point: with the apex given, the equations are linear.
Cone cone_from_point(const GaussMap& map) {
  Matrix6 matrix{};
  Vector6 right{};
  for (std::size_t i = 0; i < map.offsets().size(); ++i) {
    const Point& u = map.offsets()[i];
    add_equation(matrix, right, {u[0], u[1], u[2], 0, 0, 0}, map.lengths()[i]);
  }
  for (std::size_t i = 0; i < 6; ++i) matrix[i][i] += 1e-5;  // also solves for neighbours in one plane
  Cone cone;
  if (const auto slope = solution(matrix, right)) cone.slope = {(*slope)[0], (*slope)[1], (*slope)[2]};
  return cone;
}

/// From there with an apex of its own (Levenberg and Marquardt), until a step brings nothing to speak of;
/// exact cones take four to six steps.
Cone fitted_cone(const GaussMap& map) {
  Cone cone = cone_from_point(map);
  double sum = misfit(map, cone);
  double damping = 1e-3;
  for (int tries = 0; tries < 12 && sum > 1e-12; ++tries) {
    const Cone next = improved(map, cone, damping);
    const double next_sum = misfit(map, next);
    if (next_sum < sum) {
      const bool has_arrived = next_sum > 0.999 * sum;
      cone = next;
      sum = next_sum;
      if (has_arrived) break;
      damping *= 0.1;
    } else {
      damping *= 10;
    }
  }
  return cone;
}

/// Mean square distance, along the axis, from the paraboloid c₀ + c₁x + c₂y + c₃x² + c₄xy + c₅y² that fits
/// best; 0 where none is best.
double mean_square_off_paraboloid(const GaussMap& map, const Point& axis) {
  Point u = cross(axis, std::abs(axis[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0});
  const double length = std::sqrt(dot(u, u));
  for (double& c : u) c /= length;
  const Point v = cross(axis, u);
  const auto row_of = [&](const Point& q) {
    const double x = dot(q, u);
    const double y = dot(q, v);
    return Vector6{1, x, y, x * x, x * y, y * y};
  };
  Matrix6 matrix{};
  Vector6 right{};
  for_each_point(map, [&](const Point& q) { add_equation(matrix, right, row_of(q), dot(q, axis)); });
  const auto coefficients = solution(matrix, right);
  if (!coefficients) return 0;
  double sum = 0;
  for_each_point(map, [&](const Point& q) {
    double residual = dot(q, axis);
    const Vector6 row = row_of(q);
    for (std::size_t i = 0; i < 6; ++i) residual -= (*coefficients)[i] * row[i];
    sum += residual * residual;
  });
  return sum / static_cast<double>(map.offsets().size() + 1);
}

/// Does the surface go all around the axis? Not where some point has no other within the half turn after it.
bool encloses_axis(const GaussMap& map, const Cone& cone) {
  bool encloses = true;
  for_each_point(map, [&](const Point& a) {
    const Point around = cross(cone.slope, difference(a, cone.apex));
    bool followed = false;
    for_each_point(map,
                   [&](const Point& b) { followed = followed || dot(around, difference(b, cone.apex)) > 0; });
    encloses = encloses && followed;
  });
  return encloses;
}

/// Seen from a peak all neighbours lie to one side; where they lie all around nothing needs to be fitted.
bool neighbors_lie_to_one_side(const GaussMap& map) {
  Point sum{0, 0, 0};
  for (std::size_t i = 0; i < map.offsets().size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += map.offsets()[i][axis] / map.lengths()[i];
  const double smallest = smallest_mean_direction * static_cast<double>(map.offsets().size());
  return dot(sum, sum) > smallest * smallest;
}

/// No neighbour is closer to the apex than the point, and the point is not far from it.
bool is_nearest_to_apex(const GaussMap& map, const Cone& cone, double reach) {
  const double square = dot(cone.apex, cone.apex);
  if (!(square <= largest_apex_distance * largest_apex_distance * reach * reach)) return false;
  return std::none_of(map.offsets().begin(), map.offsets().end(), [&](const Point& q) {
    const Point u = difference(q, cone.apex);
    return dot(u, u) < square;
  });
}

}  // namespace

bool is_peak(const GaussMap& map) {
  if (map.offsets().size() < smallest_count || !neighbors_lie_to_one_side(map)) return false;
  const Cone cone = fitted_cone(map);
  const double slope = dot(cone.slope, cone.slope);
  if (!(slope >= smallest_slope && slope <= largest_slope)) return false;
  const double reach = *std::max_element(map.lengths().begin(), map.lengths().end());
  if (!is_nearest_to_apex(map, cone, reach)) return false;

  // From the difference |u| - slope · u to the distance: times the cotangent of half the opening.
  const double mean_square = misfit(map, cone) / static_cast<double>(map.offsets().size() + 1) / (slope - 1);
  const double square_of_sine = 1 - 1 / slope;
  const double largest = largest_residual * reach;
  if (!(mean_square <= largest * largest * square_of_sine) || !encloses_axis(map, cone)) return false;
  Point axis = cone.slope;
  for (double& c : axis) c /= std::sqrt(slope);
  return mean_square <=
         largest_ratio * largest_ratio * square_of_sine * mean_square_off_paraboloid(map, axis);
}

}  // namespace keenline
