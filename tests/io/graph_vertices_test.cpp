#include "keenline/io/graph_vertices.h"

#include <gtest/gtest.h>

#include "support/sample_graph.h"

namespace keenline {
namespace {

using Numbers = std::vector<std::uint32_t>;

TEST(GraphVertices, CornersComeFirstAndAreShared) {
  const FeatureGraph graph = test::sample_graph();
  const GraphVertices vertices = number_vertices(graph);
  EXPECT_EQ(vertices.lines, (std::vector<Numbers>{{0, 2, 1}, {3, 4, 5}, {1, 6}}));
  ASSERT_EQ(vertices.positions.size(), 7U);
  for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
    for (std::size_t k = 0; k < vertices.lines[i].size(); ++k)
      EXPECT_EQ(vertices.positions[vertices.lines[i][k]], graph.polylines[i].vertices[k]);
  }
}

TEST(GraphVertices, AnEndThatMissesItsCornerKeepsItsPlace) {
  FeatureGraph graph = test::sample_graph();
  graph.polylines[0].vertices.back()[2] += 0.001;
  EXPECT_EQ(number_vertices(graph).lines[0], (Numbers{0, 2, 3}));
}

TEST(GraphVertices, AClosedLineSharesItsCornerOnce) {
  FeatureGraph graph;
  graph.corners = {{{0, 0, 0}, {}}};
  graph.polylines = {
      {.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, .closed = true, .start_corner = 0, .end_corner = 0}};
  EXPECT_EQ(number_vertices(graph).lines[0], (Numbers{0, 1, 2}));
}

}  // namespace
}  // namespace keenline
