#include "keenline/lines/line_net.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <queue>

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

std::vector<std::uint32_t> LineNet::ends() const {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (degree_of(node) == 1) ends.push_back(node);
  return ends;
}

void LineNet::connect(std::uint32_t a, std::uint32_t b) {
  if (a == b) return;
  const auto insert = [&](std::uint32_t node, std::uint32_t neighbor) {
    auto& list = neighbors_[node];
    const auto place = std::lower_bound(list.begin(), list.end(), neighbor);
    if (place == list.end() || *place != neighbor) list.insert(place, neighbor);
  };
  insert(a, b);
  insert(b, a);
}

void LineNet::disconnect(std::uint32_t a, std::uint32_t b) {
  std::erase(neighbors_[a], b);
  std::erase(neighbors_[b], a);
}

void LineNet::isolate(std::uint32_t node) {
  for (const std::uint32_t neighbor : neighbors_[node]) std::erase(neighbors_[neighbor], node);
  neighbors_[node].clear();
}

double LineNet::length_of(const NetChain& chain) const {
  double length = 0;
  for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i)
    length += distance(position_of(chain.nodes[i]), position_of(chain.nodes[i + 1]));
  return length;
}

void LineNet::take_out(const NetChain& chain) {
  for (std::size_t i = 0; i + 1 < chain.nodes.size(); ++i) disconnect(chain.nodes[i], chain.nodes[i + 1]);
}

void LineNet::drop_parts_below(double min_length) {
  std::vector<bool> seen(size());
  std::vector<std::uint32_t> part;
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (seen[start]) continue;
    seen[start] = true;
    part.assign(1, start);
    double twice_the_length = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t neighbor : neighbors_[part[i]]) {
        twice_the_length += distance(position_of(part[i]), position_of(neighbor));
        if (seen[neighbor]) continue;
        seen[neighbor] = true;
        part.push_back(neighbor);
      }
    }
    if (twice_the_length < 2 * min_length)
      for (const std::uint32_t node : part) neighbors_[node].clear();
  }
}

NetChain LineNet::chain_from(std::uint32_t start, std::uint32_t next) const {
  NetChain chain{.nodes = {start, next}};
  while (degree_of(chain.nodes.back()) == 2 && chain.nodes.back() != start) {
    const std::uint32_t here = chain.nodes.back();
    const std::uint32_t before = chain.nodes[chain.nodes.size() - 2];
    chain.nodes.push_back(neighbors_[here][0] == before ? neighbors_[here][1] : neighbors_[here][0]);
  }
  return chain;
}

void LineNet::prune_branches_below(double min_length) {
  // By length, then by the end. A branch can only grow while it waits: when its junction becomes a middle.
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> branches;
  const auto length_from = [&](std::uint32_t end) {
    if (degree_of(end) != 1) return infinity;
    const NetChain chain = chain_from(end, neighbors_[end][0]);
    return degree_of(chain.nodes.back()) > 2 ? length_of(chain) : infinity;
  };
  for (const std::uint32_t end : ends()) branches.emplace(length_from(end), end);
  while (!branches.empty() && branches.top().first < min_length) {
    const auto [length, end] = branches.top();
    branches.pop();
    if (const double now = length_from(end); now != length) branches.emplace(now, end);
    else take_out(chain_from(end, neighbors_[end][0]));
  }
}

void LineNet::drop_branches() {
  for (std::uint32_t end : ends()) {
    while (degree_of(end) == 1) {
      const std::uint32_t next = neighbors_[end][0];
      disconnect(end, next);
      end = next;
    }
  }
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
      for (const std::uint32_t neighbor : neighbors_[node])
        if (sets.find(neighbor) != first) outside.push_back(neighbor);
    }
    for (const std::uint32_t node : others) isolate(node);
    move(first, scaled(1 / count, sum_of_junctions));
    for (const std::uint32_t neighbor : outside) connect(first, neighbor);
  }
}

void LineNet::drop_eyelets_below(double min_length) {
  for (const NetChain& chain : chains())
    if (!chain.is_closed && chain.nodes.front() == chain.nodes.back() && length_of(chain) < min_length)
      take_out(chain);
}

double LineNet::way_between(std::uint32_t a, std::uint32_t b, double limit) const {
  const auto reached = reachable(*this, a, limit);
  const auto found = reached.find(b);
  return found == reached.end() ? infinity : found->second.way;
}

std::vector<NetChain> LineNet::chains() const {
  std::vector<NetChain> chains;
  std::vector<bool> seen(size());  // inside a chain
  const auto add = [&](NetChain chain) {
    for (const std::uint32_t node : chain.nodes) seen[node] = true;
    chains.push_back(std::move(chain));
  };
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (degree_of(start) == 0 || degree_of(start) == 2) continue;
    for (const std::uint32_t next : neighbors_[start]) {
      if (degree_of(next) == 2 && seen[next]) continue;
      if (degree_of(next) != 2 && next < start) continue;
      add(chain_from(start, next));
    }
  }
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (degree_of(start) != 2 || seen[start]) continue;
    NetChain loop = chain_from(start, neighbors_[start][0]);
    loop.nodes.pop_back();
    loop.is_closed = true;
    add(std::move(loop));
  }
  return chains;
}

}  // namespace keenline
