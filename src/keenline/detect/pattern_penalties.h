#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/neighborhood/local_offsets.h"

namespace keenline {

/// How a point says that it lies on no crease, on no corner and on no border: 1, and less the more it may.
/// Gumhold, Wang, MacLeod 2001, "Feature Extraction from Point Clouds", section 3; eigenvalues
/// l0 <= l1 <= l2 are those of the neighbours without the point.
struct PointPenalties {
  /// 2 d / mu^2 times mu, if d is how far the point is from the plane of its neighbours and mu their mean
  /// distance: no penalty but what one is made of. 0 on a plane, 0.90 on an edge of 90 degrees.
  double bend = 0;
  double crease = 1;    ///< max(l1 - l0, |l2 - (l0 + l1)|) / l2
  double corner = 1;    ///< (l2 - l0) / l2
  double border = 1;    ///< |l2 - 2 l1| / l2
  double gap_deg = 0;   ///< widest sector without neighbours, see widest_gap_deg()
  Point direction{};    ///< where a crease or border through the point runs, a unit vector; 0: nowhere
  double distance = 0;  ///< mu, in the cloud's unit
};

/// `local` and `angles` are working memory. Where all neighbours lie in one place every penalty is 1.
[[nodiscard]] PointPenalties point_penalties(const std::vector<Point>& positions, std::size_t point,
                                             std::span<const std::uint32_t> neighbors, LocalOffsets& local,
                                             std::vector<double>& angles);

/// How penalties of points become those of an edge of the neighbour graph.
struct PenaltyRule {
  /// Share of curvature in the penalty of a crease, 0 to 1; the rest is its direction.
  double curvature_share = 0.7;
  /// At this bend and above a point has no penalty for its curvature. More than 0.
  double full_bend = 0.6;
  /// The paper's term for the direction, |crease * cosine to the edge|, which is 0 across a crease too;
  /// otherwise 1 - (1 - crease) * |cosine|.
  bool literal_direction = false;
};

/// 1 - bend / full_bend, at least 0.
[[nodiscard]] double curvature_penalty(const PointPenalties& point, const PenaltyRule& rule);

/// Of the way from p to q along a unit vector, 0 to 2.
[[nodiscard]] double edge_crease_penalty(const PointPenalties& p, const PointPenalties& q, const Point& way,
                                         const PenaltyRule& rule);
[[nodiscard]] double edge_border_penalty(const PointPenalties& p, const PointPenalties& q, const Point& way,
                                         const PenaltyRule& rule);

/// What remains of it for an edge in the best direction: 1 on no crease, 0 at most a sharp one.
[[nodiscard]] double crease_penalty(const PointPenalties& point, const PenaltyRule& rule);

/// The way from one point to another: a unit vector, and how long it is against what is usual there, the mean
/// of both points' distances.
struct Way {
  Point direction{};
  double relative_length = 0;
};

/// The same length either way. \pre the points do not coincide
[[nodiscard]] Way way_between(const std::vector<Point>& positions, std::span<const PointPenalties> penalties,
                              std::uint32_t a, std::uint32_t b, LocalOffsets& local);

}  // namespace keenline
