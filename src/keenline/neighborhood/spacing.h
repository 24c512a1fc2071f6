#pragma once

#include "keenline/cloud.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {

/// The cloud's typical spacing h = sqrt(area per point), in the cloud's own unit: the median, over all
/// points with at least 3 neighbours, of sqrt(pi r^2 / (m + 1/2)), where r is the distance of the m-th
/// neighbour and m the number of neighbours up to 16: so many points lie in that disc. 0 when no point has 3
/// neighbours. The median of an even number is the lower middle.
/// Threads: any number, same bits. Cost: O(n). Memory: 8 bytes per point.
/// \pre neighborhoods were found in this cloud
/// \throw InvalidArgument unless neighborhoods.size() == cloud.size(); OutOfMemory.
[[nodiscard]] double estimate_spacing(const PointCloud& cloud, const Neighborhoods& neighborhoods);

}  // namespace keenline
