#include "keenline/io/graph_geojson.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

using nlohmann::json;

json parsed(const FeatureGraph& graph) { return json::parse(test::written(write_graph_geojson, graph)); }

TEST(GraphGeojson, LinesAndCornersAreFeatures) {
  const FeatureGraph graph = test::sample_graph();
  const json document = parsed(graph);
  EXPECT_EQ(document["type"], "FeatureCollection");
  EXPECT_EQ(document["keenline"]["crs"], "EPSG:25832");
  ASSERT_EQ(document["features"].size(), 5U);

  const json& crease = document["features"][0];
  EXPECT_EQ(crease["type"], "Feature");
  EXPECT_EQ(crease["geometry"]["type"], "LineString");
  EXPECT_EQ(crease["geometry"]["coordinates"].get<std::vector<Point>>(), graph.polylines[0].vertices);
  EXPECT_EQ(crease["properties"], (json{{"kind", "crease"},
                                        {"line", 0},
                                        {"closed", false},
                                        {"length", length_of(graph.polylines[0])},
                                        {"start_corner", 0},
                                        {"end_corner", 1},
                                        {"support", 12},
                                        {"dihedral_deg", 92},
                                        {"residual", 0.5}}));
  const json& corner = document["features"][4];
  EXPECT_EQ(corner["geometry"]["type"], "Point");
  EXPECT_EQ(corner["geometry"]["coordinates"].get<Point>(), graph.corners[1].position);
  EXPECT_EQ(corner["properties"], (json{{"kind", "corner"}, {"corner", 1}, {"residual", nullptr}}));
}

TEST(GraphGeojson, AClosedLineEndsWhereItBegins) {
  const json line = parsed(test::sample_graph())["features"][1];
  const auto positions = line["geometry"]["coordinates"].get<std::vector<Point>>();
  ASSERT_EQ(positions.size(), 4U);
  EXPECT_EQ(positions.front(), positions.back());
  EXPECT_EQ(line["properties"]["start_corner"], nullptr);
}

TEST(GraphGeojson, AnEmptyGraphIsAFile) {
  const json document = parsed({});
  EXPECT_EQ(document["features"], json::array());
  EXPECT_EQ(document["keenline"]["crs"], nullptr);
}

TEST(GraphGeojson, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_geojson(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
