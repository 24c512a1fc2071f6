#include "keenline/lines/placed_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "keenline/feature_graph.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/order_statistics.h"

namespace keenline {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// \pre there are points
Point median_of(const std::vector<Point>& positions, const std::vector<std::uint32_t>& points) {
  Point middle{};
  std::vector<double> coordinates(points.size());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), coordinates.begin(),
                   [&](std::uint32_t point) { return positions[point][axis]; });
    middle[axis] = lower_median(coordinates);
  }
  return middle;
}

}  // namespace

PlacedPoints place_points(const PointCloud& cloud, const NeighborSearch& search,
                          const std::vector<bool>& is_chosen, double spacing) {
  PlacedPoints result;
  if (!(spacing > 0) || std::isinf(spacing)) return result;
  std::vector<std::uint32_t> chosen;
  for (std::uint32_t i = 0; i < cloud.size(); ++i)
    if (is_chosen[i] && is_drawable(cloud.positions[i])) chosen.push_back(i);
  if (chosen.empty()) return result;
  result.frame = {median_of(cloud.positions, chosen), spacing};
  const std::vector<std::uint32_t> first_at_place = search.first_coincident();
  std::vector<std::uint32_t> number(cloud.size(), none);  // by the first point at a place
  for (const std::uint32_t point : chosen) {
    const Point position = result.frame.local(cloud.positions[point]);
    if (!is_drawable(position)) continue;
    std::uint32_t& at_place = number[first_at_place[point]];
    if (at_place == none) {
      at_place = static_cast<std::uint32_t>(result.size());
      result.points.push_back(point);
      result.positions.push_back(position);
      result.copies.push_back(0);
    }
    ++result.copies[at_place];
  }
  return result;
}

}  // namespace keenline
