#include "keenline/io/graph_gpkg.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <sqlite3.h>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/io/graph_attributes.h"
#include "keenline/io/records.h"
#include "keenline/io/sink.h"
#include "keenline/io/text.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

/// The tables that OGC 12-128r17 (GeoPackage 1.3) asks for, its three reference systems, and ours.
constexpr const char* schema = R"sql(
PRAGMA page_size = 4096;
-- What was in a page before must not show in the file: same graph, same bytes.
PRAGMA secure_delete = ON;
PRAGMA application_id = 0x47504B47;
PRAGMA user_version = 10300;
BEGIN;
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (
  table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL,
  srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name),
  CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE feature_lines (
  fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom LINESTRING, kind TEXT, closed BOOLEAN, length DOUBLE,
  start_corner INTEGER, end_corner INTEGER, support INTEGER, dihedral_deg DOUBLE, residual DOUBLE);
CREATE TABLE feature_corners (
  fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom POINT, residual DOUBLE);
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined Cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AUTHORITY["EPSG","4326"]]',
   'longitude/latitude coordinates in decimal degrees on the WGS 84 spheroid');
)sql";

[[noreturn]] void fail(int code) {
  if (code == SQLITE_NOMEM) throw std::bad_alloc();
  throw OutputError("GeoPackage", fmt::format("SQLite: {}", sqlite3_errstr(code)));
}

/// In memory, so that the bytes take the same way to the disk as those of every other format.
class Database {
 public:
  Database() {
    sqlite3* database = nullptr;
    const int code =
        sqlite3_open_v2(":memory:", &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
    database_.reset(database);
    if (code != SQLITE_OK) fail(code);
  }

  [[nodiscard]] sqlite3* get() const { return database_.get(); }

  void run(const char* sql) {
    const int code = sqlite3_exec(get(), sql, nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) fail(code);
  }

  void write_to(Sink& sink) {
    sqlite3_int64 size = 0;
    const std::unique_ptr<unsigned char, decltype(&sqlite3_free)> bytes(
        sqlite3_serialize(get(), "main", &size, 0), sqlite3_free);
    if (!bytes) throw std::bad_alloc();
    sink.write({reinterpret_cast<const char*>(bytes.get()), static_cast<std::size_t>(size)});
  }

 private:
  std::unique_ptr<sqlite3, decltype(&sqlite3_close)> database_{nullptr, sqlite3_close};
};

/// An INSERT whose places are filled from left to right, row after row.
class Insertion {
 public:
  Insertion(Database& database, const char* sql) {
    sqlite3_stmt* statement = nullptr;
    check(sqlite3_prepare_v2(database.get(), sql, -1, &statement, nullptr));
    statement_.reset(statement);
  }

  Insertion& add(std::int64_t value) { return check(sqlite3_bind_int64(get(), ++place_, value)); }
  Insertion& add(double value) { return check(sqlite3_bind_double(get(), ++place_, value)); }
  Insertion& add(std::string_view text) {
    return check(
        sqlite3_bind_text64(get(), ++place_, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  }
  Insertion& add_blob(std::string_view bytes) {
    return check(sqlite3_bind_blob64(get(), ++place_, bytes.data(), bytes.size(), SQLITE_TRANSIENT));
  }
  template <typename T>
  Insertion& add(const std::optional<T>& value) {
    return value ? add(*value) : check(sqlite3_bind_null(get(), ++place_));
  }
  void insert() {
    if (const int code = sqlite3_step(get()); code != SQLITE_DONE) fail(code);
    check(sqlite3_reset(get()));
    place_ = 0;
  }

 private:
  [[nodiscard]] sqlite3_stmt* get() const { return statement_.get(); }
  Insertion& check(int code) {
    if (code != SQLITE_OK) fail(code);
    return *this;
  }

  std::unique_ptr<sqlite3_stmt, decltype(&sqlite3_finalize)> statement_{nullptr, sqlite3_finalize};
  int place_ = 0;
};

template <typename T>
void append(std::string& bytes, T value) {
  bytes.resize(bytes.size() + sizeof value);
  store(value, bytes.data() + bytes.size() - sizeof value);
}

void append(std::string& bytes, const Point& p) {
  for (const double coordinate : p)
    append(bytes, coordinate + 0.0);  // no minus zero, as in the other formats
}

/// A GeoPackageBinary blob as far as its ISO WKB geometry: little endian, with an envelope in x, y and z.
std::string geometry_head(const Extent& extent, std::int32_t srs_id, std::uint32_t type) {
  constexpr char version = 0;
  constexpr char little_endian_xyz_envelope = 0b0000'0101;
  std::string bytes{'G', 'P', version, little_endian_xyz_envelope};
  append(bytes, srs_id);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    append(bytes, extent.low[axis]);
    append(bytes, extent.high[axis]);
  }
  bytes += '\1';
  append(bytes, type);
  return bytes;
}

constexpr std::uint64_t largest_integer = std::numeric_limits<std::int64_t>::max();
constexpr std::uint32_t wkb_point_z = 1001;
constexpr std::uint32_t wkb_line_string_z = 1002;

struct ReferenceSystem {
  std::int32_t id = -1;
  bool is_known = true;  // one of the three that every GeoPackage holds
  std::string organization = "NONE";
  std::string definition;
};

ReferenceSystem reference_system(const std::string& crs) {
  if (crs.empty()) return {};
  std::int32_t code = 0;
  if (starts_with_ignoring_case(crs, "epsg:") &&
      parse_number(std::string_view(crs).substr(5), code) == Parsed::Ok && code > 0) {
    return {code, code == 4326, "EPSG", "undefined"};
  }
  constexpr std::int32_t first_free_id = 100000;
  return {first_free_id, false, "NONE", crs};
}

class GpkgWriter {
 public:
  GpkgWriter(const FeatureGraph& graph, Progress& progress)
      : graph_(graph), progress_(progress), system_(reference_system(graph.crs)) {}

