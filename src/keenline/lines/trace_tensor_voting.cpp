#include "keenline/lines/trace_tensor_voting.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/detect/voters.h"
#include "keenline/kernels/tensor_votes.h"
#include "keenline/lines/candidates.h"
#include "keenline/lines/finish_net.h"
#include "keenline/lines/line_net.h"
#include "keenline/memory.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// All lengths here are in spacings.
constexpr double step = 1;             // along a curve, at least
constexpr double passed_within = 1.5;  // of a curve: candidates are its band
constexpr double junction_size = 3;    // curves stop short of a junction by about the width of their bands

void require_usable(const TraceTensorVotingOptions& options) {
  require_in_range("voting_scale", options.voting_scale, 1, largest_voting_scale);
  require_in_range("curvature_weight", options.curvature_weight, 0, 100);
  require_in_range("gap", options.gap, 1, 4.5);
  require_in_range("close_reach", options.close_reach, 0, 100);
  require_in_range("min_branch", options.min_branch, 0, 1000);
}

/// What was voted at a candidate.
struct CurveToken {
  Point tangent{};      ///< e3, up to its sign
  double saliency = 0;  ///< of a curve
};

/// Both passes of tensor voting, the second at the candidates only.
std::vector<CurveToken> vote(const PointCloud& cloud, const NeighborSearch& search,
                             const Candidates& candidates, const TraceTensorVotingOptions& options,
                             Progress& progress) {
  const int count = voters_within(options.voting_scale);
  require_memory(cloud.size() * sizeof(Stick) + candidates.size() * sizeof(CurveToken), "tensor voting");
  tbb::enumerable_thread_specific<Voters> workspace;
  std::vector<Stick> sticks(cloud.size());
  search.for_each_block(
      count,
      [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
        Voters& voters = workspace.local();
        for (std::size_t i = 0; i < points.size(); ++i)
          if (voters.gather(cloud.positions, points[i], neighborhoods.of(i), options.voting_scale))
            sticks[points[i]] = voters.stick_from_balls();
      },
      progress);
  std::vector<CurveToken> tokens(candidates.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      Voters& voters = workspace.local();
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const std::uint32_t point = candidates.points()[i];
                        const std::vector<std::uint32_t> nearest = search.nearest(point, count);
                        if (!voters.gather(cloud.positions, point, nearest, options.voting_scale)) continue;
                        const kernels::Eigen3 axes = kernels::eigen_decomposition(
                            voters.stick_votes(sticks, options.curvature_weight));
                        tokens[i] = {axes.vectors[2], kernels::saliency_of(axes).curve};
                      }
                    });
  return tokens;
}

class CurveWalker {
 public:
  CurveWalker(const Candidates& candidates, const std::vector<CurveToken>& tokens,
              const TraceTensorVotingOptions& options)
      : candidates_(candidates), tokens_(tokens), options_(options), is_passed_(candidates.size()) {}

  /// All curves, the one through the highest saliency first. support() goes with their vertices.
  std::vector<std::vector<Point>> walk_all(const Progress& progress) {
    std::vector<std::uint32_t> seeds(candidates_.size());
    std::iota(seeds.begin(), seeds.end(), 0U);
    std::stable_sort(seeds.begin(), seeds.end(), [&](std::uint32_t a, std::uint32_t b) {
      return tokens_[a].saliency > tokens_[b].saliency;
    });
    std::vector<std::vector<Point>> curves;
    for (const std::uint32_t seed : seeds) {
      if (is_passed_[seed] || !(tokens_[seed].saliency > 0)) continue;
      progress.check();
      curves.push_back(walk_from(seed));
    }
    return curves;
  }

  /// Candidates that were passed at each vertex, curve after curve.
  [[nodiscard]] const std::vector<std::uint32_t>& support() const { return support_; }

 private:
  struct Place {
    Point position;
    std::uint32_t candidate;  // the one that led here: what is near is near it
  };

  std::vector<Point> walk_from(std::uint32_t seed) {
    const Point& tangent = tokens_[seed].tangent;
    const Place start{centered(candidates_.positions()[seed], seed, tangent), seed};
    std::vector<std::uint32_t> counts{pass(start)};
    std::vector<Point> curve{start.position};
    for (const double sign : {1.0, -1.0}) {
      Place here = start;
      Point direction = scaled(sign, tangent);
      while (const std::optional<Place> next = next_place(here, direction)) {
        here = *next;
        counts.push_back(pass(here));
        curve.push_back(here.position);
      }
      // The second half goes on from the seed, now the last.
      std::reverse(curve.begin(), curve.end());
      std::reverse(counts.begin(), counts.end());
    }
    support_.insert(support_.end(), counts.begin(), counts.end());
    return curve;
  }

