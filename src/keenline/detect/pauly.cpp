#include "keenline/detect/pauly.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/detect/local_pca.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/order_statistics.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// As few scales are kept whatever the normal does.
constexpr std::size_t min_scales = 3;

/// The graph in which features grow, and in which a border needs others.
constexpr int graph_neighbors = 16;

/// A sector of 120 degrees is empty by chance at one of 500 points with so many neighbours in the plane; with
/// 16, at one of 30.
constexpr std::size_t gap_neighbors = 24;

void validate(const PaulyOptions& options) {
  require_in_range("smallest_scale", options.smallest_scale, min_neighbors, max_neighbors);
  require_in_range("largest_scale", options.largest_scale, options.smallest_scale, max_neighbors);
  require_in_range("scale_step", options.scale_step, 1, max_neighbors);
  if (options.variation)
    require_option(*options.variation > 0 && *options.variation <= 1.0 / 3, "variation", *options.variation,
                   "more than 0, up to 1/3");
  require_in_range("seed_share", options.seed_share, 0, 1);
  require_in_range("grow_share", options.grow_share, 0, options.seed_share);
  require_in_range("turn_deg", options.turn_deg, 0, 90);
  require_in_range("border_gap_deg", options.border_gap_deg, 0, 360);
}

/// By how much a neighbourhood varies as no two half planes that meet at its middle do. Those have, against
/// the variance along their edge, 1 - t along the bisector of the faces times 1 - 64 / (9 pi^2), if t is what
/// they have across it, for any angle. So this is 0 on planes and edges (below, where the angle is less than
/// 56 degrees) and 0.287 at the corner of a cube.
double corner_excess(const PrincipalComponents& components) {
  constexpr double bisector = 1 - 64 / (9 * kernels::pi * kernels::pi);
  const auto& variance = components.variance;
  if (!(variance[2] > 0)) return 0;
  return variance[0] / variance[2] - bisector * (1 - variance[1] / variance[2]);
}

/// Has it a normal that can be followed from scale to scale? Else the two smaller axes may have changed
/// places.
bool has_normal(const PrincipalComponents& components) {
  const auto& variance = components.variance;
  return variance[1] - variance[0] > 0.1 * variance[2];
}

/// Of one point; nothing has been compared with the limit yet.
struct Summary {
  std::uint8_t scales = 0;  ///< how many were kept; 0: too few neighbours
  bool is_border = false;
  bool is_corner = false;  ///< if it is a feature
  bool is_curved = false;  ///< if it is none
};

class Detector {
 public:
  Detector(const PointCloud& cloud, const NeighborSearch& search, const PaulyOptions& options,
           Progress& progress)
      : positions_(cloud.positions),
        search_(search),
        options_(options),
        progress_(progress),
        cosine_of_turn_(kernels::sin_cos(kernels::radians(options.turn_deg)).cos) {
    for (int scale = options.smallest_scale; scale <= options.largest_scale; scale += options.scale_step)
      scales_.push_back(static_cast<std::size_t>(scale));
    require_memory(cloud.size() * (scales_.size() * sizeof(float) + 20), "surface variation");
    variation_.resize(cloud.size() * scales_.size());
    summary_.resize(cloud.size());
    mean_.resize(cloud.size());
  }

