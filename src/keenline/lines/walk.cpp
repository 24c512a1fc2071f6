#include "keenline/lines/walk.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "keenline/lines/foot_grid.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths in spacings of the points around.
constexpr double covered = 1;  // a seed this close to a path is on it
constexpr double covered_parallel = 2;
constexpr double same_line = 1.2;       // a path this close to another, in the same direction, has met it
constexpr double same_direction = 0.8;  // cosine of 37 degrees
constexpr double largest_turn = 0.82;   // cosine of 35 degrees, from one foot to the next
constexpr int most_missed = 2;          // steps that may show no line before it has ended
constexpr std::ptrdiff_t smallest_loop = 8;  // steps; so far apart, a path does not meet itself

// One foot proves little where points are noisy, and its neighbours see the same points: what counts is the
// sum along the path. On smooth surfaces it falls, along true lines it rises.
constexpr double enough = 50;       // for a path
constexpr double most_of_one = 50;  // what one foot says for all others
constexpr double most_lost = 10;    // since the sum was largest: the line ended there (Page 1954, CUSUM)

double counted_evidence(const Foot& foot) { return std::min(foot.evidence, most_of_one); }

/// Is the position beside the foot, and no farther than `aside` from its tangent?
bool is_beside(const Point& position, const Foot& foot, double aside) {
  const Point d = difference(position, foot.position);
  const double along = dot(d, foot.tangent);
  return std::abs(along) <= 0.75 * foot.scale &&
         dot(d, d) - along * along <= aside * aside * foot.scale * foot.scale;
}

}  // namespace

void LineWalker::walk(const Tracker& tracker, std::span<const Foot> seeds, Progress& progress) {
  tracker_ = &tracker;
  std::vector<std::size_t> order(seeds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seeds[a].quality > seeds[b].quality; });
  for (const std::size_t i : order) {
    progress.check();
    walk_from(seeds[i]);
    progress.advance(1);
  }
}

void LineWalker::walk_from(const Foot& seed) {
  if (is_covered(seed)) return;
  std::vector<Foot> ahead{seed};
  own_ = FootGrid();
  own_.insert({paths_.size(), 0, seed});
  const bool closed = go(ahead, 1);
  std::vector<Foot> behind;
  if (!closed) {
    Foot back = seed;
    back.tangent = scaled(-1, back.tangent);
    behind.push_back(back);
    (void)go(behind, -1);
    behind.erase(behind.begin());
    for (Foot& foot : behind) foot.tangent = scaled(-1, foot.tangent);
  }
  Path path{{behind.rbegin(), behind.rend()}, closed, kind_, unit_};
  path.feet.insert(path.feet.end(), ahead.begin(), ahead.end());
  double evidence = 0;
  for (const Foot& foot : path.feet) evidence += counted_evidence(foot);
  if (evidence < enough) return;
  for (std::size_t i = 0; i < path.feet.size(); ++i) {
    const auto place = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(behind.size());
    grid_.insert({paths_.size(), place, path.feet[i]});
  }
  paths_.push_back(std::move(path));
}

bool LineWalker::is_covered(const Foot& seed) const {
  bool found = false;
  grid_.near(seed.position, 3 * seed.scale, [&](const FootGrid::Entry& entry) {
    const bool is_parallel = std::abs(dot(entry.foot.tangent, seed.tangent)) > same_direction;
    found = found || is_beside(seed.position, entry.foot, is_parallel ? covered_parallel : covered);
  });
  return found;
}

/// Appends feet as far as the evidence goes. True when it has come back to its start.
bool LineWalker::go(std::vector<Foot>& feet, std::ptrdiff_t step) {
  double lost = 0;
  std::size_t proven = feet.size();
  for (;;) {
    const std::optional<Foot> next = next_foot(feet.back(), lost - most_lost);
    if (!next) break;
    const std::ptrdiff_t place = step * static_cast<std::ptrdiff_t>(feet.size());
    if (const auto met = meeting(*next, place)) {
      if (met->path == paths_.size() && std::abs(met->place) <= 1) return true;
      break;
    }
    feet.push_back(*next);
    own_.insert({paths_.size(), place, *next});
    lost = std::max(0.0, lost - counted_evidence(*next));
    if (lost == 0) proven = feet.size();
  }
  feet.resize(proven);
  return false;
}

std::optional<Foot> LineWalker::next_foot(const Foot& from, double least_evidence) const {
  for (int steps = 1; steps <= 1 + most_missed; ++steps) {
    const Point expected = sum(from.position, scaled(steps * from.scale, from.tangent));
    const auto foot = tracker_->follow(from, expected);
    if (!foot || foot->evidence < least_evidence || dot(foot->tangent, from.tangent) < largest_turn) continue;
    // A foot that falls back would let the walk go round on the spot.
    if (dot(difference(foot->position, from.position), from.tangent) < 0.3 * from.scale) continue;
    return foot;
  }
  return std::nullopt;
}

/// The foot of another path, or of this one far from here, that lies on the same line.
std::optional<FootGrid::Entry> LineWalker::meeting(const Foot& foot, std::ptrdiff_t place) const {
  std::optional<FootGrid::Entry> met;
  const auto look = [&](const FootGrid::Entry& entry) {
    if (met) return;
    if (entry.path == paths_.size() && std::abs(entry.place - place) < smallest_loop) return;
    if (std::abs(dot(entry.foot.tangent, foot.tangent)) < same_direction) return;
    if (is_beside(foot.position, entry.foot, same_line)) met = entry;
  };
  own_.near(foot.position, 2 * foot.scale, look);
  grid_.near(foot.position, 2 * foot.scale, look);
  return met;
}

}  // namespace keenline
