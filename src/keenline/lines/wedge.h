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

/// How much of a cloud is seen at once, and how sharply.
struct WedgeView {
  int points = 41;               ///< of a window: a radius of 3.6 units, some 20 on each side of a crease
  int points_of_hypothesis = 8;  ///< nearest to one of them, that propose a plane: a radius of 1.6
  double unit = 1;               ///< of all lengths, in spacings of the points around
  double noise = 0.03;           ///< of the points about their surface, in units
  double tolerance = 0.35;       ///< a point this far off a plane no longer belongs to it, in units
};

/// Of a noisy cloud more is seen, from farther away: above 0.06 the points of a window grow with the noise,
/// up to twice, and a kink stands out about as well as it did.
/// \param noise standard deviation of the points about their surface, in spacings, see estimate_noise()
[[nodiscard]] WedgeView view_of(double noise);

/// Finds creases as what they are, two surfaces that meet: two half-planes fitted to the points around.
///
/// The pair of planes is found without chance: each of the 24 nearest points proposes the plane of itself and
/// its 7 nearest, and the pair that explains most points wins (MSAC: Torr, Zisserman 2000, with every
/// hypothesis tried); then points are assigned and planes refitted by turns (k-planes: Bradley, Mangasarian
/// 2000), weighted so that what is far off, where surfaces have bent away, counts little. It is a crease when
/// both planes end at it, points of both lie beside it, and a kink explains the points better than a smooth
/// surface of as many parameters (Foot::evidence), or they meet at more than 60 degrees from flat. What is
/// followed may have some evidence against it: whoever walks along it adds it up.
class WedgeTracker : public Tracker {
 public:
  /// What is given must outlive this.
  WedgeTracker(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
               const TraceFrame& frame, const WedgeView& view = {})
      : cloud_(cloud), search_(search), labels_(labels), frame_(frame), view_(view) {}

  /// By its number in the cloud.
  [[nodiscard]] std::optional<Foot> find(std::uint32_t point) const override;
  [[nodiscard]] std::optional<Foot> follow(const Foot& from, const Point& expected) const override;

 private:
  const PointCloud& cloud_;
  const NeighborSearch& search_;
  const FeatureLabels& labels_;
  TraceFrame frame_;
  WedgeView view_;
};

}  // namespace keenline
