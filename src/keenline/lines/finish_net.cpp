#include "keenline/lines/finish_net.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// Two ends; of equally near ones the first.
struct Pair {
  double apart;
  std::uint32_t a, b;
  bool operator<(const Pair& other) const {
    return std::tie(apart, a, b) < std::tie(other.apart, other.a, other.b);
  }
};

/// Connects open ends with each other, nearest pairs first, until nothing is left to connect.
bool close_between_ends(LineNet& net, double reach, double ratio, const Progress& progress) {
  const std::vector<std::uint32_t> ends = net.ends();
  if (ends.size() < 2) return false;
  constexpr int others_looked_at = 5;
  std::vector<Point> positions;
  positions.reserve(ends.size());
  for (const std::uint32_t end : ends) positions.push_back(net.position_of(end));
  const NeighborSearch search(positions, progress);
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < ends.size(); ++i) {
    for (const std::uint32_t j : search.nearest(i, others_looked_at)) {
      const double apart = distance(positions[i], positions[j]);
      if (apart <= reach) pairs.push_back({apart, std::min(ends[i], ends[j]), std::max(ends[i], ends[j])});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  bool any = false;
  for (const Pair& pair : pairs) {
    progress.check();
    if (net.degree_of(pair.a) != 1 || net.degree_of(pair.b) != 1) continue;
    const double longest = ratio * pair.apart;
    if (net.way_between(pair.a, pair.b, longest) < longest) continue;
    net.connect(pair.a, pair.b);
    any = true;
  }
  return any;
}

/// Connects every end that is left to the nearest node that is far along the lines.
void close_to_nodes(LineNet& net, double reach, double ratio, const Progress& progress) {
  std::vector<Point> positions;
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t node = 0; node < net.size(); ++node) {
    if (net.degree_of(node) == 0) continue;
    nodes.push_back(node);
    positions.push_back(net.position_of(node));
  }
  if (nodes.empty()) return;
  const NeighborSearch search(positions, progress);
  constexpr int nodes_looked_at = 64;
  constexpr double shortest_loop = 12;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t end = nodes[i];
    if (net.degree_of(end) != 1) continue;
    progress.check();
    for (const std::uint32_t j : search.nearest(i, nodes_looked_at)) {
      const double apart = distance(positions[i], positions[j]);
      if (apart > reach) break;
      const double longest = std::max(ratio * apart, shortest_loop);
      if (net.way_between(end, nodes[j], longest) < longest) continue;
      net.connect(end, nodes[j]);
      break;
    }
  }
}

}  // namespace

void close_ends(LineNet& net, double reach, double ratio, const Progress& progress) {
  while (close_between_ends(net, reach, ratio, progress)) progress.check();
  close_to_nodes(net, reach, ratio, progress);
}

void smooth(LineNet& net, int rounds, const Progress& progress) {
  std::vector<Point> next(net.size());
  for (int step = 0; step < 2 * rounds; ++step) {
    progress.check();
    const double pace = step % 2 == 0 ? 0.5 : -0.53;
    for (std::uint32_t node = 0; node < net.size(); ++node) {
      next[node] = net.position_of(node);
      if (net.degree_of(node) != 2) continue;
      const auto beside = net.neighbors_of(node);
      const Point middle = scaled(0.5, sum(net.position_of(beside[0]), net.position_of(beside[1])));
      next[node] = sum(next[node], scaled(pace, difference(middle, next[node])));
    }
    for (std::uint32_t node = 0; node < net.size(); ++node) net.move(node, next[node]);
  }
}

FeatureGraph graph_of(const LineNet& net, const Candidates& candidates,
                      std::span<const std::uint32_t> support) {
  FeatureGraph graph;
  std::map<std::uint32_t, std::uint32_t> corners;  // of junctions
  const auto corner_at = [&](std::uint32_t node) -> std::optional<std::uint32_t> {
    if (net.degree_of(node) < 3) return {};
    const auto [corner, is_new] = corners.emplace(node, static_cast<std::uint32_t>(graph.corners.size()));
    if (is_new) graph.corners.push_back({candidates.in_cloud(net.position_of(node)), {}});
    return corner->second;
  };
  for (const NodeChain& chain : net.chains()) {
    Polyline line;
    for (const std::uint32_t node : chain.nodes) {
      line.vertices.push_back(candidates.in_cloud(net.position_of(node)));
      line.support += support[node];
    }
    line.closed = chain.is_loop;
    line.start_corner = corner_at(chain.nodes.front());
    line.end_corner = chain.is_loop ? line.start_corner : corner_at(chain.nodes.back());
    if (line.vertices.size() > (line.closed ? 2U : 1U)) graph.polylines.push_back(std::move(line));
  }
  return graph;
}

}  // namespace keenline
