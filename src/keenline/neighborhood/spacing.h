#pragma once

#include "keenline/cloud.h"

namespace keenline {

class NeighborSearch;

/// The cloud's typical spacing h = sqrt(area per point), in the cloud's own unit: the median, over all
/// points with at least 3 neighbours, of sqrt(pi r^2 / (m + 1/2)), where r is the distance of the m-th
/// neighbour and m the number of neighbours up to 16: so many points lie in that disc. 0 when no point has 3
/// neighbours. The median of an even number is the lower middle.
/// Of more than 131,072 points as many as that, evenly spread over the cloud's order, stand for all.
/// Threads: any number, same bits. \pre the search is that of cloud.positions
[[nodiscard]] double estimate_spacing(const PointCloud& cloud, const NeighborSearch& search);

}  // namespace keenline
