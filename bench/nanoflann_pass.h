#pragma once

#include <cstdint>
#include <vector>

namespace keenline {
struct PointCloud;
}

namespace keenline::bench {

/// The neighbours of every point by nanoflann alone, in the order of the file: tree over single precision
/// about the first point, then one search per point. The table, so that nothing is optimised away: count + 1
/// of each, because a point finds itself too.
std::vector<std::uint32_t> nanoflann_pass(const PointCloud& cloud, int count);

}  // namespace keenline::bench
