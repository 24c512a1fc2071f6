#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "keenline/lines/foot.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/lines/tracker.h"
#include "keenline/progress.h"

namespace keenline {

/// Walks along lines: the best seed first, to both sides in steps of a spacing, until the line comes back to
/// where it started, meets another one, or ends. It ends where the evidence of its feet, added up, has fallen
/// too far, and is none if there is too little in all. Seeds that a line has passed start no other one. Paths
/// end short of corners or a little past them.
class LineWalker {
 public:
  /// \param unit of the feet: what Path::unit is to be. The tracker must outlive this.
  explicit LineWalker(LineKind kind, double unit = 1) : kind_(kind), unit_(unit) {}

  /// Advances `progress` by the seeds; the caller began the stage. Cost: O(seeds + length of the lines).
  /// \throw Cancelled
  void walk(const Tracker& tracker, std::span<const Foot> seeds, Progress& progress);

  [[nodiscard]] const std::vector<Path>& paths() const { return paths_; }

 private:
  void walk_from(const Foot& seed);
  [[nodiscard]] bool is_covered(const Foot& seed) const;
  bool go(std::vector<Foot>& feet, std::ptrdiff_t step);
  [[nodiscard]] std::optional<Foot> next_foot(const Foot& from, double least_evidence) const;
  [[nodiscard]] std::optional<FootGrid::Entry> meeting(const Foot& foot, std::ptrdiff_t place) const;

  const Tracker* tracker_ = nullptr;
  LineKind kind_;
  double unit_;
  FootGrid grid_;
  FootGrid own_;  // of the path that is walked: it may yet prove none
  std::vector<Path> paths_;
};

}  // namespace keenline
