#include "keenline/detect/demarsin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/detect/segments.h"
#include "keenline/detect/span_space.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

void require_usable(const DemarsinOptions& options) {
  require_in_range("normal_neighbors", options.normal_neighbors, min_neighbors, max_neighbors);
  require_in_range("region_neighbors", options.region_neighbors, min_neighbors, max_neighbors);
  if (options.segment_angle_deg) require_in_range("segment_angle_deg", *options.segment_angle_deg, 1, 45);
  require_in_range("min_patch", options.min_patch, 1, std::numeric_limits<double>::infinity());
}

/// What patches a point sees around it.
class View {
 public:
  View(const Segments& segments, int min_patch) : segments_(segments), min_patch_(min_patch) {}

  [[nodiscard]] bool is_in_patch(std::uint32_t point) const {
    return segments_.interior[segments_.segment[point]] >= static_cast<std::uint32_t>(min_patch_);
  }

  /// Edge, corner, or curved where it sees less than two directions.
  Kind kind_seen(std::span<const std::uint32_t> neighbors) {
    directions_.clear();
    bool is_corner = false;
    for (std::size_t i = 0; i < neighbors.size(); ++i) {
      if (!is_in_patch(neighbors[i])) continue;
      const bool is_new = add(segments_.normals[neighbors[i]]);
      is_corner = is_corner || (is_new && i < neighbors_at_corner && directions_.size() > 2 && span_space());
    }
    if (is_corner) return Kind::Corner;
    return directions_.size() > 1 ? Kind::Edge : Kind::Curved;
  }

 private:
  bool add(const Point& normal) {
    constexpr double cosine = 0.98480775301220802;  // 10 degrees
    for (const Point& direction : directions_)
      if (std::abs(dot(direction, normal)) >= cosine) return false;
    directions_.push_back(normal);
    return true;
  }

  [[nodiscard]] bool span_space() const {
    kernels::Symmetric3 tensor;
    for (const Point& direction : directions_) kernels::add_square(tensor, direction, 1);
    return normals_span_space(tensor);
  }

  static constexpr std::size_t neighbors_at_corner = 28;  // three spacings

  const Segments& segments_;
  int min_patch_;
  std::vector<Point> directions_;  // a normal of each that is seen, the nearest's first
};

Kind kind_of(const Segments& segments, View& view, std::uint32_t point, const NeighborSearch& search) {
  if (segments.normals[point] == Point{0, 0, 0}) return Kind::Undecided;
  if (!view.is_in_patch(point)) return view.kind_seen(search.nearest(point, demarsin_view));
  const bool is_flat = static_cast<double>(segments.bend_deg[point]) <= 0.5 * segments.angle_deg;
  return is_flat ? Kind::Flat : Kind::Curved;
}

}  // namespace

FeatureLabels detect_demarsin(const PointCloud& cloud, const NeighborSearch& search,
                              const DemarsinOptions& options, Progress& progress) {
  require_usable(options);
  // Normal, bend, label, the order and extent of regions; the table of neighbours.
  const std::uint64_t bytes_per_point =
      60 + sizeof(std::uint32_t) * static_cast<std::uint64_t>(options.region_neighbors);
  require_memory(cloud.size() * bytes_per_point, "segmentation by normals");
  progress.begin("demarsin", 3 * cloud.size());
  Segments segments = segment_by_normals(
      cloud.positions, search,
      {options.normal_neighbors, options.region_neighbors, options.segment_angle_deg}, progress);
  FeatureLabels labels;
  labels.kind.resize(cloud.size(), Kind::Undecided);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      View view(segments, options.min_patch);
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        labels.kind[i] = kind_of(segments, view, static_cast<std::uint32_t>(i), search);
                      progress.advance(range.size());
                    });
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (labels.kind[i] == Kind::Undecided) segments.bend_deg[i] = 0;
  labels.threshold = segments.angle_deg;
  labels.score = std::move(segments.bend_deg);
  return labels;
}

}  // namespace keenline
