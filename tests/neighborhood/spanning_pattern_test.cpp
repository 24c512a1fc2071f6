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

std::size_t edge_count(const SpanningPattern& pattern) {
  std::size_t degrees = 0;
  for (std::uint32_t node = 0; node < pattern.size(); ++node) degrees += pattern.degree_of(node);
  return degrees / 2;
}

/// A path 0 … last with branches of the given lengths at the given nodes.
SpanningPattern comb(std::uint32_t last, const std::vector<std::pair<std::uint32_t, int>>& branches) {
  std::vector<WeightedEdge> edges;
  for (std::uint32_t i = 0; i < last; ++i) edges.push_back({i, i + 1, 1});
  std::uint32_t next = last + 1;
  for (const auto& [root, length] : branches) {
    std::uint32_t from = root;
    for (int i = 0; i < length; ++i) {
      edges.push_back({from, next, 1});
      from = next++;
    }
  }
  return {next, edges, 100};
}

TEST(SpanningPattern, CyclesGrowWithTheRootOfTheCloud) {
  EXPECT_EQ(shortest_cycle_for(0, 3), 3U);
  EXPECT_EQ(shortest_cycle_for(100, 5), 5U);
  EXPECT_EQ(shortest_cycle_for(12000, 5), 54U);
  EXPECT_NO_THROW(require_cycle(1));
  EXPECT_THROW(require_cycle(0), InvalidArgument);
}

TEST(SpanningPattern, ClosesCyclesThatAreLongEnough) {
  EXPECT_EQ(edge_count(SpanningPattern(10, ring(10), 9)), 9U);
  EXPECT_EQ(edge_count(SpanningPattern(10, ring(10), 8)), 10U);
  EXPECT_EQ(edge_count(SpanningPattern(10, ring(10), 1000)), 9U);
}

TEST(SpanningPattern, LeavesOutTheHeaviestEdgeOfAShortCycle) {
  std::vector<WeightedEdge> edges = ring(5);
  edges[2].weight = 2;
  SpanningPattern pattern(5, edges, 100);
  EXPECT_EQ(pattern.degree_of(2), 1U);
  EXPECT_EQ(pattern.degree_of(3), 1U);
  edges[2].weight = 1;  // equal ones: the largest pair of nodes
  pattern = SpanningPattern(5, edges, 100);
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
    for (; !front.empty(); front.pop())
      for (const std::uint32_t next : graph[front.front()])
        if (distance[next] == nodes) {
          distance[next] = distance[front.front()] + 1;
          front.push(next);
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
    const SpanningPattern pattern(80, edges, longest);
    for (std::uint32_t node = 0; node < 80; ++node) {
      const auto found = pattern.neighbors_of(node);
      EXPECT_EQ(Nodes(found.begin(), found.end()), expected[node]) << longest << ' ' << node;
    }
  }
}

TEST(SpanningPattern, DropsSmallComponents) {
  std::vector<WeightedEdge> edges{{0, 1, 1}, {1, 2, 1}, {3, 4, 1}};
  SpanningPattern pattern(6, edges, 10);
  pattern.drop_components_below(3);
  EXPECT_EQ(edge_count(pattern), 2U);
  EXPECT_EQ(pattern.degree_of(3), 0U);
  pattern.drop_components_below(4);
  EXPECT_EQ(edge_count(pattern), 0U);
}

TEST(SpanningPattern, PrunesShortBranchesAndKeepsEnds) {
  SpanningPattern pattern = comb(20, {{7, 3}, {12, 5}});
  pattern.prune_chains_below(4);
  EXPECT_EQ(edge_count(pattern), 25U);
  EXPECT_EQ(pattern.degree_of(7), 2U);
  EXPECT_EQ(pattern.degree_of(12), 3U);
  pattern.prune_chains_below(100);
  EXPECT_EQ(edge_count(pattern), 13U + 7U) << "12 to 20 is 8 long, the branch 5, 0 to 12 is 12";
  EXPECT_EQ(pattern.degree_of(20), 1U);
}

TEST(SpanningPattern, WhatABranchLeavesBehindMayBeLongEnough) {
  // Both ends of the path hang 3 from a junction, but without the branch of 2 they are one path of 6 and 4.
  SpanningPattern pattern = comb(10, {{3, 2}, {6, 9}});
  pattern.prune_chains_below(4);
  EXPECT_EQ(edge_count(pattern), 10U + 9U);
  EXPECT_EQ(pattern.degree_of(3), 2U);
  EXPECT_EQ(pattern.degree_of(0), 1U);
}

TEST(SpanningPattern, LoopsStayWithoutWhatHangsOnThem) {
  std::vector<WeightedEdge> edges = ring(12);
  for (std::uint32_t i = 12; i < 20; ++i) edges.push_back({i == 12 ? 4 : i - 1, i, 1});
  edges.push_back({14, 20, 1});
  edges.push_back({21, 22, 1});
  SpanningPattern pattern(23, edges, 5);
  pattern.keep_loops();
  EXPECT_EQ(edge_count(pattern), 12U);
  for (std::uint32_t node = 0; node < 12; ++node) EXPECT_EQ(pattern.degree_of(node), 2U);
}

TEST(SpanningPattern, ChainsHoldEveryEdgeOnce) {
  SpanningPattern path = comb(4, {});
  std::vector<PatternChain> chains = path.chains();
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].nodes, (Nodes{0, 1, 2, 3, 4}));
  EXPECT_FALSE(chains[0].is_loop);

  chains = SpanningPattern(6, ring(6), 3).chains();
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].is_loop);
  EXPECT_EQ(chains[0].nodes, (Nodes{0, 1, 2, 3, 4, 5}));

  // A loop of six on a stem: the junction is its first node.
  std::vector<WeightedEdge> edges = ring(6);
  edges.push_back({3, 6, 1});
  edges.push_back({6, 7, 1});
  chains = SpanningPattern(8, edges, 3).chains();
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_EQ(chains[0].nodes, (Nodes{3, 2, 1, 0, 5, 4}));
  EXPECT_TRUE(chains[0].is_loop);
  EXPECT_EQ(chains[1].nodes, (Nodes{3, 6, 7}));
  EXPECT_FALSE(chains[1].is_loop);

  chains = comb(4, {{2, 1}}).chains();
  ASSERT_EQ(chains.size(), 3U);
  EXPECT_EQ(chains[0].nodes, (Nodes{0, 1, 2}));
  EXPECT_EQ(chains[1].nodes, (Nodes{2, 3, 4}));
  EXPECT_EQ(chains[2].nodes, (Nodes{2, 5}));
}

TEST(SpanningPattern, NothingIsAPatternToo) {
  SpanningPattern pattern(0, {}, 5);
  pattern.drop_components_below(3);
  pattern.prune_chains_below(3);
  pattern.keep_loops();
  EXPECT_TRUE(pattern.chains().empty());
  EXPECT_TRUE(SpanningPattern(7, {}, 5).chains().empty());
}

TEST(SpanningPattern, CanBeCancelled) {
  EXPECT_THROW((void)SpanningPattern(5, ring(5), 3, test::CancelledProgress()), Cancelled);
}

}  // namespace
}  // namespace keenline
