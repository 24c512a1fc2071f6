#include "keenline/detect/cone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "keenline/vectors.h"

namespace keenline {
namespace {

using Vector6 = std::array<double, 6>;
using Matrix6 = std::array<Vector6, 6>;  // the lower triangle

/// One more equation row · x = value, in weighted least squares.
void add_equation(Matrix6& matrix, Vector6& right, const Vector6& row, double value, double weight) {
  for (std::size_t i = 0; i < 6; ++i) {
    const double factor = weight * row[i];
    right[i] += factor * value;
    for (std::size_t j = 0; j <= i; ++j) matrix[i][j] += factor * row[j];
  }
}

/// By Cholesky decomposition; empty where the matrix is not positive definite.
std::optional<Vector6> solution(Matrix6 matrix, Vector6 x) {
  Vector6 inverse;  // of the diagonal: one division for a row of quotients
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = matrix[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= matrix[i][k] * matrix[j][k];
      matrix[i][j] = sum * inverse[j];
    }
    double square = matrix[i][i];
    for (std::size_t k = 0; k < i; ++k) square -= matrix[i][k] * matrix[i][k];
    if (!(square > 0)) return std::nullopt;
    inverse[i] = 1 / std::sqrt(square);
    for (std::size_t k = 0; k < i; ++k) x[i] -= matrix[i][k] * x[k];
    x[i] *= inverse[i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) x[i] -= matrix[k][i] * x[k];
    x[i] *= inverse[i];
  }
  return x;
}

/// Weighted sum of the squares of the difference between the equation's sides.
double misfit(const Cone& cone, std::span<const Point> points, std::span<const double> weights) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point u = difference(points[i], cone.apex);
    const double residual = length(u) - dot(u, cone.slope);
    sum += weights[i] * residual * residual;
  }
  return sum;
}

/// The equations of a step of Gauss and Newton.
struct Equations {
  Matrix6 matrix{};
  Vector6 right{};
};

Equations equations_at(const Cone& cone, std::span<const Point> points, std::span<const double> weights) {
  Equations equations;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point u = difference(points[i], cone.apex);
    const double distance = length(u);
    if (!(distance > 0)) continue;  // in the apex: on the cone, whatever it is
    Vector6 row{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row[axis] = cone.slope[axis] - u[axis] / distance;
      row[3 + axis] = -u[axis];
    }
    add_equation(equations.matrix, equations.right, row, dot(u, cone.slope) - distance, weights[i]);
  }
  return equations;
}

/// The step, damped; the cone itself where the equations have no solution.
Cone improved(const Cone& cone, Equations equations, double damping) {
  for (std::size_t i = 0; i < 6; ++i) equations.matrix[i][i] += damping * equations.matrix[i][i] + 1e-12;
  Cone result = cone;
  if (const auto step = solution(equations.matrix, equations.right)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      result.apex[axis] += (*step)[axis];
      result.slope[axis] += (*step)[3 + axis];
    }
  }
  return result;
}

/// The best cone with a given apex: the equations are linear then.
Cone cone_from(const Point& apex, std::span<const Point> points, std::span<const double> weights) {
  Matrix6 matrix{};
  Vector6 right{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point u = difference(points[i], apex);
    add_equation(matrix, right, {u[0], u[1], u[2], 0, 0, 0}, length(u), weights[i]);
  }
  for (std::size_t i = 0; i < 6; ++i) matrix[i][i] += 1e-5;  // also solves for points in one plane
  Cone cone{.apex = apex};
  if (const auto slope = solution(matrix, right)) cone.slope = {(*slope)[0], (*slope)[1], (*slope)[2]};
  return cone;
}

double farthest_from(const Point& origin, std::span<const Point> points) {
  double reach = 0;
  for (const Point& q : points) reach = std::max(reach, distance(origin, q));
  return reach;
}

}  // namespace

double Cone::squared_sine() const { return 1 - 1 / dot(slope, slope); }

bool is_pointed(const Cone& cone) {
  constexpr double smallest = 1.01;  // squared inverse cosines of half the opening
  constexpr double largest = 6.83;
  const double slope = dot(cone.slope, cone.slope);
  return slope >= smallest && slope <= largest;
}

std::optional<Cone> fitted_cone(std::span<const Point> points, std::span<const double> weights,
                                const Point& apex) {
  const double reach = farthest_from(apex, points);
  Cone cone = cone_from(apex, points, weights);
  double sum = misfit(cone, points, weights);
  double damping = 1e-3;
  Equations equations = equations_at(cone, points, weights);
  // Until a step brings nothing to speak of; exact cones take four to six.
  for (int tries = 0; tries < 12 && sum > 1e-12; ++tries) {
    const Cone next = improved(cone, equations, damping);
    const double next_sum = misfit(next, points, weights);
    if (next_sum < sum) {
      // What is no tip is fitted ever better by ever larger cones.
      if (!(distance(next.apex, apex) <= reach)) return std::nullopt;
      const bool has_arrived = next_sum > 0.999 * sum;
      cone = next;
      sum = next_sum;
      if (has_arrived) break;
      equations = equations_at(cone, points, weights);
      damping *= 0.1;
    } else {
      damping *= 10;
    }
  }
  return cone;
}

double mean_square_off(const Cone& cone, std::span<const Point> points, std::span<const double> weights) {
  // From the difference |u| - slope · u to the distance: times the cotangent of half the opening.
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  return misfit(cone, points, weights) / total / (dot(cone.slope, cone.slope) - 1);
}

double mean_square_off_paraboloid(const Cone& cone, std::span<const Point> points,
                                  std::span<const double> weights) {
  const Point z = unit(cone.slope);
  const Point x = unit(cross(z, std::abs(z[0]) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0}));
  const Point y = cross(z, x);
  const auto row_of = [&](const Point& q) {
    const double u = dot(q, x);
    const double v = dot(q, y);
    return Vector6{1, u, v, u * u, u * v, v * v};
  };
  Matrix6 matrix{};
  Vector6 right{};
  for (std::size_t i = 0; i < points.size(); ++i)
    add_equation(matrix, right, row_of(points[i]), dot(points[i], z), weights[i]);
  const auto coefficients = solution(matrix, right);
  if (!coefficients) return 0;
  double sum = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    double residual = dot(points[p], z);
    const Vector6 row = row_of(points[p]);
    for (std::size_t i = 0; i < 6; ++i) residual -= (*coefficients)[i] * row[i];
    sum += weights[p] * residual * residual;
  }
  return cone.squared_sine() * sum / std::accumulate(weights.begin(), weights.end(), 0.0);
}

bool encloses_axis(const Cone& cone, std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), [&](const Point& a) {
    const Point around = cross(cone.slope, difference(a, cone.apex));
    return std::any_of(points.begin(), points.end(),
                       [&](const Point& b) { return dot(around, difference(b, cone.apex)) > 0; });
  });
}

}  // namespace keenline
