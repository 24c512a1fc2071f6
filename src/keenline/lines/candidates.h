#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"
#include "keenline/lines/placed_points.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// The points of a cloud that lines are made of: edges and corners, whoever labelled them, see
/// place_points().
class Candidates {
 public:
  /// Memory: 600 bytes per candidate, 300 of them to stay; 8 per point of the cloud meanwhile.
  /// \throw InvalidArgument unless labels.size() == cloud.size(); OutOfMemory; Cancelled
  Candidates(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
             double spacing, const Progress& progress);

  [[nodiscard]] std::size_t size() const { return placed_.size(); }
  /// Their numbers in the cloud, rising.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return placed_.points; }
  [[nodiscard]] const std::vector<Point>& positions() const { return placed_.positions; }
  /// So many points lie at each place.
  [[nodiscard]] const std::vector<std::uint32_t>& copies() const { return placed_.copies; }
  /// Those among the nearest 64 points of the cloud, which are about 4.5 spacings around; nearest first.
  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t candidate) const {
    return std::span(near_).subspan(offsets_[candidate], offsets_[candidate + 1] - offsets_[candidate]);
  }
  /// Where a position in spacings is in the cloud.
  [[nodiscard]] Point in_cloud(const Point& position) const { return placed_.frame.global(position); }

 private:
  PlacedPoints placed_;
  std::vector<std::size_t> offsets_{0};
  std::vector<std::uint32_t> near_;
};

/// Positions drawn together across the line that they lie along, by what is near them and within `radius`:
/// a band becomes a line. Done `rounds` times. Where lines meet positions stay, at a bend they move inwards.
[[nodiscard]] std::vector<Point> contracted(const Candidates& candidates, double radius, int rounds);

/// Candidates at one place.
struct CandidateClusters {
  std::vector<std::uint32_t> cluster;  ///< of every candidate
  std::vector<Point> centroids;        ///< of the positions given
  std::vector<std::uint32_t> sizes;    ///< in points of the cloud
};

/// Every candidate that is in no cluster yet, in the order of falling scores, takes all those near it and
/// within `radius` that are in none either. \pre positions and scores are those of the candidates
[[nodiscard]] CandidateClusters cluster(const Candidates& candidates, std::span<const Point> positions,
                                        std::span<const float> scores, double radius);

}  // namespace keenline
