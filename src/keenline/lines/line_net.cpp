#include "keenline/lines/line_net.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <span>

#include "keenline/neighborhood/disjoint_sets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Nodes within `limit` of `start` along the net, with the node before each on the shortest way.
struct Reached {
  double way;
  std::uint32_t before;
};

std::map<std::uint32_t, Reached> reachable(const LineNet& net, std::uint32_t start, double limit) {
  std::map<std::uint32_t, Reached> reached{{start, {0, start}}};
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.emplace(0, start);
  while (!open.empty()) {
    const auto [way, node] = open.top();
    open.pop();
    if (way > reached.at(node).way) continue;
    for (const std::uint32_t neighbor : net.neighbors_of(node)) {
      const double longer = way + distance(net.position_of(node), net.position_of(neighbor));
      if (!(longer < limit)) continue;
      const auto [found, is_new] = reached.try_emplace(neighbor, Reached{longer, node});
      if (!is_new && found->second.way <= longer) continue;
      found->second = {longer, node};
      open.emplace(longer, neighbor);
    }
  }
  return reached;
}

}  // namespace

double LineNet::length_of(const NodeChain& chain) const {
  double length = 0;
  for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i)
    length += distance(position_of(chain.nodes[i]), position_of(chain.nodes[i + 1]));
  if (chain.is_loop) length += distance(position_of(chain.nodes.back()), position_of(chain.nodes.front()));
  return length;
}

void LineNet::drop_parts_below(double min_length) {
  drop_parts(min_length, [&](std::span<const std::uint32_t> part) {
    double twice_the_length = 0;
    for (const std::uint32_t node : part)
      for (const std::uint32_t neighbor : neighbors_of(node))
        twice_the_length += distance(position_of(node), position_of(neighbor));
    return twice_the_length / 2;
  });
}

void LineNet::prune_branches_below(double min_length) {
  prune_branches(min_length, [&](const NodeChain& chain) { return length_of(chain); });
}

void LineNet::merge_junctions(double distance) {
  std::vector<std::uint32_t> junctions;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (degree_of(node) > 2) junctions.push_back(node);
  DisjointSets sets(size());
  for (const std::uint32_t junction : junctions) {
    const auto reached = reachable(*this, junction, 2 * distance);
    for (const auto& [node, r] : reached) {
      const bool is_near =
          degree_of(node) > 2 && keenline::distance(position_of(junction), position_of(node)) < distance;
      if (!is_near) continue;
      for (std::uint32_t between = node; between != junction; between = reached.at(between).before)
        sets.join(between, junction);
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> merged;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (const std::uint32_t first = sets.find(node); first != node) merged[first].push_back(node);
  for (auto& [first, others] : merged) {
    Point sum_of_junctions{};
    double count = 0;
    std::vector<std::uint32_t> outside;
    others.push_back(first);
    for (const std::uint32_t node : others) {
      if (std::binary_search(junctions.begin(), junctions.end(), node)) {
        sum_of_junctions = sum(sum_of_junctions, position_of(node));
        ++count;
      }
      for (const std::uint32_t neighbor : neighbors_of(node))
        if (sets.find(neighbor) != first) outside.push_back(neighbor);
    }
    for (const std::uint32_t node : others) isolate(node);
    move(first, scaled(1 / count, sum_of_junctions));
    for (const std::uint32_t neighbor : outside) connect(first, neighbor);
  }
}

void LineNet::drop_eyelets_below(double min_length) {
  std::vector<NodeChain> eyelets = chains();
  std::erase_if(eyelets, [&](const NodeChain& chain) {
    return !chain.is_loop || degree_of(chain.nodes.front()) == 2 || length_of(chain) >= min_length;
  });
  for (const NodeChain& eyelet : eyelets) take_out(eyelet);
}

double LineNet::way_between(std::uint32_t a, std::uint32_t b, double limit) const {
  const auto reached = reachable(*this, a, limit);
  const auto found = reached.find(b);
  return found == reached.end() ? infinity : found->second.way;
}

}  // namespace keenline
