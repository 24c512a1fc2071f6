#include "keenline/detect/pattern_penalties.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keenline/detect/local_pca.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// Squared width of what is a place, against the squared distance of the neighbours.
constexpr double smallest_variance = 1e-24;

double direction_penalty(double penalty, const Point& direction, const Point& way, const PenaltyRule& rule) {
  const double cosine = std::abs(dot(direction, way));
  return rule.literal_direction ? penalty * cosine : 1 - (1 - penalty) * cosine;
}

}  // namespace

PointPenalties point_penalties(const std::vector<Point>& positions, std::size_t point,
                               std::span<const std::uint32_t> neighbors, LocalOffsets& local,
                               std::vector<double>& angles) {
  PointPenalties result;
  if (!local.gather(positions, point, neighbors)) return result;
  GrowingCovariance sums;
  double distances = 0;
  for (const Point& offset : local.offsets()) {
    sums.add(offset);
    distances += length(offset);
  }
  const double mean_distance = distances / static_cast<double>(neighbors.size());
  result.distance = mean_distance * local.unit();
  const PrincipalComponents components = principal_components(sums.covariance());
  const auto& [l0, l1, l2] = components.variance;
  if (l2 <= smallest_variance) return result;
  result.bend = 2 * std::abs(dot(sums.mean(), components.axis[0])) / mean_distance;
  result.crease = std::max(l1 - l0, std::abs(l2 - (l0 + l1))) / l2;
  result.corner = (l2 - l0) / l2;
  result.border = std::abs(l2 - 2 * l1) / l2;
  result.gap_deg = widest_gap_deg(local.offsets(), components, angles);
  result.direction = components.axis[2];
  return result;
}

double curvature_penalty(const PointPenalties& point, const PenaltyRule& rule) {
  return std::max(0.0, 1 - point.bend / rule.full_bend);
}

double edge_crease_penalty(const PointPenalties& p, const PointPenalties& q, const Point& way,
                           const PenaltyRule& rule) {
  const auto line = [&](const PointPenalties& point) {
    return std::min(direction_penalty(point.crease, point.direction, way, rule), point.corner);
  };
  return rule.curvature_share * (curvature_penalty(p, rule) + curvature_penalty(q, rule)) +
         (1 - rule.curvature_share) * (line(p) + line(q));
}

double crease_penalty(const PointPenalties& point, const PenaltyRule& rule) {
  return rule.curvature_share * curvature_penalty(point, rule) +
         (1 - rule.curvature_share) * std::min(point.crease, point.corner);
}

double edge_border_penalty(const PointPenalties& p, const PointPenalties& q, const Point& way,
                           const PenaltyRule& rule) {
  constexpr double gap_share = 0.5;
  const auto gap = [](const PointPenalties& point) { return 1 - point.gap_deg / 360; };
  const auto line = [&](const PointPenalties& point) {
    return direction_penalty(point.border, point.direction, way, rule);
  };
  return gap_share * (gap(p) + gap(q)) + (1 - gap_share) * (line(p) + line(q));
}

Way way_between(const std::vector<Point>& positions, std::span<const PointPenalties> penalties,
                std::uint32_t a, std::uint32_t b, LocalOffsets& local) {
  const auto [from, to] = std::minmax(a, b);
  const std::array<std::uint32_t, 1> target{to};
  if (!local.gather(positions, from, target)) return {};
  const Point& offset = local.offsets().front();
  const double usual =
      penalties[from].distance * local.per_unit() + penalties[to].distance * local.per_unit();
  return {unit(offset), usual > 0 ? 2 * length(offset) / usual : 0};
}

}  // namespace keenline
