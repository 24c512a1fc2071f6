#include "keenline/neighborhood/node_graph.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <utility>

namespace keenline {

std::vector<std::uint32_t> NodeGraph::ends() const {
  std::vector<std::uint32_t> ends;
  for (std::uint32_t node = 0; node < size(); ++node)
    if (degree_of(node) == 1) ends.push_back(node);
  return ends;
}

void NodeGraph::connect(std::uint32_t a, std::uint32_t b) {
  if (a == b) return;
  const auto insert = [&](std::uint32_t node, std::uint32_t neighbor) {
    auto& list = neighbors_[node];
    const auto place = std::lower_bound(list.begin(), list.end(), neighbor);
    if (place == list.end() || *place != neighbor) list.insert(place, neighbor);
  };
  insert(a, b);
  insert(b, a);
}

void NodeGraph::disconnect(std::uint32_t a, std::uint32_t b) {
  std::erase(neighbors_[a], b);
  std::erase(neighbors_[b], a);
}

void NodeGraph::isolate(std::uint32_t node) {
  for (const std::uint32_t neighbor : neighbors_[node]) std::erase(neighbors_[neighbor], node);
  neighbors_[node].clear();
}

void NodeGraph::take_out(const NodeChain& chain) {
  for (std::size_t i = 1; i < chain.nodes.size(); ++i) disconnect(chain.nodes[i - 1], chain.nodes[i]);
  if (chain.is_loop) disconnect(chain.nodes.back(), chain.nodes.front());
}

void NodeGraph::drop_parts(double min_size, const PartSize& size_of) {
  std::vector<bool> seen(size());
  std::vector<std::uint32_t> part;
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (seen[start] || degree_of(start) == 0) continue;
    seen[start] = true;
    part.assign(1, start);
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (const std::uint32_t neighbor : neighbors_[part[i]]) {
        if (seen[neighbor]) continue;
        seen[neighbor] = true;
        part.push_back(neighbor);
      }
    }
    if (size_of(part) < min_size)
      for (const std::uint32_t node : part) neighbors_[node].clear();
  }
}

void NodeGraph::drop_small_parts(std::size_t min_nodes) {
  drop_parts(static_cast<double>(min_nodes),
             [](std::span<const std::uint32_t> part) { return static_cast<double>(part.size()); });
}

void NodeGraph::prune_branches(double min_length, const ChainLength& length_of) {
  // A branch can only grow while it waits: when its junction becomes a middle.
  using Entry = std::pair<double, std::uint32_t>;  // length, end
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> branches;
  const auto length_from = [&](std::uint32_t end) {
    const NodeChain chain = chain_from(end, neighbors_[end].front());
    const bool is_branch = degree_of(chain.nodes.back()) > 2;
    return is_branch ? length_of(chain) : std::numeric_limits<double>::infinity();
  };
  for (const std::uint32_t end : ends()) branches.emplace(length_from(end), end);
  while (!branches.empty() && branches.top().first < min_length) {
    const auto [length, end] = branches.top();
    branches.pop();
    if (const double now = length_from(end); now != length) branches.emplace(now, end);
    else take_out(chain_from(end, neighbors_[end].front()));
  }
}

void NodeGraph::prune_short_branches(std::size_t min_edges) {
  prune_branches(static_cast<double>(min_edges),
                 [](const NodeChain& chain) { return static_cast<double>(chain.nodes.size() - 1); });
}

void NodeGraph::drop_branches() {
  for (std::uint32_t end : ends()) {
    while (degree_of(end) == 1) {
      const std::uint32_t next = neighbors_[end].front();
      disconnect(end, next);
      end = next;
    }
  }
}

NodeChain NodeGraph::chain_from(std::uint32_t start, std::uint32_t next) const {
  NodeChain chain{.nodes = {start}};
  std::uint32_t before = start;
  while (next != start) {
    chain.nodes.push_back(next);
    if (degree_of(next) != 2) return chain;
    const auto& around = neighbors_[next];
    before = std::exchange(next, around[0] == before ? around[1] : around[0]);
  }
  chain.is_loop = true;
  return chain;
}

std::vector<NodeChain> NodeGraph::chains() const {
  std::vector<NodeChain> chains;
  std::vector<bool> is_done(size());  // of nodes of degree 2
  const auto add = [&](NodeChain chain) {
    for (const std::uint32_t node : chain.nodes) is_done[node] = true;
    chains.push_back(std::move(chain));
  };
  for (std::uint32_t start = 0; start < size(); ++start) {
    if (degree_of(start) == 2) continue;
    for (const std::uint32_t next : neighbors_[start])
      if (degree_of(next) == 2 ? !is_done[next] : start < next) add(chain_from(start, next));
  }
  for (std::uint32_t start = 0; start < size(); ++start)
    if (degree_of(start) == 2 && !is_done[start]) add(chain_from(start, neighbors_[start].front()));
  return chains;
}

}  // namespace keenline
