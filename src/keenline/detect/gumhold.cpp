#include "keenline/detect/gumhold.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/detect/pattern_penalties.h"
#include "keenline/errors.h"
#include "keenline/lines/spanning_pattern.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

constexpr std::size_t block_size = 1024;

void validate(const GumholdOptions& options) {
  const auto require = [](bool ok, std::string_view name, const auto& found, std::string_view expected) {
    if (!ok) throw InvalidArgument(fmt::format("{}: found {}, expected {}", name, found, expected));
  };
  require_neighbor_count(options.neighbors);
  require(options.crease_limit >= 0 && options.crease_limit <= 2, "crease_limit", options.crease_limit,
          "0 to 2");
  require(options.border_gap_deg >= 0 && options.border_gap_deg <= 360, "border_gap_deg",
          options.border_gap_deg, "0 to 360 degrees");
  if (options.shortest_cycle)
    require(*options.shortest_cycle >= 1, "shortest_cycle", *options.shortest_cycle, "1 or more");
}

class Detector {
 public:
  Detector(const PointCloud& cloud, const Neighborhoods& neighborhoods, const GumholdOptions& options,
           Progress& progress)
      : positions_(cloud.positions),
        neighborhoods_(neighborhoods),
        options_(options),
        progress_(progress),
        penalties_((require_memory(cloud.size() * sizeof(PointPenalties), "penalties"), cloud.size())) {}

  FeatureLabels run() {
    for_each_block([&](std::size_t first, std::size_t last) { look_at(first, last); });
    choose_rule();
    const SpanningPattern creases =
        pattern_of([&](std::uint32_t a, std::uint32_t b) { return is_decided(a) && is_decided(b); },
                   [&](std::uint32_t a, std::uint32_t b, const Way& way) {
                     return crease_penalty(penalties_[a], penalties_[b], way.direction, rule_);
                   },
                   options_.crease_limit);
    SpanningPattern borders =
        pattern_of([&](std::uint32_t a, std::uint32_t b) { return may_be_border(a) && may_be_border(b); },
                   [&](std::uint32_t a, std::uint32_t b, const Way& way) {
                     return border_penalty(penalties_[a], penalties_[b], way.direction, rule_);
                   },
                   no_limit);
    borders.keep_loops();
    return labels_of(creases, borders);
  }

 private:
  static constexpr double no_limit = 3;  // no penalty is above 2

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(positions_.size()); }

  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::size_t i) const {
    const auto neighbors = neighborhoods_.of(i);
    return neighbors.first(std::min(neighbors.size(), static_cast<std::size_t>(options_.neighbors)));
  }
  [[nodiscard]] bool is_decided(std::size_t i) const { return penalties_[i].distance > 0; }
  [[nodiscard]] bool may_be_border(std::size_t i) const {
    return is_decided(i) && penalties_[i].gap_deg > options_.border_gap_deg;
  }

  template <typename Visit>
  void for_each_block(const Visit& visit) {
    const std::size_t blocks = (positions_.size() + block_size - 1) / block_size;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t block = range.begin(); block < range.end(); ++block) {
                          progress_.check();
                          const std::size_t first = block * block_size;
                          const std::size_t last = std::min(positions_.size(), first + block_size);
                          visit(first, last);
                          progress_.advance(last - first);
                        }
                      });
  }

  void look_at(std::size_t first, std::size_t last) {
    LocalOffsets local;
    std::vector<double> angles;
    for (std::size_t i = first; i < last; ++i) {
      const auto neighbors = neighbors_of(i);
      if (neighbors.size() < static_cast<std::size_t>(options_.neighbors)) continue;
      penalties_[i] = point_penalties(positions_, i, neighbors, local, angles);
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

  /// Calls visit(a, b), a < b, for every edge of the neighbour graph that a point of the block is the first
  /// to know of.
  template <typename Visit>
  void for_each_edge(std::size_t first, std::size_t last, const Visit& visit) const {
    for (std::size_t i = first; i < last; ++i) {
      const auto own = static_cast<std::uint32_t>(i);
      for (const std::uint32_t neighbor : neighbors_of(i)) {
        const auto theirs = neighbors_of(neighbor);
        const bool is_mutual = std::find(theirs.begin(), theirs.end(), own) != theirs.end();
        if (!is_mutual || own < neighbor) visit(std::min(own, neighbor), std::max(own, neighbor));
      }
    }
  }

  /// Of the edges that `may` allows and whose penalty is below the limit; their weight is the penalty and the
  /// length.
  template <typename May, typename Penalty>
  [[nodiscard]] SpanningPattern pattern_of(const May& may, const Penalty& penalty, double limit) {
    std::vector<std::vector<WeightedEdge>> found((positions_.size() + block_size - 1) / block_size);
    for_each_block([&](std::size_t first, std::size_t last) {
      LocalOffsets local;
      for_each_edge(first, last, [&](std::uint32_t a, std::uint32_t b) {
        if (!may(a, b)) return;
        const Way way = way_between(positions_, penalties_, a, b, local);
        const double p = penalty(a, b, way);
        if (p < limit) found[first / block_size].push_back({a, b, p + way.relative_length});
      });
    });
    std::vector<WeightedEdge> edges;
    for (const auto& part : found) edges.insert(edges.end(), part.begin(), part.end());
    const std::size_t cycle = shortest_cycle();
    SpanningPattern pattern(size(), std::move(edges), cycle, progress_);
    pattern.drop_components_below(cycle);
    pattern.prune_chains_below((cycle + 1) / 2);
    return pattern;
  }

  [[nodiscard]] std::size_t shortest_cycle() const {
    if (options_.shortest_cycle) return static_cast<std::size_t>(*options_.shortest_cycle);
    const auto points = std::count_if(penalties_.begin(), penalties_.end(),
                                      [](const PointPenalties& p) { return p.distance > 0; });
    return std::max<std::size_t>(3, static_cast<std::size_t>(std::sqrt(static_cast<double>(points)) / 2));
  }

  [[nodiscard]] FeatureLabels labels_of(const SpanningPattern& creases,
                                        const SpanningPattern& borders) const {
    FeatureLabels labels;
    for (std::uint32_t i = 0; i < size(); ++i) {
      labels.kind.push_back(kind_of(i, creases.degree_of(i), borders.degree_of(i)));
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
  const Neighborhoods& neighborhoods_;
  const GumholdOptions& options_;
  Progress& progress_;
  std::vector<PointPenalties> penalties_;
  PenaltyRule rule_;
};

}  // namespace

FeatureLabels detect_gumhold(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                             const GumholdOptions& options, Progress& progress) {
  validate(options);
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
  progress.begin("gumhold", cloud.size() * 3);
  return Detector(cloud, neighborhoods, options, progress).run();
}

}  // namespace keenline
