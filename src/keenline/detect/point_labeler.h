#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "keenline/detect/faces.h"
#include "keenline/detect/gauss.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/detect/isolated.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct PointCloud;

/// The labels of one point from the sensitivity `from` up to that of the next step.
struct LabelStep {
  std::uint16_t from;
  Kind kind;
  std::uint8_t clusters;
};

/// Everything that the Gauss map of a point says, for all sensitivities at once: see detect_gauss(). Serves
/// one point after the other; every thread has its own.
class PointLabeler {
 public:
  /// All three must outlive it.
  PointLabeler(const PointCloud& cloud, const GaussOptions& options, const Progress& progress);

  /// Afterwards the others are those of the point. \param neighbors nearest first; with fewer than
  /// options.neighbors the point is undecided \throw Cancelled
  void label(std::size_t point, std::span<const std::uint32_t> neighbors);

  /// The first one from 0, then rising; neighbouring steps differ.
  [[nodiscard]] std::span<const LabelStep> steps() const { return steps_; }
  /// Whether it is at any sensitivity what needs_support().
  [[nodiscard]] bool ever_needs_support() const;
  /// Of the two faces that are told apart best.
  [[nodiscard]] CreaseDirection direction() const;
  /// The largest angle at which two significant clusters become one, in degrees.
  [[nodiscard]] float score() const { return score_; }
  /// Lines of a significant cluster.
  [[nodiscard]] int min_cluster() const { return min_cluster_; }
  /// Clustered to the end, whether the label took it or not.
  [[nodiscard]] const GaussMap& clustered_map();

 private:
  struct Change {
    std::uint16_t at;
    int change;
  };

  void look(std::size_t point, std::span<const std::uint32_t> neighbors, int size);
  void combine_views();
  [[nodiscard]] bool is_significant(std::uint32_t size) const {
    return size >= static_cast<std::uint32_t>(min_cluster_);
  }
  [[nodiscard]] float sharpness_deg();
  void count_clusters();
  void push_plain_step(std::uint16_t from, int clusters);
  void read_faces();
  [[nodiscard]] Kind kind_of(std::span<const Face> faces, std::uint16_t sensitivity) const;
  void push_step(const LabelStep& step);

  const PointCloud& cloud_;
  const GaussOptions& options_;
  int max_clusters_;
  std::vector<int> sizes_;
  double persistence_;
  GaussMap map_;
  FaceWorkspace workspace_;
  std::vector<Face> faces_;
  std::vector<Change> changes_;
  std::vector<LabelStep> steps_;
  std::vector<std::vector<LabelStep>> views_;  // the steps at each of sizes_
  int min_cluster_ = 0;
  double sharpness_ = 0;
  float score_ = 0;
  bool is_peak_ = false;
  bool is_beside_ = false;
};

}  // namespace keenline
