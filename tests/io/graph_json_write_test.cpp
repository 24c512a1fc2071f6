#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/graph_json.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

TEST(GraphJsonWrite, IsWhatTheHeaderSays) {
  FeatureGraph graph;
  graph.corners = {{{0, 0, 0}, 0.5}, {{3, 4, 0}, {}}};
  graph.polylines = {{.vertices = {{0, 0, 0}, {3, 4, 0}}, .start_corner = 0, .end_corner = 1, .support = 7}};
  graph.polylines.push_back({.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, .closed = true});
  graph.polylines[1].kind = LineKind::Border;
  graph.polylines[1].dihedral_deg = {90, 90.5, 91};
  graph.polylines[1].fitted = FittedArc{};
  EXPECT_EQ(
      test::written(write_graph_json, graph),
      "{\"crs\": null,\n"
      "\"corners\": [\n"
      "{\"position\": [0, 0, 0], \"residual\": 0.5},\n"
      "{\"position\": [3, 4, 0]}],\n"
      "\"polylines\": [\n"
      "{\"vertices\": [[0, 0, 0], [3, 4, 0]], \"closed\": false, \"kind\": \"crease\", \"corners\": [0, 1], "
      "\"length\": 5, \"support\": 7},\n"
      "{\"vertices\": [[1, 0, 0], [0, 1, 0], [-1, 0, 0]], \"closed\": true, \"kind\": \"border\", "
      "\"corners\": [null, null], \"length\": 4.82842712474619, \"support\": 0, "
      "\"dihedral_deg\": [90, 90.5, 91], \"curve\": {\"type\": \"arc\", \"center\": [0, 0, 0], "
      "\"normal\": [0, 0, 1], \"x_axis\": [1, 0, 0], \"radius\": 1, \"sweep_deg\": 360}}]}\n");
}

TEST(GraphJsonWrite, AnEmptyGraphIsAFile) {
  EXPECT_EQ(test::written(write_graph_json, {}), "{\"crs\": null,\n\"corners\": [],\n\"polylines\": []}\n");
}

TEST(GraphJsonWrite, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_json(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
