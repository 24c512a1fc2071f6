#pragma once

#include <cstdint>
#include <optional>

#include "keenline/lines/foot.h"

namespace keenline {

/// Knows from the points around what a line is. Threads: may be called from many at once.
class Tracker {
 public:
  Tracker() = default;
  Tracker(const Tracker&) = delete;
  Tracker& operator=(const Tracker&) = delete;
  virtual ~Tracker() = default;

  /// The line near a point, if there is one. The tracker says how its points are numbered.
  [[nodiscard]] virtual std::optional<Foot> find(std::uint32_t point) const = 0;

  /// Where the line of a foot passes an expected position a spacing or so further on; its tangent points to
  /// the same side as that of `from`. Nothing where the line has ended.
  [[nodiscard]] virtual std::optional<Foot> follow(const Foot& from, const Point& expected) const = 0;
};

}  // namespace keenline
