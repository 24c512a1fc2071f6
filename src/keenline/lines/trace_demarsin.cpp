#include "keenline/lines/trace_demarsin.h"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "keenline/lines/candidates.h"
#include "keenline/lines/finish_net.h"
#include "keenline/lines/line_net.h"
#include "keenline/neighborhood/disjoint_sets.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// All lengths here are in spacings.
constexpr int extra_edges = 6;
constexpr double junction_size = 3;  // junctions closer than the bands that meet in them are wide are one

void require_usable(const TraceDemarsinOptions& options) {
  require_in_range("extra_reach", options.extra_reach, 0, 100);
  require_in_range("close_reach", options.close_reach, 0, 100);
  require_in_range("close_ratio", options.close_ratio, 1, 100);
  require_in_range("min_branch", options.min_branch, 0, 1000);
  require_in_range("smooth_rounds", options.smooth_rounds, 0, 1000);
}

CandidateClusters clusters_of(const Candidates& candidates, const FeatureLabels& labels) {
  std::vector<float> scores;
  for (const std::uint32_t point : candidates.points())
    scores.push_back(labels.score.empty() ? 0.0F : labels.score[point]);
  constexpr double across = 3;  // wider than half of the widest band that a method labels
  constexpr double along = 1;
  return cluster(candidates, contracted(candidates, across, 1), scores, along);
}

/// A possible piece; of equally long ones the first by its ends.
struct Edge {
  double length;
  std::uint32_t a, b;
  bool operator<(const Edge& other) const {
    return std::tie(length, a, b) < std::tie(other.length, other.a, other.b);
  }
};

/// G_all and the further edges of G_extended, shortest first.
std::vector<Edge> extended_graph(const Candidates& candidates, const CandidateClusters& clusters,
                                 double extra_reach) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto add = [&](std::uint32_t a, std::uint32_t b) {
    if (a != b) pairs.emplace_back(std::min(a, b), std::max(a, b));
  };
  constexpr std::size_t neighbors_of_point = 8;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto near = candidates.near(i);
    for (const std::uint32_t other : near.first(std::min(near.size(), neighbors_of_point)))
      add(clusters.cluster[i], clusters.cluster[other]);
  }
  const NeighborSearch search(clusters.centroids);
  for (std::uint32_t node = 0; node < clusters.centroids.size(); ++node)
    for (const std::uint32_t other : search.nearest(node, extra_edges))
      if (distance(clusters.centroids[node], clusters.centroids[other]) < extra_reach) add(node, other);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<Edge> edges;
  edges.reserve(pairs.size());
  for (const auto& [a, b] : pairs)
    edges.push_back({distance(clusters.centroids[a], clusters.centroids[b]), a, b});
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Kruskal's algorithm.
LineNet spanning_forest(const std::vector<Point>& nodes, const std::vector<Edge>& edges) {
  DisjointSets parts(nodes.size());
  LineNet net(nodes);
  for (const Edge& edge : edges)
    if (parts.join(edge.a, edge.b)) net.connect(edge.a, edge.b);
  return net;
}

void clean_up(LineNet& net, const TraceDemarsinOptions& options) {
  if (options.closed_only) net.drop_branches();
  net.merge_junctions(junction_size);
  net.drop_eyelets_below(2 * junction_size);
  if (options.closed_only) net.drop_branches();
  else net.prune_branches_below(options.min_branch);
}

}  // namespace

FeatureGraph trace_demarsin(const PointCloud& cloud, const NeighborSearch& search,
                            const FeatureLabels& labels, double spacing, const TraceDemarsinOptions& options,
                            Progress& progress) {
  require_usable(options);
  progress.begin("trace", 0);
  progress.check();
  const Candidates candidates(cloud, search, labels, spacing, progress);
  if (candidates.size() == 0) return {};
  const CandidateClusters clusters = clusters_of(candidates, labels);
  progress.check();
  LineNet net =
      spanning_forest(clusters.centroids, extended_graph(candidates, clusters, options.extra_reach));
  net.prune_branches_below(options.min_branch);
  constexpr double shortest_piece = 2;  // less points nowhere
  net.drop_parts_below(std::min(shortest_piece, options.min_branch));
  close_ends(net, options.close_reach, options.close_ratio, progress);
  net.drop_parts_below(options.min_branch);
  clean_up(net, options);
  smooth(net, options.smooth_rounds, progress);
  return graph_of(net, candidates, clusters.sizes);
}

}  // namespace keenline
