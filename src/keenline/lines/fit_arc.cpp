#include "keenline/lines/fit_arc.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr int rounds = 20;              // Gauss and Newton need far fewer on points of a circle
constexpr double largest_radius = 1e4;  // in sizes of the line: it rises by less than 2e-5 of its length
constexpr double degrees = 180 / kernels::pi;

struct Circle {
  double x, y, radius;
};

/// Points in a plane, about `origin`, in a unit in which the farthest is at 1.
struct Plane {
  Point origin{};
  Point x{};
  Point y{};
  double unit = 1;
  std::vector<std::array<double, 2>> points{};

  void project(std::span<const Point> positions) {
    for (const Point& p : positions) {
      const Point offset = scaled(1 / unit, difference(p, origin));
      points.push_back({dot(offset, x), dot(offset, y)});
    }
  }
};

double farthest_from(const Point& origin, std::span<const Point> points) {
  double farthest = 0;
  for (const Point& p : points) farthest = std::max(farthest, distance(origin, p));
  return farthest;
}

/// The plane of least squares through the origin, its normal perpendicular to `within` unless that is 0.
std::optional<Plane> plane_of(std::span<const Point> points, const Point& origin, const Point& within) {
  Plane plane{.origin = origin, .unit = farthest_from(origin, points)};
  if (!(plane.unit > 0)) return std::nullopt;
  kernels::Symmetric3 scatter;
  for (const Point& p : points) {
    Point offset = scaled(1 / plane.unit, difference(p, origin));
    offset = difference(offset, scaled(dot(offset, within), within));
    kernels::add_outer_product(scatter, offset[0], offset[1], offset[2]);
  }
  const kernels::Eigen3 axes = kernels::eigen_decomposition(scatter);
  constexpr double flat = 1e-20;  // squared: the points are on one line
  const bool is_free = dot(within, within) == 0;
  if (!(axes.values[is_free ? 1 : 0] > flat)) return std::nullopt;
  plane.x = is_free ? axes.vectors[0] : within;
  const Point other = is_free ? axes.vectors[1] : axes.vectors[0];
  plane.y = unit(difference(other, scaled(dot(other, plane.x), plane.x)));
  plane.project(points);
  return plane;
}

/// A circle through (-half, 0) and (half, 0), its centre at (0, y).
std::optional<Circle> circle_through_ends(const Plane& plane, double half) {
  double numerator = 0;
  double denominator = 0;
  for (const auto& [x, y] : plane.points) {
    numerator += y * (x * x + y * y - half * half);
    denominator += 2 * y * y;
  }
  double center = numerator / denominator;
  for (int round = 0; round < rounds && std::abs(center) < largest_radius; ++round) {
    const double radius = std::sqrt(center * center + half * half);
    double slope_miss = 0;
    double slope_slope = 0;
    for (const auto& [x, y] : plane.points) {
      const double reach = std::sqrt(x * x + (y - center) * (y - center));
      if (reach == 0) continue;
      const double slope = (center - y) / reach - center / radius;
      slope_miss += slope * (reach - radius);
      slope_slope += slope * slope;
    }
    if (!(slope_slope > 0)) break;
    center -= slope_miss / slope_slope;
  }
  if (!(std::abs(center) < largest_radius)) return std::nullopt;
  return Circle{0, center, std::sqrt(center * center + half * half)};
}

