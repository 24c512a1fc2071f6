#include "keenline/detect/peak.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/detect/cone.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// A cone has six parameters: fewer points fit too well by chance.
constexpr std::size_t smallest_count = 12;
/// Length of the mean direction to the neighbours. On a plane it is 0.2 by chance; at an apex the cosine of
/// half the opening, and still a third where the nearest sample of a cone of 120 degrees is far off its apex.
constexpr double smallest_mean_direction = 0.3;
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
  std::vector<Point> points{{0, 0, 0}};  // the point itself
  points.insert(points.end(), map.offsets().begin(), map.offsets().end());
  const std::vector<double> weights(points.size(), 1);
  const std::optional<Cone> cone = fitted_cone(points, weights, points[0]);
  if (!cone || !is_pointed(*cone)) return false;
  const double reach = *std::max_element(map.lengths().begin(), map.lengths().end());
  if (!is_nearest_to_apex(map, *cone, reach)) return false;

  const double mean_square = mean_square_off(*cone, points, weights);
  const double largest = largest_residual * reach;
  if (!(mean_square <= largest * largest * cone->squared_sine()) || !encloses_axis(*cone, points))
    return false;
  return mean_square <= largest_ratio * largest_ratio * mean_square_off_paraboloid(*cone, points, weights);
}

}  // namespace keenline
