#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"
#include "keenline/lines/foot.h"
#include "keenline/lines/tracker.h"
#include "keenline/neighborhood/neighbor_search.h"

namespace keenline {

/// Finds the rim of an open surface among the points that the detector took for border: a straight line
/// fitted to the 12 of them around. Its planes are that of the surface and the one that ends it. Where the
/// detector left a gap the rim goes on along points that have no other within 60 degrees of the way out, as
/// long as there are some ahead.
class RimTracker : public Tracker {
 public:
  /// What is given must outlive this. \throw OutOfMemory; Cancelled
  RimTracker(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
             const TraceFrame& frame, const Progress& progress);

  /// How many border points there are.
  [[nodiscard]] std::size_t size() const { return points_.size(); }

  /// The rim near a border point, by its number among them in the order of the cloud: not the cloud's own.
  /// \pre border_point < size()
  [[nodiscard]] std::optional<Foot> find(std::uint32_t border_point) const override;
  [[nodiscard]] std::optional<Foot> follow(const Foot& from, const Point& expected) const override;

 private:
  /// The line through places on the rim, given in the frame; `point` is one of the cloud nearby.
  [[nodiscard]] std::optional<Foot> fit(std::uint32_t point, const Point& expected,
                                        const std::vector<Point>& rim) const;
  /// Border points.
  [[nodiscard]] std::vector<Point> labelled_around(const Point& expected) const;
  [[nodiscard]] std::optional<Foot> follow_unlabelled(const Foot& from, const Point& expected) const;

  const PointCloud& cloud_;
  const NeighborSearch& search_;
  TraceFrame frame_;
  std::vector<std::uint32_t> points_;  // of the cloud
  std::vector<Point> positions_;
  NeighborSearch rim_search_;
};

}  // namespace keenline