/// A circle of three free parameters: solves for the change of (x, y, radius) as long as it is told to.
std::optional<Circle> free_circle(const Plane& plane) {
  Circle circle{0, 0, 0};
  const auto count = static_cast<double>(plane.points.size());
  for (int round = 0; round < rounds; ++round) {
    // Kåsa in the first round: x² + y² - 2 a x - 2 b y = r² - a² - b²; then true distances.
    kernels::Symmetric3 squares;
    Point right{};
    for (const auto& [x, y] : plane.points) {
      const double dx = x - circle.x;
      const double dy = y - circle.y;
      const double reach = std::sqrt(dx * dx + dy * dy);
      const bool first = round == 0;
      if (!first && reach == 0) continue;
      const Point row = first ? Point{2 * x, 2 * y, 1} : Point{dx / reach, dy / reach, 1};
      const double value = first ? x * x + y * y : reach - circle.radius;
      kernels::add_outer_product(squares, row[0], row[1], row[2]);
      right = sum(right, scaled(value, row));
    }
    const kernels::Eigen3 axes = kernels::eigen_decomposition(squares);
    if (!(axes.values[2] > 1e-14 * count)) return std::nullopt;
    Point change{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      change = sum(change, scaled(dot(axes.vectors[axis], right) / axes.values[axis], axes.vectors[axis]));
    if (round == 0) {
      const double squared = change[2] + change[0] * change[0] + change[1] * change[1];
      if (!(squared > 0)) return std::nullopt;
      circle = {change[0], change[1], std::sqrt(squared)};
    } else {
      circle = {circle.x + change[0], circle.y + change[1], circle.radius + change[2]};
    }
    if (!(circle.radius > 0 && circle.radius < largest_radius)) return std::nullopt;
  }
  return circle;
}

/// Angle from the x axis, 0 to 360.
double turn_of(const FittedArc& arc, const Point& p) {
  const Point offset = difference(p, arc.center);
  const double angle =
      kernels::angle_of(dot(offset, cross(arc.normal, arc.x_axis)), dot(offset, arc.x_axis)) * degrees;
  return angle < 0 ? angle + 360 : angle;
}

FittedArc in_space(const Circle& circle, const Plane& plane) {
  FittedArc arc;
  const Point center = sum(scaled(circle.x, plane.x), scaled(circle.y, plane.y));
  arc.center = sum(plane.origin, scaled(plane.unit, center));
  arc.radius = circle.radius * plane.unit;
  arc.normal = unit(cross(plane.x, plane.y));
  arc.x_axis = plane.x;
  return arc;
}

/// The x axis of an arc, to where it starts.
Point axis_towards(const FittedArc& arc, const Point& p) {
  Point offset = difference(p, arc.center);
  offset = difference(offset, scaled(dot(offset, arc.normal), arc.normal));
  return length(offset) > 0 ? unit(offset) : arc.x_axis;
}

std::optional<FittedArc> fit_circle(std::span<const Point> points) {
  Point mean{};
  for (const Point& p : points)
    mean = sum(mean, scaled(1 / static_cast<double>(points.size()), difference(p, points.front())));
  const std::optional<Plane> plane = plane_of(points, sum(points.front(), mean), {});
  if (!plane) return std::nullopt;
  const std::optional<Circle> circle = free_circle(*plane);
  if (!circle) return std::nullopt;
  FittedArc arc = in_space(*circle, *plane);
  arc.x_axis = axis_towards(arc, points.front());
  // As the line runs round.
  if (turn_of(arc, points[points.size() / 3]) > turn_of(arc, points[2 * points.size() / 3]))
    arc.normal = scaled(-1, arc.normal);
  return arc;
}

}  // namespace

std::optional<FittedArc> fit_arc(std::span<const Point> points, bool closed) {
  if (points.size() < 3) return std::nullopt;
  if (closed) return fit_circle(points);
  const Point chord = difference(points.back(), points.front());
  if (length(chord) == 0) return std::nullopt;
  const Point middle = sum(points.front(), scaled(0.5, chord));
  const std::optional<Plane> plane = plane_of(points, middle, unit(chord));
  if (!plane) return std::nullopt;
  const auto circle = circle_through_ends(*plane, 0.5 * length(chord) / plane->unit);
  if (!circle) return std::nullopt;
  FittedArc arc = in_space(*circle, *plane);
  arc.x_axis = axis_towards(arc, points.front());
  if (turn_of(arc, points[points.size() / 2]) > turn_of(arc, points.back()))
    arc.normal = scaled(-1, arc.normal);
  arc.sweep_deg = turn_of(arc, points.back());
  if (!(arc.sweep_deg > 0)) return std::nullopt;
  return arc;
}

Point nearest_on(const FittedArc& arc, const Point& p) {
  const Point y_axis = cross(arc.normal, arc.x_axis);
  const auto end = kernels::sin_cos(kernels::radians(arc.sweep_deg));
  const Point last =
      sum(arc.center, sum(scaled(arc.radius * end.cos, arc.x_axis), scaled(arc.radius * end.sin, y_axis)));
  const Point first = sum(arc.center, scaled(arc.radius, arc.x_axis));
  if (turn_of(arc, p) <= arc.sweep_deg) return sum(arc.center, scaled(arc.radius, axis_towards(arc, p)));
  return distance(p, first) <= distance(p, last) ? first : last;
}

}  // namespace keenline
