#pragma once

#include <cstdint>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct Neighborhoods;

/// Where the crease runs that a point lies on: a vector of length 127 up to rounding and sign; 0 = unknown.
struct CreaseDirection {
  std::int8_t x = 0;
  std::int8_t y = 0;
  std::int8_t z = 0;
};

/// \param direction of length 1
[[nodiscard]] CreaseDirection quantized(const Point& direction);

/// So many of the nearest neighbours are asked for support.
inline constexpr std::size_t neighbors_that_support = 16;

/// Whether a point of this kind is to have others beside it; a peak stands by itself.
[[nodiscard]] constexpr bool needs_support(Kind kind) {
  return (is_feature(kind) && kind != Kind::Peak) || kind == Kind::Border;
}

/// The paper's filter of isolated candidates: a sharp point with fewer than `min_support` sharp points among
/// its 16 nearest neighbours becomes curved, unless it is a peak; a border with fewer border points among
/// them becomes flat. Of two points on a crease only those count that continue it: the way from one to the
/// other is within 35 degrees of the directions of both, as far as they are known; corners have none. For
/// every sensitivity at once, so that the labels of the result at one of them are those that filtering at
/// that sensitivity would give. Neighbours count as they were before the filter; those of points that never
/// need support may be left out. Threads: any number, same result. Cost: O(sharp points).
/// \pre neighborhoods.size() == spectrum.size() == directions.size() == positions.size()
/// \throw Cancelled
[[nodiscard]] LabelSpectrum without_isolated(const LabelSpectrum& spectrum,
                                             const Neighborhoods& neighborhoods,
                                             const std::vector<Point>& positions,
                                             const std::vector<CreaseDirection>& directions, int min_support,
                                             Progress& progress = no_progress());

}  // namespace keenline
