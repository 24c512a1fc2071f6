#include "keenline/lines/rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths are in spacings, so that one point is to be expected on an area of 1.
constexpr double farthest_out = 3;
constexpr double farthest_in = 4;      // deeper points are no part of a rim that is bent no more than
constexpr double largest_bend = 0.06;  // half of 1 / radius: 8
constexpr double shortest = 4;         // of a rim
constexpr double missing_points = 5;   // by chance once in 150 times

using Place = std::array<double, 2>;  // along the rim (y), into the surface (x)

/// x = level + slope (y - middle) + bend (y - middle)².
struct RimCurve {
  double level = 0;
  double slope = 0;
  double bend = 0;
  double mean = 0;  // of x, over the whole length
};

/// Behind what parabola of a given bend the places lie: it touches the edge of their convex hull that is
/// nearest at the middle. \pre places rise
RimCurve touching(const std::vector<Place>& places, double middle, double half_length, double bend) {
  std::vector<Place> hull;
  for (const auto& [along, into] : places) {
    const double y = along - middle;
    const Place place{y, into - bend * y * y};
    const auto is_behind = [&](const Place& a, const Place& b) {
      return (b[0] - a[0]) * (place[1] - a[1]) <= (b[1] - a[1]) * (place[0] - a[0]);
    };
    while (hull.size() > 1 && is_behind(hull[hull.size() - 2], hull.back())) hull.pop_back();
    hull.push_back(place);
  }
  std::size_t end = 1;
  while (end + 1 < hull.size() && hull[end][0] <= 0) ++end;
  const Place& a = hull[end - 1];
  const Place& b = hull[end];
  RimCurve curve{.bend = bend};
  curve.slope = b[0] > a[0] ? (b[1] - a[1]) / (b[0] - a[0]) : 0;
  curve.level = a[1] - curve.slope * a[0];
  curve.mean = curve.level + bend * half_length * half_length / 3;
  return curve;
}

/// The bend that leaves the least area, which is convex in it: by golden sections.
RimCurve least_area(const std::vector<Place>& places, double middle, double half_length) {
  constexpr double golden = 0.61803398874989485;
  const auto with = [&](double bend) { return touching(places, middle, half_length, bend); };
  double low = -largest_bend;
  double high = largest_bend;
  RimCurve left = with(high - golden * (high - low));
  RimCurve right = with(low + golden * (high - low));
  constexpr int sections = 16;  // to a thousandth of the range
  for (int section = 0; section < sections; ++section) {
    if (left.mean > right.mean) {
      high = right.bend;
      right = left;
      left = with(high - golden * (high - low));
    } else {
      low = left.bend;
      left = right;
      right = with(low + golden * (high - low));
    }
  }
  return left.mean > right.mean ? left : right;
}

}  // namespace

std::optional<Side> rim_of(const Side& side, std::span<const Point> offsets) {
  const SideSurface& surface = side.surface;
  const double tolerance = std::max(0.3, 3 * side.residual / surface.spacing);
  std::vector<Place> places;
  for (const Point& q : offsets) {
    const Place place{dot(q, surface.y), dot(q, surface.x)};
    if (place[1] < -farthest_out || place[1] > farthest_in || std::abs(surface.distance(q)) > tolerance)
      continue;
    places.push_back(place);
  }
  if (places.size() < 3) return std::nullopt;
  std::sort(places.begin(), places.end());
  const double length = places.back()[0] - places.front()[0];
  if (length < shortest) return std::nullopt;
  const double middle = places.front()[0] + 0.5 * length;
  RimCurve curve = touching(places, middle, 0.5 * length, 0);
  double parameters = 2;
  const RimCurve bent = least_area(places, middle, 0.5 * length);
  if ((bent.mean - curve.mean) * length > missing_points) {
    curve = bent;
    parameters = 3;
  }
  curve.level -= parameters / length;

  Side rim = side;
  rim.surface.z = scaled(-1, surface.x);
  rim.surface.x = surface.z;
  rim.inward = scaled(-1, surface.z);
  const double level = curve.level - curve.slope * middle + curve.bend * middle * middle;
  rim.surface.height = {-level, 0, -(curve.slope - 2 * curve.bend * middle), -curve.bend, 0, 0};
  return rim;
}

}  // namespace keenline
