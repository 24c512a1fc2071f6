#pragma once

#include <vector>

#include "keenline/feature_graph.h"

namespace keenline {

/// Places on a polyline by the length of the way to them from the first vertex. In a closed line places go
/// round and round; an open one ends at its ends.
class ArcLength {
 public:
  /// The line must outlive this and stay as it is. \pre a valid line
  explicit ArcLength(const Polyline& line);

  [[nodiscard]] double total() const { return at_vertex_.back(); }
  /// Of vertex `i`.
  [[nodiscard]] double at(std::size_t i) const { return at_vertex_[i]; }
  [[nodiscard]] Point point(double place) const;
  /// Unit vector from half a `window` before the place to half a `window` behind it; at the ends of an open
  /// line from as far as it goes. (0, 0, 0) where these two are one point.
  [[nodiscard]] Point direction(double place, double window) const;

  /// Where a place lies: on straight piece `segment`, `part` of it behind its start.
  struct Spot {
    std::size_t segment = 0;
    double part = 0;  ///< 0 to 1
  };
  [[nodiscard]] Spot spot(double place) const;

 private:
  const Polyline& line_;
  std::vector<double> at_vertex_;  // one more than straight pieces
};

}  // namespace keenline
