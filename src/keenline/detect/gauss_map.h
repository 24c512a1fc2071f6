#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/kernels/average_linkage.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/progress.h"

namespace keenline {

/// The Gauss map of one point: the lines through the triangles (p, q_i, q_j) of the point and two of its
/// neighbours, and their average-linkage dendrogram. Owns the working memory, so that one object serves many
/// points, one after the other; every thread has its own.
class GaussMap {
 public:
  /// Lines whose triangle's sine at the point is below `min_sine` are left out, and those of triangles that
  /// are worse shaped than so many others, see kernels::triangle_shapes(), unless `triangles` is empty.
  /// `progress` is asked whether to stop in the midst of long clusterings.
  GaussMap(double min_sine, const Progress& progress, std::optional<int> triangles = {})
      : min_sine_(min_sine), triangles_(triangles), progress_(&progress) {}

  /// Collects the lines of point p. Offsets are taken in double precision and scaled by a power of two, so
  /// that neither large coordinates nor tiny or huge shapes lose anything.
  void collect(const std::vector<Point>& positions, const Point& p, std::span<const std::uint32_t> neighbors);

  /// No lines, no merges.
  void clear();

  /// Clusters the collected lines, until one cluster has `rest` of them and less are outside: what is left
  /// out makes or takes in no other cluster of so many. \pre lines().count >= 1 \throw Cancelled
  void cluster(int rest = 1);

  [[nodiscard]] kernels::Lines lines() const {
    return {x_.data(), y_.data(), z_.data(), static_cast<int>(x_.size())};
  }
  /// After cluster(): each after those that it consists of; lines().count - 1 where rest was 1.
  [[nodiscard]] std::span<const kernels::Merge> merges() const { return merges_; }
  /// q - p of every neighbour, scaled.
  [[nodiscard]] std::span<const Point> offsets() const { return offsets_; }
  /// |q - p|, scaled alike.
  [[nodiscard]] std::span<const double> lengths() const { return lengths_; }
  /// The direction around which the collected lines gather: dominant eigenvector of the sum of n nᵀ.
  [[nodiscard]] Point common_direction() const;

  /// Bytes that clustering the lines of that many neighbours takes.
  [[nodiscard]] static std::uint64_t memory(int neighbors);

 private:
  double gather_offsets(const std::vector<Point>& positions, const Point& p,
                        std::span<const std::uint32_t> neighbors, double factor);
  void find_lines();
  template <typename Sum>
  void cluster(std::vector<Sum>& sums, int rest);

  double min_sine_;
  std::optional<int> triangles_;
  const Progress* progress_;
  std::vector<Point> offsets_;
  std::vector<double> lengths_;
  std::vector<std::uint8_t> shapes_;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> sums32_;
  std::vector<std::uint64_t> sums64_;
  std::vector<kernels::Merge> merges_;
  kernels::LinkageWorkspace workspace_;
};

}  // namespace keenline