  /// The nearest candidate ahead that no curve has passed gives the way; the next place is a step towards it,
  /// or at it where that is further, in the middle of the saliency. `direction` comes back as the way went.
  [[nodiscard]] std::optional<Place> next_place(const Place& here, Point& direction) const {
    std::optional<std::uint32_t> best;
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::uint32_t candidate : candidates_.near(here.candidate)) {
      if (is_passed_[candidate]) continue;
      const Point way = difference(candidates_.positions()[candidate], here.position);
      const double ahead = dot(way, direction);
      const double aside = dot(way, way) - ahead * ahead;
      constexpr double squared_slope = 1;  // 45 degrees to each side, and the width of the band
      if (ahead < 0.5 * step || aside > squared_slope * ahead * ahead + 0.25) continue;
      if (ahead > options_.gap || ahead >= nearest) continue;
      best = candidate;
      nearest = ahead;
    }
    if (!best) return {};
    const double forward = std::max(step, nearest);
    const Point& token = tokens_[*best].tangent;
    const Point tangent = scaled(dot(token, direction) < 0 ? -1 : 1, token);
    const Point ahead = sum(here.position, scaled(forward, direction));
    const Place next{centered(ahead, *best, tangent), *best};
    const Point way = difference(next.position, here.position);
    if (!(dot(way, direction) > 0.25 * step)) return {};
    direction = unit(sum(unit(way), scaled(0.5, tangent)));
    return next;
  }

  /// Mean of the candidates beside the place, weighted by their saliency, across the tangent.
  [[nodiscard]] Point centered(const Point& place, std::uint32_t candidate, const Point& tangent) const {
    Point total{};
    double weights = 0;
    const auto add = [&](std::uint32_t other) {
      const Point offset = difference(candidates_.positions()[other], place);
      const double along = dot(offset, tangent);
      const Point across = difference(offset, scaled(along, tangent));
      constexpr double slab = 1.5;
      constexpr double radius = 2.5;
      if (along > slab || along < -slab || dot(across, across) > radius * radius) return;
      const double weight = tokens_[other].saliency * tokens_[other].saliency;
      total = sum(total, scaled(weight, across));
      weights += weight;
    };
    add(candidate);
    for (const std::uint32_t other : candidates_.near(candidate)) add(other);
    return weights > 0 ? sum(place, scaled(1 / weights, total)) : place;
  }

  std::uint32_t pass(const Place& here) {
    std::uint32_t count = 0;
    const auto pass_one = [&](std::uint32_t candidate) {
      const bool is_near = distance(candidates_.positions()[candidate], here.position) <= passed_within;
      if (is_passed_[candidate] || !is_near) return;
      is_passed_[candidate] = true;
      count += candidates_.copies()[candidate];
    };
    for (const std::uint32_t candidate : candidates_.near(here.candidate)) pass_one(candidate);
    pass_one(here.candidate);
    is_passed_[here.candidate] = true;
    return count;
  }

  const Candidates& candidates_;
  const std::vector<CurveToken>& tokens_;
  const TraceTensorVotingOptions& options_;
  std::vector<bool> is_passed_;
  std::vector<std::uint32_t> support_;
};

/// Curves that are long enough to be more than the rest of a band, as a net of their vertices.
LineNet net_of(const std::vector<std::vector<Point>>& curves) {
  std::vector<Point> positions;
  for (const std::vector<Point>& curve : curves)
    positions.insert(positions.end(), curve.begin(), curve.end());
  LineNet net(std::move(positions));
  std::uint32_t first = 0;
  for (const std::vector<Point>& curve : curves) {
    for (std::uint32_t i = 0; i + 1 < curve.size(); ++i) net.connect(first + i, first + i + 1);
    first += static_cast<std::uint32_t>(curve.size());
  }
  return net;
}

}  // namespace

FeatureGraph trace_tensor_voting(const PointCloud& cloud, const NeighborSearch& search,
                                 const FeatureLabels& labels, double spacing,
                                 const TraceTensorVotingOptions& options, Progress& progress) {
  require_usable(options);
  progress.begin("trace", cloud.size());
  progress.check();
  const Candidates candidates(cloud, search, labels, spacing, progress);
  if (candidates.size() == 0) return {};
  const std::vector<CurveToken> tokens = vote(cloud, search, candidates, options, progress);
  CurveWalker walker(candidates, tokens, options);
  LineNet net = net_of(walker.walk_all(progress));
  constexpr double shortest_piece = 2;  // less is what is left beside a curve of a band, and points nowhere
  constexpr double ratio = 3;
  net.drop_parts_below(std::min(shortest_piece, options.min_branch));
  close_ends(net, options.close_reach, ratio, progress);
  net.drop_parts_below(options.min_branch);
  net.merge_junctions(junction_size);
  net.drop_eyelets_below(2 * junction_size);
  net.prune_branches_below(options.min_branch);
  return graph_of(net, candidates, walker.support());
}

}  // namespace keenline
