#include "keenline/lines/rim_tracker.h"

#include <algorithm>
#include <cmath>

#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths in spacings of the points around.
constexpr int window_size = 12;  // a border point every spacing: six to each side
constexpr int surface_neighbors = 24;
constexpr double reach = 5;  // of what counts
constexpr int least_points = 4;
constexpr double largest_shift = 1;    // from where the rim was expected
constexpr double largest_gap = 2.5;    // from a place on the rim to a border point
constexpr int points_beside_rim = 41;  // half of a disc of radius 5
constexpr double open_reach = 3.5;     // so far all that lies further out is among them
/// Squared width per squared length of what is still a line: the two sides of a right angle have 0.25 seen
/// from the middle, less from aside, an arc 0.07 where it turns by two radians.
constexpr double roundest = 0.1;

std::vector<std::uint32_t> border_points(const PointCloud& cloud, const FeatureLabels& labels) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (labels.kind[i] == Kind::Border && is_drawable(cloud.positions[i])) points.push_back(i);
  return points;
}

std::vector<Point> positions_of(const std::vector<std::uint32_t>& points, const PointCloud& cloud) {
  std::vector<Point> positions;
  positions.reserve(points.size());
  for (const std::uint32_t i : points) positions.push_back(cloud.positions[i]);
  return positions;
}

/// The surface around a border point.
struct Surface {
  std::vector<Point> offsets;  // of its neighbours, in spacings of the points around
  Point normal{};
  double spacing = 0;  // in the unit of the cloud
};

std::optional<Surface> surface_at(std::uint32_t point, const PointCloud& cloud,
                                  const NeighborSearch& search) {
  const auto neighbors = search.nearest(point, surface_neighbors);
  LocalOffsets local;
  if (neighbors.size() < surface_neighbors || !local.gather(cloud.positions, point, neighbors))
    return std::nullopt;
  Surface surface;
  surface.normal = kernels::eigen_decomposition(scatter_of(local.offsets())).vectors[2];
  const double spacing = length(local.offsets().back()) * std::sqrt(kernels::pi / (surface_neighbors + 0.5));
  for (const Point& offset : local.offsets()) surface.offsets.push_back(scaled(1 / spacing, offset));
  surface.spacing = spacing * local.unit();
  return surface;
}

/// Within 60 degrees of a direction or its opposite?
bool is_along(const Point& direction, const Point& way) {
  constexpr double squared_cosine = 0.25;
  const double along = dot(direction, way);
  return along * along > squared_cosine * dot(way, way);
}

/// Does the surface end at the line through `foot`, given relative to its middle? 1 if it lies behind it,
/// seen along `across`, -1 if ahead, and 0 where it goes on or is but a line of points.
int end_at(const Surface& surface, const Point& foot, const Point& across) {
  constexpr double clear = 0.75;  // from the rim; noise and bends carry points past it
  constexpr int most_past = 1;
  constexpr int fewest_inside = 6;
  int positive = 0;
  int negative = 0;
  for (const Point& offset : surface.offsets) {
    const Point way = difference(offset, foot);
    const double v = dot(across, way);
    // Beside the way out the rim of a hole comes back.
    if (std::abs(v) < clear || !is_along(across, way)) continue;
    ++(v > 0 ? positive : negative);
  }
  if (std::min(positive, negative) > most_past || std::max(positive, negative) < fewest_inside) return 0;
  return positive < negative ? 1 : -1;
}

/// Is there no place farther out, within 60 degrees of the way out at a foot?
bool is_open(const Point& place, const std::vector<Point>& places, const Foot& from) {
  return std::none_of(places.begin(), places.end(), [&](const Point& other) {
    const Point way = difference(other, place);
    return dot(from.normals[1], way) > 0 && is_along(from.normals[1], way);
  });
}

}  // namespace

RimTracker::RimTracker(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                       const TraceFrame& frame, const Progress& progress)
    : cloud_(cloud),
      search_(search),
      frame_(frame),
      points_(border_points(cloud, labels)),
      positions_(positions_of(points_, cloud)),
      rim_search_(positions_, progress) {}

