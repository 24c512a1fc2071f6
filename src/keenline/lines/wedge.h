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

/// Finds creases as what they are, two surfaces that meet: two half-planes fitted to the 40 points around.
///
/// The pair of planes is found without chance: each of the 24 nearest points proposes the plane of itself and
/// its 7 nearest, and the pair that explains most points wins (MSAC: Torr, Zisserman 2000, with every
/// hypothesis tried); then points are assigned and planes refitted by turns (k-planes: Bradley, Mangasarian
/// 2000), weighted so that what is far off, where surfaces have bent away, counts little. It is a crease when
/// both planes end at it, points of both lie beside it, and, where they meet at less than 60 degrees from
/// flat, a kink explains the points better than a smooth surface of as many parameters.
class WedgeTracker : public Tracker {
 public:
  /// What is given must outlive this.
  WedgeTracker(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
               const TraceFrame& frame)
      : cloud_(cloud), search_(search), labels_(labels), frame_(frame) {}

  /// By its number in the cloud.
  [[nodiscard]] std::optional<Foot> find(std::uint32_t point) const override;
  [[nodiscard]] std::optional<Foot> follow(const Foot& from, const Point& expected) const override;

 private:
  const PointCloud& cloud_;
  const NeighborSearch& search_;
  const FeatureLabels& labels_;
  TraceFrame frame_;
};

}  // namespace keenline
