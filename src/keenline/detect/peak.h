#pragma once

namespace keenline {

class GaussMap;

/// Is the point the sample of a peak, a sharp point on no edge, such as the apex of a cone?
///
/// The lines of an apex gather in chance clusters, and no count of clusters tells it from curvature. What
/// tells it is where the surface's tangents go: on a cone all of them pass through one point, the apex, and
/// from there every point of the surface is seen at the same angle to one axis, however far it lies. A
/// smooth surface falls away from its tangent plane as the square of the distance instead, and a corner
/// of plane faces is seen at different angles along its edges and between them. So a circular cone, whose
/// apex need not be a point of the cloud, is fitted to the point and its neighbours. The point is a peak when
/// the cone fits far better than the smooth surface of as many parameters, a paraboloid, is not nearly
/// flat, encloses its axis on all sides, and no neighbour is closer to its apex than the point.
///
/// Found are openings up to about 130 degrees, with noise up to about 0.02 spacings; above, a cone cannot be
/// told from a corner of five faces by 16 neighbours. With fewer than 12 neighbours nothing is a peak.
/// Needs no lines and no clusters: only GaussMap::offsets() and lengths(). Cost: O(k), and a few sums where
/// the neighbours do not lie to one side; O(k^2) at a peak. With + - * / and square roots only.
[[nodiscard]] bool is_peak(const GaussMap& map);

}  // namespace keenline
