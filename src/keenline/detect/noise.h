#pragma once

#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

/// The standard deviation of the points from their surface, as a multiple of the spacing around each: about 0
/// for a clean surface. Read off Gauss maps: noise tilts the triangles of a point by about its ratio to the
/// spacing, so it is the angle within which the densest tenth of a point's lines lies (the birth of its
/// oldest face). Edges and curvature do not add to it, because a tenth of the lines is found on one side of
/// them; nor do thin walls, which fits of a surface to all neighbours take for noise. The lower quartile of
/// that angle over at most 2,048 points, evenly spread over the cloud's order, is 14.4 degrees times the
/// noise for little noise; the curve was measured on planes with normally distributed noise of 0.05 to 0.5
/// spacings and holds there within 15 %; above, the estimate saturates at about twice the spacing. Threads:
/// any number, same bits. Cost: about 0.2 s of one core. \pre the search is that of cloud.positions \throw
/// Cancelled
[[nodiscard]] double estimate_noise(const PointCloud& cloud, const NeighborSearch& search,
                                    Progress& progress = no_progress());

}  // namespace keenline
