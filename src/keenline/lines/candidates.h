#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

/// The points of a cloud that lines are made of: edges and corners, whoever labelled them. Positions are in
/// spacings about one of them: small numbers, however far from the origin the cloud lies.
class Candidates {
 public:
  /// None where the spacing is not more than 0. Points beyond largest_graph_number have no place in a
  /// drawing. \throw InvalidArgument unless labels.size() == cloud.size(); Cancelled
  Candidates(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
             double spacing, const Progress& progress);

  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /// Their numbers in the cloud, rising.
  [[nodiscard]] const std::vector<std::uint32_t>& points() const { return points_; }
  [[nodiscard]] const std::vector<Point>& positions() const { return positions_; }
  /// Those among the nearest 64 points of the cloud, which are about 4.5 spacings around; nearest first.
  [[nodiscard]] std::span<const std::uint32_t> near(std::size_t candidate) const {
    return std::span(near_).subspan(offsets_[candidate], offsets_[candidate + 1] - offsets_[candidate]);
  }
  /// Where a position in spacings is in the cloud.
  [[nodiscard]] Point in_cloud(const Point& position) const;

 private:
  std::vector<std::uint32_t> points_;
  std::vector<Point> positions_;
  std::vector<std::size_t> offsets_{0};
  std::vector<std::uint32_t> near_;
  Point origin_{};
  double spacing_;
};

/// Positions drawn together across the line that they lie along, by what is near them and within `radius`:
/// a band becomes a line. Done `rounds` times. Where lines meet positions stay, at a bend they move inwards.
[[nodiscard]] std::vector<Point> contracted(const Candidates& candidates, double radius, int rounds);

/// Candidates at one place.
struct CandidateClusters {
  std::vector<std::uint32_t> cluster;  ///< of every candidate
  std::vector<Point> centroids;        ///< of the positions given
  std::vector<std::uint32_t> sizes;
};

/// Every candidate that is in no cluster yet, in the order of falling scores, takes all those near it and
/// within `radius` that are in none either. \pre positions and scores are those of the candidates
[[nodiscard]] CandidateClusters cluster(const Candidates& candidates, std::span<const Point> positions,
                                        std::span<const float> scores, double radius);

}  // namespace keenline