  void write(Sink& sink) {
    database_.run(schema);
    if (!system_.is_known) {
      Insertion(database_, "INSERT INTO gpkg_spatial_ref_sys VALUES (?,?,?,?,?,?)")
          .add(std::string_view("coordinate reference system of the point cloud"))
          .add(std::int64_t{system_.id})
          .add(std::string_view(system_.organization))
          .add(std::int64_t{system_.id})
          .add(std::string_view(system_.definition))
          .add(std::string_view())
          .insert();
    }
    describe("feature_lines", "LINESTRING", write_lines());
    describe("feature_corners", "POINT", write_corners());
    database_.run("COMMIT");
    database_.write_to(sink);
  }

 private:
  /// A corner's number as its fid.
  static std::optional<std::int64_t> fid_of(std::optional<std::uint32_t> corner) {
    return corner ? std::optional(std::int64_t{*corner} + 1) : std::nullopt;
  }

  Extent write_lines() {
    Extent all;
    Insertion row(database_, "INSERT INTO feature_lines VALUES (?,?,?,?,?,?,?,?,?,?)");
    std::int64_t fid = 0;
    for (const Polyline& line : graph_.polylines) {
      progress_.check();
      const LineAttributes attributes = attributes_of(line);
      row.add(++fid).add_blob(geometry_of(line, all)).add(attributes.kind);
      row.add(std::int64_t{attributes.closed}).add(attributes.length);
      row.add(fid_of(attributes.start_corner)).add(fid_of(attributes.end_corner));
      // SQLite's integers have a sign.
      row.add(static_cast<std::int64_t>(std::min<std::uint64_t>(attributes.support, largest_integer)));
      row.add(attributes.dihedral_deg).add(attributes.residual).insert();
    }
    return all;
  }

  std::string geometry_of(const Polyline& line, Extent& all) const {
    Extent extent;
    for (const Point& p : line.vertices) extent.include(p);
    all.include(extent.low);
    all.include(extent.high);
    std::string bytes = geometry_head(extent, system_.id, wkb_line_string_z);
    append(bytes, static_cast<std::uint32_t>(line.vertices.size() + (line.closed ? 1 : 0)));
    for (const Point& p : line.vertices) append(bytes, p);
    if (line.closed) append(bytes, line.vertices.front());
    return bytes;
  }

  Extent write_corners() {
    Extent all;
    Insertion row(database_, "INSERT INTO feature_corners VALUES (?,?,?)");
    std::int64_t fid = 0;
    for (const GraphCorner& corner : graph_.corners) {
      progress_.check();
      Extent extent;
      extent.include(corner.position);
      all.include(corner.position);
      std::string bytes = geometry_head(extent, system_.id, wkb_point_z);
      append(bytes, corner.position);
      row.add(++fid).add_blob(bytes).add(corner.residual).insert();
    }
    return all;
  }

  void describe(std::string_view table, std::string_view geometry, const Extent& extent) {
    const auto bound = [&](double value) { return extent.is_empty() ? std::nullopt : std::optional(value); };
    Insertion(database_,
              "INSERT INTO gpkg_contents VALUES (?,'features',?,'','1970-01-01T00:00:00.000Z',?,?,?,?,?)")
        .add(table)
        .add(table)
        .add(bound(extent.low[0]))
        .add(bound(extent.low[1]))
        .add(bound(extent.high[0]))
        .add(bound(extent.high[1]))
        .add(std::int64_t{system_.id})
        .insert();
    Insertion(database_, "INSERT INTO gpkg_geometry_columns VALUES (?,'geom',?,?,1,0)")
        .add(table)
        .add(geometry)
        .add(std::int64_t{system_.id})
        .insert();
  }

  const FeatureGraph& graph_;
  Progress& progress_;
  ReferenceSystem system_;
  Database database_;
};

}  // namespace

void write_graph_gpkg(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  GpkgWriter(graph, progress).write(sink);
}

}  // namespace keenline
