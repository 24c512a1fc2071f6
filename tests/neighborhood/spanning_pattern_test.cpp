#include "keenline/neighborhood/spanning_pattern.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <queue>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"

namespace keenline {
namespace {

using Nodes = std::vector<std::uint32_t>;

std::vector<WeightedEdge> ring(std::uint32_t count) {
  std::vector<WeightedEdge> edges;
  for (std::uint32_t i = 0; i < count; ++i)
    edges.push_back({std::min(i, (i + 1) % count), std::max(i, (i + 1) % count), 1});
  return edges;
}

std::size_t edge_count(const NodeGraph& pattern) {
  std::size_t degrees = 0;
  for (std::uint32_t node = 0; node < pattern.size(); ++node) degrees += pattern.degree_of(node);
  return degrees / 2;
}

TEST(SpanningPattern, CyclesGrowWithTheRootOfTheCloud) {
  EXPECT_EQ(shortest_cycle_for(0, 3), 3U);
  EXPECT_EQ(shortest_cycle_for(100, 5), 5U);
  EXPECT_EQ(shortest_cycle_for(12000, 5), 54U);
  EXPECT_NO_THROW(require_cycle(1));
  EXPECT_THROW(require_cycle(0), InvalidArgument);
}

TEST(SpanningPattern, ClosesCyclesThatAreLongEnough) {
  EXPECT_EQ(edge_count(spanning_pattern(10, ring(10), 9)), 9U);
  EXPECT_EQ(edge_count(spanning_pattern(10, ring(10), 8)), 10U);
  EXPECT_EQ(edge_count(spanning_pattern(10, ring(10), 1000)), 9U);
}

TEST(SpanningPattern, LeavesOutTheHeaviestEdgeOfAShortCycle) {
  std::vector<WeightedEdge> edges = ring(5);
  edges[2].weight = 2;
  NodeGraph pattern = spanning_pattern(5, edges, 100);
  EXPECT_EQ(pattern.degree_of(2), 1U);
  EXPECT_EQ(pattern.degree_of(3), 1U);
  edges[2].weight = 1;  // equal ones: the largest pair of nodes
  pattern = spanning_pattern(5, edges, 100);
  EXPECT_EQ(pattern.degree_of(3), 1U);
  EXPECT_EQ(pattern.degree_of(4), 1U);
}

/// Kruskal's algorithm as it is written down, every detour searched from one side.
std::vector<Nodes> by_the_book(std::size_t nodes, std::vector<WeightedEdge> edges, std::size_t longest) {
  std::stable_sort(edges.begin(), edges.end(), [](const WeightedEdge& x, const WeightedEdge& y) {
    if (x.weight != y.weight) return x.weight < y.weight;
    return x.a != y.a ? x.a < y.a : x.b < y.b;
  });
  std::vector<Nodes> graph(nodes);
  for (const WeightedEdge& edge : edges) {
    std::vector<std::size_t> distance(nodes, nodes);
    std::queue<std::uint32_t> front({edge.a});
    distance[edge.a] = 0;
    for (; !front.empty(); front.pop()) {
      for (const std::uint32_t next : graph[front.front()]) {
        if (distance[next] < nodes) continue;
        distance[next] = distance[front.front()] + 1;
        front.push(next);
      }
    }
    if (distance[edge.b] < nodes && distance[edge.b] <= longest) continue;
    graph[edge.a].push_back(edge.b);
    graph[edge.b].push_back(edge.a);
  }
  for (Nodes& neighbors : graph) std::sort(neighbors.begin(), neighbors.end());
  return graph;
}

TEST(SpanningPattern, IsWhatTheBookSays) {
  std::mt19937 random(3);
  for (const std::size_t longest : {1U, 2U, 5U, 11U}) {
    std::vector<WeightedEdge> edges;
    for (std::uint32_t a = 0; a < 80; ++a)
      for (std::uint32_t b = a + 1; b < 80; ++b)
        if (random() % 20 == 0) edges.push_back({a, b, static_cast<double>(random() % 8)});
    const std::vector<Nodes> expected = by_the_book(80, edges, longest);
    std::shuffle(edges.begin(), edges.end(), random);
    const NodeGraph pattern = spanning_pattern(80, edges, longest);
    for (std::uint32_t node = 0; node < 80; ++node) {
      const auto found = pattern.neighbors_of(node);
      EXPECT_EQ(Nodes(found.begin(), found.end()), expected[node]) << longest << ' ' << node;
    }
  }
}

TEST(SpanningPattern, NothingIsAPatternToo) {
  EXPECT_EQ(spanning_pattern(0, {}, 5).size(), 0U);
  EXPECT_TRUE(spanning_pattern(7, {}, 5).chains().empty());
}

TEST(SpanningPattern, CanBeCancelled) {
  EXPECT_THROW((void)spanning_pattern(5, ring(5), 3, test::CancelledProgress()), Cancelled);
}

}  // namespace
}  // namespace keenline
