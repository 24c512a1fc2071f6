#include "keenline/io/graph_gpkg.h"

#include <cstdint>
#include <memory>
#include <sqlite3.h>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/records.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

using Row = std::vector<std::string>;

/// The rows of a query on what the writer makes of a graph; NULL as "NULL".
std::vector<Row> query(const FeatureGraph& graph, const char* sql) {
  std::string bytes = test::written(write_graph_gpkg, graph);
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(":memory:", &database), SQLITE_OK);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> closing(database, sqlite3_close);
  EXPECT_EQ(sqlite3_deserialize(database, "main", reinterpret_cast<unsigned char*>(bytes.data()),
                                static_cast<sqlite3_int64>(bytes.size()),
                                static_cast<sqlite3_int64>(bytes.size()), SQLITE_DESERIALIZE_READONLY),
            SQLITE_OK);
  sqlite3_stmt* statement = nullptr;
  EXPECT_EQ(sqlite3_prepare_v2(database, sql, -1, &statement, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  std::vector<Row> rows;
  while (sqlite3_step(statement) == SQLITE_ROW) {
    Row& row = rows.emplace_back();
    for (int i = 0; i < sqlite3_column_count(statement); ++i) {
      const auto* const value = static_cast<const char*>(sqlite3_column_blob(statement, i));
      const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, i));
      if (sqlite3_column_type(statement, i) == SQLITE_NULL) row.emplace_back("NULL");
      else row.emplace_back(value == nullptr ? std::string() : std::string(value, size));
    }
  }
  sqlite3_finalize(statement);
  return rows;
}

TEST(GraphGpkg, IsAWholeGeoPackage) {
  for (const FeatureGraph& graph : {test::sample_graph(), FeatureGraph()}) {
    EXPECT_EQ(query(graph, "PRAGMA application_id")[0][0], std::to_string(0x47504B47));
    EXPECT_EQ(query(graph, "PRAGMA user_version")[0][0], "10300");
    EXPECT_EQ(query(graph, "PRAGMA integrity_check")[0][0], "ok");
    EXPECT_TRUE(query(graph, "PRAGMA foreign_key_check").empty());
    EXPECT_EQ(query(graph,
                    "SELECT table_name, column_name, geometry_type_name, z, m FROM gpkg_geometry_columns "
                    "ORDER BY rowid"),
              (std::vector<Row>{{"feature_lines", "geom", "LINESTRING", "1", "0"},
                                {"feature_corners", "geom", "POINT", "1", "0"}}));
  }
}

TEST(GraphGpkg, LinesHaveAttributes) {
  const auto rows =
      query(test::sample_graph(),
            "SELECT fid, kind, closed, start_corner, end_corner, support, dihedral_deg, residual "
            "FROM feature_lines ORDER BY fid");
  EXPECT_EQ(rows, (std::vector<Row>{{"1", "crease", "0", "1", "2", "12", "92.0", "0.5"},
                                    {"2", "border", "1", "NULL", "NULL", "0", "NULL", "NULL"},
                                    {"3", "crease", "0", "2", "NULL", "0", "NULL", "NULL"}}));
}

TEST(GraphGpkg, GeometriesHoldTheVerticesToTheBit) {
  const FeatureGraph graph = test::sample_graph();
  const auto rows = query(graph, "SELECT geom FROM feature_lines ORDER BY fid");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string& blob = rows[i][0];
    std::vector<Point> expected = graph.polylines[i].vertices;
    if (graph.polylines[i].closed) expected.push_back(expected.front());
    ASSERT_EQ(blob.size(), 8 + 48 + 9 + 24 * expected.size());
    EXPECT_EQ(blob.substr(0, 4), std::string("GP\0\x05", 4));
    EXPECT_EQ(load<std::int32_t>(&blob[4]), 25832);
    EXPECT_EQ(blob[56], 1);
    EXPECT_EQ(load<std::uint32_t>(&blob[57]), 1002U);
    EXPECT_EQ(load<std::uint32_t>(&blob[61]), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double value = load<double>(&blob[65 + 24 * k + 8 * axis]);
        EXPECT_EQ(value, expected[k][axis]);
        EXPECT_LE(load<double>(&blob[8 + 16 * axis]), value);
        EXPECT_GE(load<double>(&blob[16 + 16 * axis]), value);
      }
    }
  }
  const std::string corner = query(graph, "SELECT geom FROM feature_corners WHERE fid = 1")[0][0];
  EXPECT_EQ(load<std::uint32_t>(&corner[57]), 1001U);
  EXPECT_EQ(load<double>(&corner[61]), graph.corners[0].position[0]);
}

TEST(GraphGpkg, ReferenceSystemIsThatOfTheGraph) {
  constexpr const char* systems =
      "SELECT srs_id, organization, organization_coordsys_id, definition FROM gpkg_spatial_ref_sys "
      "WHERE srs_id NOT IN (-1, 0, 4326)";
  constexpr const char* used = "SELECT DISTINCT srs_id FROM gpkg_contents";
  FeatureGraph graph = test::sample_graph();
  EXPECT_EQ(query(graph, systems), (std::vector<Row>{{"25832", "EPSG", "25832", "undefined"}}));
  EXPECT_EQ(query(graph, used), (std::vector<Row>{{"25832"}}));
  graph.crs = "PROJCS[\"mine\"]";
  EXPECT_EQ(query(graph, systems), (std::vector<Row>{{"100000", "NONE", "100000", graph.crs}}));
  graph.crs = "epsg:4326";
  EXPECT_TRUE(query(graph, systems).empty());
  EXPECT_EQ(query(graph, used), (std::vector<Row>{{"4326"}}));
  graph.crs.clear();
  EXPECT_EQ(query(graph, used), (std::vector<Row>{{"-1"}}));
  EXPECT_EQ(query(graph, "SELECT count(*) FROM gpkg_spatial_ref_sys"), (std::vector<Row>{{"3"}}));
}

TEST(GraphGpkg, ExtentsCoverTheTableAndAreNullWithoutRows) {
  constexpr const char* extents = "SELECT min_x, max_y FROM gpkg_contents ORDER BY rowid";
  EXPECT_EQ(query(test::sample_graph(), extents),
            (std::vector<Row>{{"0.0", "5400000.001"}, {"4500000.123", "5400000.001"}}));
  EXPECT_EQ(query({}, extents), (std::vector<Row>{{"NULL", "NULL"}, {"NULL", "NULL"}}));
}

TEST(GraphGpkg, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_gpkg(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