  FeatureLabels run() {
    search_.for_each_block(
        static_cast<int>(scales_.back()),
        [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
          progress_.check();
          Workspace work;
          for (std::size_t i = 0; i < points.size(); ++i) look_at(points[i], neighborhoods.of(i), work);
        },
        progress_);
    const double limit = options_.variation ? *options_.variation : limit_from_cloud();
    const std::vector<bool> feature = grow(limit);
    FeatureLabels labels;
    labels.kind.resize(size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size(), 1024),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        progress_.check();
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          labels.kind[i] = kind_of(static_cast<std::uint32_t>(i), feature);
                      });
    labels.score = std::move(mean_);
    labels.threshold = limit;
    return labels;
  }

 private:
  struct Workspace {
    LocalOffsets local;
    std::vector<double> angles;
  };

  [[nodiscard]] std::size_t size() const { return positions_.size(); }
  [[nodiscard]] std::span<float> variation_of(std::size_t i) {
    return std::span(variation_).subspan(i * scales_.size(), scales_.size());
  }

  /// The limit is not known before all have been looked at.
  void look_at(std::size_t i, std::span<const std::uint32_t> neighbors, Workspace& work) {
    Summary& summary = summary_[i];
    if (neighbors.size() < scales_.front() || !work.local.gather(positions_, i, neighbors)) return;
    const auto offsets = work.local.offsets();
    const std::span<float> variation = variation_of(i);
    GrowingCovariance sums;
    sums.add({});
    PrincipalComponents last;
    std::size_t added = 0;
    double total = 0;
    double excess = 0;
    double weights = 0;
    for (const std::size_t scale : scales_) {
      if (scale > offsets.size()) break;
      for (; added < scale; ++added) sums.add(offsets[added]);
      const PrincipalComponents now = principal_components(sums.covariance());
      if (summary.scales >= min_scales && turns(last, now)) break;
      variation[summary.scales++] = static_cast<float>(surface_variation(now));
      total += surface_variation(now);
      excess += corner_excess(now) * static_cast<double>(scale);  // the more points, the less chance
      weights += static_cast<double>(scale);
      last = now;
    }
    const double kept = summary.scales;
    mean_[i] = static_cast<float>(total / kept);
    // Half of what a cube's corner has, and 0.02 for chance: one edge point in 500 has as much.
    constexpr double least_corner_excess = 0.16;
    summary.is_corner = excess / weights > least_corner_excess;
    // The variation of a curved surface grows with the area of the neighbourhood, that of noise falls with
    // it. A sphere has a thousandth where 48 points cover a cap of 8 degrees.
    const float largest = variation[summary.scales - 1U];
    summary.is_curved = largest > 0.001F && largest > variation[0];
    const auto around = offsets.first(std::min(offsets.size(), gap_neighbors));
    summary.is_border = widest_gap_deg(around, last, work.angles) > options_.border_gap_deg;
  }

  /// Has another sheet come in with the larger scale?
  [[nodiscard]] bool turns(const PrincipalComponents& smaller, const PrincipalComponents& larger) const {
    return std::abs(dot(smaller.axis[0], larger.axis[0])) < cosine_of_turn_ && has_normal(smaller) &&
           has_normal(larger);
  }

  /// Features are few: what the upper fifth has is theirs, or the noise.
  [[nodiscard]] double limit_from_cloud() const {
    std::vector<float> means;
    for (std::size_t i = 0; i < size(); ++i)
      if (summary_[i].scales > 0) means.push_back(mean_[i]);
    constexpr double lowest = 0.01;
    constexpr double highest = 0.08;
    if (means.empty()) return lowest;
    const auto fifth = static_cast<double>(nth_smallest(means, means.size() * 4 / 5));
    constexpr double below = 0.6;
    return std::clamp(below * fifth, lowest, highest);
  }

  /// Share of its scales that speak for the point.
  [[nodiscard]] double persistence(std::size_t i, double limit) {
    const auto kept = variation_of(i).first(summary_[i].scales);
    if (kept.empty()) return 0;
    const auto above =
        std::count_if(kept.begin(), kept.end(), [&](float v) { return static_cast<double>(v) > limit; });
    return static_cast<double>(above) / static_cast<double>(kept.size());
  }

  /// Hysteresis.
  [[nodiscard]] std::vector<bool> grow(double limit) {
    std::vector<bool> may_grow(size());
    std::vector<bool> reached(size());
    std::vector<std::uint32_t> front;
    for (std::uint32_t i = 0; i < size(); ++i) {
      const double share = persistence(i, limit);
      may_grow[i] = share > 0 && share >= options_.grow_share;
      reached[i] = share > 0 && share >= options_.seed_share;
      if (reached[i]) front.push_back(i);
    }
    while (!front.empty()) {
      const std::uint32_t i = front.back();
      front.pop_back();
      if (i % 256 == 0) progress_.check();
      for (const std::uint32_t j : search_.nearest(i, graph_neighbors)) {
        if (!may_grow[j] || reached[j]) continue;
        reached[j] = true;
        front.push_back(j);
      }
    }
    return reached;
  }

  [[nodiscard]] Kind kind_of(std::uint32_t i, const std::vector<bool>& feature) const {
    const Summary& summary = summary_[i];
    if (summary.scales == 0) return Kind::Undecided;
    if (feature[i]) return summary.is_corner ? Kind::Corner : Kind::Edge;
    if (summary.is_border && is_among_borders(i)) return Kind::Border;
    return summary.is_curved ? Kind::Curved : Kind::Flat;
  }

  /// A rim goes on to both sides.
  [[nodiscard]] bool is_among_borders(std::uint32_t i) const {
    const std::vector<std::uint32_t> neighbors = search_.nearest(i, graph_neighbors);
    return std::count_if(neighbors.begin(), neighbors.end(),
                         [&](std::uint32_t j) { return summary_[j].is_border; }) >= 2;
  }

  const std::vector<Point>& positions_;
  const NeighborSearch& search_;
  const PaulyOptions& options_;
  Progress& progress_;
  double cosine_of_turn_;
  std::vector<std::size_t> scales_;
  std::vector<float> variation_;  // point by point, scale by scale
  std::vector<Summary> summary_;
  std::vector<float> mean_;
};

}  // namespace

FeatureLabels detect_pauly(const PointCloud& cloud, const NeighborSearch& search, const PaulyOptions& options,
                           Progress& progress) {
  validate(options);
  progress.begin("pauly", cloud.size());
  return Detector(cloud, search, options, progress).run();
}

}  // namespace keenline
