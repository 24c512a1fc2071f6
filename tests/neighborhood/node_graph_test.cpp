#include "keenline/neighborhood/node_graph.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

using Nodes = std::vector<std::uint32_t>;

NodeGraph ring(std::uint32_t count, std::uint32_t others = 0) {
  NodeGraph graph(count + others);
  for (std::uint32_t i = 0; i < count; ++i) graph.connect(i, (i + 1) % count);
  return graph;
}

std::size_t edge_count(const NodeGraph& graph) {
  std::size_t degrees = 0;
  for (std::uint32_t node = 0; node < graph.size(); ++node) degrees += graph.degree_of(node);
  return degrees / 2;
}

/// A path 0 … last with branches of the given lengths at the given nodes.
NodeGraph comb(std::uint32_t last, const std::vector<std::pair<std::uint32_t, std::uint32_t>>& branches) {
  std::uint32_t count = last + 1;
  for (const auto& [root, length] : branches) count += length;
  NodeGraph graph(count);
  for (std::uint32_t i = 0; i < last; ++i) graph.connect(i, i + 1);
  std::uint32_t next = last + 1;
  for (const auto& [root, length] : branches) {
    for (std::uint32_t i = 0; i < length; ++i, ++next) graph.connect(i == 0 ? root : next - 1, next);
  }
  return graph;
}

TEST(NodeGraph, ConnectsOnceAndNeverToItself) {
  NodeGraph graph(3);
  graph.connect(2, 1);
  graph.connect(1, 2);
  graph.connect(1, 0);
  graph.connect(1, 1);
  EXPECT_EQ(edge_count(graph), 2U);
  EXPECT_EQ(graph.ends(), (Nodes{0, 2}));
  const auto neighbors = graph.neighbors_of(1);
  EXPECT_EQ(Nodes(neighbors.begin(), neighbors.end()), (Nodes{0, 2})) << "rising";
  graph.disconnect(0, 1);
  EXPECT_EQ(graph.ends(), (Nodes{1, 2}));
  graph.connect(0, 1);
  graph.isolate(1);
  EXPECT_EQ(edge_count(graph), 0U);
}

TEST(NodeGraph, ChainsAreTakenOutWhole) {
  NodeGraph graph = ring(5, 1);
  graph.connect(2, 5);
  const NodeGraph whole = graph;
  graph.take_out(whole.chains().front());
  EXPECT_EQ(edge_count(graph), 1U) << "the loop with the way back to its first node";
  graph.take_out(whole.chains().back());
  EXPECT_EQ(edge_count(graph), 0U);
}

TEST(NodeGraph, DropsSmallParts) {
  NodeGraph graph(6);
  graph.connect(0, 1);
  graph.connect(1, 2);
  graph.connect(3, 4);
  graph.drop_small_parts(3);
  EXPECT_EQ(edge_count(graph), 2U);
  EXPECT_EQ(graph.degree_of(3), 0U);
  graph.drop_small_parts(4);
  EXPECT_EQ(edge_count(graph), 0U);
}

TEST(NodeGraph, PrunesShortBranchesAndKeepsEnds) {
  NodeGraph graph = comb(20, {{7, 3}, {12, 5}});
  graph.prune_short_branches(4);
  EXPECT_EQ(edge_count(graph), 25U);
  EXPECT_EQ(graph.degree_of(7), 2U);
  EXPECT_EQ(graph.degree_of(12), 3U);
  graph.prune_short_branches(100);
  EXPECT_EQ(edge_count(graph), 13U + 7U) << "12 to 20 is 8 long, the branch 5, 0 to 12 is 12";
  EXPECT_EQ(graph.degree_of(20), 1U);
}

TEST(NodeGraph, WhatABranchLeavesBehindMayBeLongEnough) {
  // Both ends of the path hang 3 from a junction, but without the branch of 2 they are one path of 6 and 4.
  NodeGraph graph = comb(10, {{3, 2}, {6, 9}});
  graph.prune_short_branches(4);
  EXPECT_EQ(edge_count(graph), 10U + 9U);
  EXPECT_EQ(graph.degree_of(3), 2U);
  EXPECT_EQ(graph.degree_of(0), 1U);
}

TEST(NodeGraph, LoopsStayWithoutWhatHangsOnThem) {
  NodeGraph graph = ring(12, 11);
  for (std::uint32_t i = 12; i < 20; ++i) graph.connect(i == 12 ? 4 : i - 1, i);
  graph.connect(14, 20);
  graph.connect(21, 22);
  graph.drop_branches();
  EXPECT_EQ(edge_count(graph), 12U);
  for (std::uint32_t node = 0; node < 12; ++node) EXPECT_EQ(graph.degree_of(node), 2U);
}

TEST(NodeGraph, ChainsHoldEveryEdgeOnce) {
  std::vector<NodeChain> chains = comb(4, {}).chains();
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_EQ(chains[0].nodes, (Nodes{0, 1, 2, 3, 4}));
  EXPECT_FALSE(chains[0].is_loop);

  chains = ring(6).chains();
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_TRUE(chains[0].is_loop);
  EXPECT_EQ(chains[0].nodes, (Nodes{0, 1, 2, 3, 4, 5}));

  // A loop of six on a stem: the junction is its first node.
  NodeGraph hung = ring(6, 2);
  hung.connect(3, 6);
  hung.connect(6, 7);
  chains = hung.chains();
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

TEST(NodeGraph, NothingIsAGraphToo) {
  NodeGraph graph(0);
  graph.drop_small_parts(3);
  graph.prune_short_branches(3);
  graph.drop_branches();
  EXPECT_TRUE(graph.chains().empty());
  EXPECT_TRUE(NodeGraph(7).chains().empty());
}

}  // namespace
}  // namespace keenline
