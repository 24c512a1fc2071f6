#pragma once

#include <cstdint>
#include <vector>

#include "keenline/synth/sampling.h"

namespace keenline::synth {

struct Scan {
  std::vector<Sample> samples;  ///< by station, scan line and ray
  std::vector<Vec3> stations;
};

/// What six scanners see that stand around the shape in directions drawn by `seed`, three bounding radii from
/// its middle. Each turns through equal angles, its lines twice as far apart as the points along a line, and
/// keeps of every ray the first hit. The angle is set so that about `count` rays hit.
[[nodiscard]] Scan scan(const Shape& shape, std::size_t count, std::uint64_t seed, Progress& progress);

}  // namespace keenline::synth
