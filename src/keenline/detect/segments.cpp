#include "keenline/detect/segments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr Point no_normal{0, 0, 0};
constexpr std::uint32_t no_segment = std::numeric_limits<std::uint32_t>::max();

class Segmentation {
 public:
  Segmentation(const std::vector<Point>& positions, const NeighborSearch& search,
               const SegmentOptions& options, Progress& progress)
      : positions_(positions), search_(search), options_(options), progress_(progress) {}

  Segments run() {
    find_normals();
    neighborhoods_ = search_.all(options_.region_neighbors, progress_);
    measure_bends();
    result_.angle_deg = options_.angle_deg.value_or(usual_angle_deg());
    grow_regions();
    count_interiors();
    return std::move(result_);
  }

 private:
  void find_normals() {
    result_.normals.assign(positions_.size(), no_normal);
    search_.for_each_block(
        options_.normal_neighbors,
        [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
          LocalOffsets workspace;
          for (std::size_t i = 0; i < points.size(); ++i)
            result_.normals[points[i]] = plane_normal(positions_, points[i], neighborhoods.of(i), workspace);
        },
        progress_);
  }

  void measure_bends() {
    result_.bend_deg.resize(positions_.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions_.size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        progress_.check();
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          result_.bend_deg[i] = bend_deg(i);
                      });
  }

  [[nodiscard]] float bend_deg(std::size_t point) const {
    const Point& normal = result_.normals[point];
    double largest = 0;
    for (const std::uint32_t neighbor : neighborhoods_.of(point)) {
      const Point& other = result_.normals[neighbor];
      // Exact for small angles, where the cosine tells nothing.
      const double angle = kernels::angle_of(length(cross(normal, other)), std::abs(dot(normal, other)));
      largest = std::max(largest, angle);
    }
    return static_cast<float>(largest * (180 / kernels::pi));
  }

  [[nodiscard]] double usual_angle_deg() const {
    if (result_.bend_deg.empty()) return 5;
    std::vector<float> bends = result_.bend_deg;
    return std::clamp<double>(3 * static_cast<double>(median(bends)), 5, 10);
  }

  void grow_regions() {
    std::vector<std::uint32_t> seeds(positions_.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
      return result_.bend_deg[a] < result_.bend_deg[b];
    });
    const double smallest_cosine = kernels::sin_cos(kernels::radians(result_.angle_deg)).cos;
    std::vector<std::uint32_t>& segment = result_.segment;
    segment.assign(positions_.size(), no_segment);
    std::vector<std::uint32_t> region;
    std::uint32_t count = 0;
    for (const std::uint32_t seed : seeds) {
      if (segment[seed] != no_segment) continue;
      progress_.check();
      segment[seed] = count;
      region.assign(1, seed);
      for (std::size_t next = 0; next < region.size(); ++next) {
        if (next % 4096 == 0) progress_.check();
        const Point& normal = result_.normals[region[next]];
        for (const std::uint32_t neighbor : neighborhoods_.of(region[next])) {
          // The cosine with a missing normal is 0.
          const bool continues = std::abs(dot(normal, result_.normals[neighbor])) >= smallest_cosine;
          if (segment[neighbor] != no_segment || !continues) continue;
          segment[neighbor] = count;
          region.push_back(neighbor);
        }
      }
      ++count;
    }
    result_.interior.assign(count, 0);
  }

  void count_interiors() {
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      const std::uint32_t own = result_.segment[i];
      const auto neighbors = neighborhoods_.of(i);
      const bool inside =
          !neighbors.empty() && std::all_of(neighbors.begin(), neighbors.end(), [&](std::uint32_t neighbor) {
            return result_.segment[neighbor] == own;
          });
      result_.interior[own] += inside ? 1U : 0U;
    }
  }

  const std::vector<Point>& positions_;
  const NeighborSearch& search_;
  const SegmentOptions& options_;
  Progress& progress_;
  Neighborhoods neighborhoods_;  // that regions grow to
  Segments result_;
};

}  // namespace

Point plane_normal(const std::vector<Point>& positions, std::size_t point,
                   std::span<const std::uint32_t> neighbors, LocalOffsets& workspace) {
  if (neighbors.size() < min_neighbors || !workspace.gather(positions, point, neighbors)) return no_normal;
  const kernels::Eigen3 axes = kernels::eigen_decomposition(scatter_of(workspace.offsets()));
  constexpr double thinnest = 1e-6;  // of a row of points: squared width against squared length
  return axes.values[1] > thinnest * axes.values[0] ? axes.vectors[2] : no_normal;
}

Segments segment_by_normals(const std::vector<Point>& positions, const NeighborSearch& search,
                            const SegmentOptions& options, Progress& progress) {
  return Segmentation(positions, search, options, progress).run();
}

}  // namespace keenline
