#include "keenline/detect/gumhold.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/detect/pattern_penalties.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/neighborhood/spanning_pattern.h"
#include "keenline/require.h"

namespace keenline {
namespace {

void validate(const GumholdOptions& options) {
  require_neighbor_count(options.neighbors);
  require_in_range("crease_limit", options.crease_limit, 0, 2);
  require_in_range("border_gap_deg", options.border_gap_deg, 0, 360);
  if (options.shortest_cycle) require_cycle(*options.shortest_cycle);
}

/// Penalties, first of its place, two patterns with their working memory, label and score.
constexpr std::uint64_t bytes_per_point =
    sizeof(PointPenalties) + 2 * sizeof(std::uint32_t) + 2 * sizeof(std::vector<std::uint32_t>) + 6;

class Detector {
 public:
  Detector(const PointCloud& cloud, const NeighborSearch& search, const GumholdOptions& options,
           Progress& progress)
      : positions_(cloud.positions),
        search_(search),
        options_(options),
        progress_(progress),
        first_(search.first_coincident()),
        penalties_((require_memory(cloud.size() * bytes_per_point, "penalties"), cloud.size())) {}

  FeatureLabels run() {
    search_.for_each_block(
        options_.neighbors,
        [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
          look_at(points, neighborhoods);
        },
        progress_);
    choose_rule();
    const NodeGraph creases =
        pattern_of([&](std::uint32_t a, std::uint32_t b) { return is_decided(a) && is_decided(b); },
                   [&](std::uint32_t a, std::uint32_t b, const Way& way) {
                     return edge_crease_penalty(penalties_[a], penalties_[b], way.direction, rule_);
                   },
                   options_.crease_limit);
    NodeGraph borders =
        pattern_of([&](std::uint32_t a, std::uint32_t b) { return may_be_border(a) && may_be_border(b); },
                   [&](std::uint32_t a, std::uint32_t b, const Way& way) {
                     return edge_border_penalty(penalties_[a], penalties_[b], way.direction, rule_);
                   },
                   no_limit);
    borders.drop_branches();
    return labels_of(creases, borders);
  }

 private:
  static constexpr double no_limit = 3;  // no penalty is above 2

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(positions_.size()); }

  [[nodiscard]] bool is_decided(std::size_t i) const { return penalties_[i].distance > 0; }
  [[nodiscard]] bool may_be_border(std::size_t i) const {
    return is_decided(i) && penalties_[i].gap_deg > options_.border_gap_deg;
  }

  /// Points that coincide would each be connected with all that is near them: one of them is.
  [[nodiscard]] bool stands_for_its_place(std::uint32_t i) const { return first_[i] == i; }

  void look_at(std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
    progress_.check();
    LocalOffsets local;
    std::vector<double> angles;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto neighbors = neighborhoods.of(i);
      if (neighbors.size() < static_cast<std::size_t>(options_.neighbors)) continue;
      penalties_[points[i]] = point_penalties(positions_, points[i], neighbors, local, angles);
    }
  }

  void choose_rule() {
    if (!options_.plain) return;
    rule_.curvature_share = 0.2;
    rule_.literal_direction = true;
    // The largest curvature of all, made independent of the scale by each point's own distance.
    double largest = 0;
    for (const PointPenalties& p : penalties_) largest = std::max(largest, p.bend);
    if (largest > 0) rule_.full_bend = largest;
  }

  /// Of the edges that `may` allows and whose penalty is below the limit; their weight is the penalty and the
  /// length.
  template <typename May, typename Penalty>
  [[nodiscard]] NodeGraph pattern_of(const May& may, const Penalty& penalty, double limit) {
    std::vector<WeightedEdge> edges;
    std::mutex mutex;
    search_.for_each_block(
        options_.neighbors,
        [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
          progress_.check();
          std::vector<WeightedEdge> found;
          LocalOffsets local;
          for (std::size_t i = 0; i < points.size(); ++i) {
            if (!stands_for_its_place(points[i])) continue;
            for (const std::uint32_t neighbor : neighborhoods.of(i)) {
              const auto [a, b] = std::minmax(points[i], neighbor);
              if (!stands_for_its_place(neighbor) || !may(a, b)) continue;
              const Way way = way_between(positions_, penalties_, a, b, local);
              const double p = penalty(a, b, way);
              if (p < limit) found.push_back({a, b, p + way.relative_length});
            }
          }
          const std::lock_guard lock(mutex);
          edges.insert(edges.end(), found.begin(), found.end());  // in any order: the pattern has its own
        },
        progress_);
    const std::size_t cycle = shortest_cycle();
    NodeGraph pattern = spanning_pattern(size(), std::move(edges), cycle, progress_);
    pattern.drop_small_parts(cycle);
    pattern.prune_short_branches((cycle + 1) / 2);
    return pattern;
  }

  [[nodiscard]] std::size_t shortest_cycle() const {
    if (options_.shortest_cycle) return static_cast<std::size_t>(*options_.shortest_cycle);
    const auto points = std::count_if(penalties_.begin(), penalties_.end(),
                                      [](const PointPenalties& p) { return p.distance > 0; });
    return shortest_cycle_for(static_cast<std::size_t>(points), 3);
  }

  [[nodiscard]] FeatureLabels labels_of(const NodeGraph& creases, const NodeGraph& borders) const {
    FeatureLabels labels;
    for (std::uint32_t i = 0; i < size(); ++i) {
      labels.kind.push_back(kind_of(i, creases.degree_of(first_[i]), borders.degree_of(first_[i])));
      labels.score.push_back(is_decided(i) ? static_cast<float>(1 - crease_penalty(penalties_[i], rule_))
                                           : 0);
    }
    return labels;
  }

  [[nodiscard]] Kind kind_of(std::size_t i, std::size_t crease_degree, std::size_t border_degree) const {
    if (!is_decided(i)) return Kind::Undecided;
    if (crease_degree > 0) return crease_degree > 2 ? Kind::Corner : Kind::Edge;
    if (border_degree > 0) return Kind::Border;
    constexpr double bend_of_sphere = 0.1;  // whose radius is five times the reach of the neighbourhood
    return penalties_[i].bend > bend_of_sphere ? Kind::Curved : Kind::Flat;
  }

  const std::vector<Point>& positions_;
  const NeighborSearch& search_;
  const GumholdOptions& options_;
  Progress& progress_;
  std::vector<std::uint32_t> first_;  // at the place of each point
  std::vector<PointPenalties> penalties_;
  PenaltyRule rule_;
};

}  // namespace

FeatureLabels detect_gumhold(const PointCloud& cloud, const NeighborSearch& search,
                             const GumholdOptions& options, Progress& progress) {
  validate(options);
  progress.begin("gumhold", cloud.size() * 3);
  return Detector(cloud, search, options, progress).run();
}

}  // namespace keenline