std::vector<Point> RimTracker::labelled_around(const Point& expected) const {
  std::vector<Point> rim;
  rim.reserve(window_size);
  for (const std::uint32_t q : rim_search_.nearest_to(frame_.global(expected), window_size))
    rim.push_back(frame_.local(positions_[q]));
  return rim;
}

std::optional<Foot> RimTracker::find(std::uint32_t border_point) const {
  const Point expected = frame_.local(positions_[border_point]);
  return fit(points_[border_point], expected, labelled_around(expected));
}

std::optional<Foot> RimTracker::follow(const Foot& from, const Point& expected) const {
  const auto nearest = rim_search_.nearest_to(frame_.global(expected), 1);
  if (nearest.empty()) return std::nullopt;
  std::optional<Foot> foot = fit(points_[nearest[0]], expected, labelled_around(expected));
  if (!foot) foot = follow_unlabelled(from, expected);
  if (foot && dot(foot->tangent, from.tangent) < 0) foot->tangent = scaled(-1, foot->tangent);
  return foot;
}

std::optional<Foot> RimTracker::follow_unlabelled(const Foot& from, const Point& expected) const {
  const auto around = search_.nearest_to(frame_.global(expected), points_beside_rim);
  if (around.empty()) return std::nullopt;
  std::vector<Point> places;
  places.reserve(around.size());
  for (const std::uint32_t q : around) places.push_back(frame_.local(cloud_.positions[q]));
  std::vector<Point> rim;
  bool goes_on = false;
  for (const Point& place : places) {
    const Point way = difference(place, expected);
    if (length(way) > open_reach * from.scale || !is_open(place, places, from)) continue;
    rim.push_back(place);
    goes_on = goes_on || dot(way, from.tangent) > 0;
  }
  if (!goes_on) return std::nullopt;
  return fit(around[0], expected, rim);
}

std::optional<Foot> RimTracker::fit(std::uint32_t point, const Point& expected,
                                    const std::vector<Point>& rim) const {
  const auto surface = surface_at(point, cloud_, search_);
  if (!surface) return std::nullopt;
  const double scale = surface->spacing / frame_.spacing;
  double weights = 0;
  int count = 0;
  double gap = reach;
  Point mean{};
  kernels::Symmetric3 scatter;
  for (const Point& place : rim) {
    const Point d = scaled(1 / scale, difference(place, expected));
    const double r = dot(d, d) / (reach * reach);
    if (r >= 1) continue;
    const double w = (1 - r) * (1 - r);
    ++count;
    weights += w;
    mean = sum(mean, scaled(w, d));
    add_square(scatter, d, w);
    gap = std::min(gap, length(d));
  }
  if (count < least_points || gap > largest_gap) return std::nullopt;
  mean = scaled(1 / weights, mean);
  add_square(scatter, mean, -weights);
  const kernels::Eigen3 eigen = kernels::eigen_decomposition(scatter);
  if (!(eigen.values[0] > 0) || eigen.values[1] > roundest * eigen.values[0]) return std::nullopt;
  Foot foot;
  foot.tangent = eigen.vectors[0];
  const Point shift = difference(mean, scaled(dot(mean, foot.tangent), foot.tangent));
  if (length(shift) > largest_shift) return std::nullopt;
  foot.position = sum(expected, scaled(scale, shift));
  const Point outward = cross(foot.tangent, surface->normal);
  if (!(length(outward) > 0.5)) return std::nullopt;  // the line leaves the surface
  foot.normals[1] = unit(outward);
  foot.normals[0] = cross(foot.normals[1], foot.tangent);
  foot.scale = scale;
  const Point from_middle =
      scaled(1 / scale, difference(foot.position, frame_.local(cloud_.positions[point])));
  const int out = end_at(*surface, from_middle, foot.normals[1]);
  if (out == 0) return std::nullopt;
  foot.normals[1] = scaled(out, foot.normals[1]);
  foot.quality = 1 - eigen.values[1] / eigen.values[0];
  foot.is_backed = true;
  return foot;
}

}  // namespace keenline
