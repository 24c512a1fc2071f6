#include "keenline/neighborhood/spacing.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/kernels/portable_math.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr int nearest = 16;

/// Says that a point does not count.
constexpr double none = -1;

}  // namespace

double spacing_within(const Point& farthest, std::size_t count) {
  return std::sqrt(dot(farthest, farthest) * (kernels::pi / (static_cast<double>(count) + 0.5)));
}

double estimate_spacing(const PointCloud& cloud, const NeighborSearch& search) {
  constexpr std::size_t largest_sample = 131072;
  const std::size_t step = (cloud.size() + largest_sample - 1) / largest_sample;
  std::vector<double> spacings(step == 0 ? 0 : (cloud.size() + step - 1) / step, none);
  const auto look_at = [&](std::uint32_t point, std::span<const std::uint32_t> neighbors,
                           LocalOffsets& local) {
    if (neighbors.size() < min_neighbors) return;
    if (!local.gather(cloud.positions, point, neighbors.last(1))) return;
    const double spacing = spacing_within(local.offsets()[0], neighbors.size());
    if (is_finite({spacing * local.unit(), 0, 0})) spacings[point / step] = spacing * local.unit();
  };
  if (step == 1) {  // all points: far cheaper in blocks than one by one
    search.for_each_block(nearest,
                          [&](std::span<const std::uint32_t> points, const Neighborhoods& neighbors) {
                            LocalOffsets local;
                            for (std::size_t i = 0; i < points.size(); ++i)
                              look_at(points[i], neighbors.of(i), local);
                          });
  } else {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, spacings.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        LocalOffsets local;
                        for (std::size_t i = range.begin(); i < range.end(); ++i) {
                          const auto point = static_cast<std::uint32_t>(i * step);
                          look_at(point, search.nearest(point, nearest), local);
                        }
                      });
  }
  std::erase(spacings, none);
  return spacings.empty() ? 0 : lower_median(spacings);
}

}  // namespace keenline
