#pragma once

#include "keenline/cloud.h"

namespace keenline {

class NeighborSearch;

/// Spacing h = sqrt(area per point) of a surface where a disc of the radius `farthest` has the `count`
/// nearest of the point in its middle: sqrt(pi r^2 / (count + 1/2)), for the last of them is on the rim, half
/// inside.
[[nodiscard]] double spacing_within(const Point& farthest, std::size_t count);

/// The cloud's typical spacing h = sqrt(area per point), in the cloud's own unit: the median, over all
/// points with at least 3 neighbours, of spacing_within() up to the last of the nearest 16 neighbours, or of
/// as many as there are. 0 when no point has 3 neighbours. The median of an even number is the lower middle.
/// Of more than 131,072 points as many as that, evenly spread over the cloud's order, stand for all.
/// Threads: any number, same bits. \pre the search is that of cloud.positions
[[nodiscard]] double estimate_spacing(const PointCloud& cloud, const NeighborSearch& search);

}  // namespace keenline
