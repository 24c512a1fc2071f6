#include "keenline/io/graph_dxf.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "keenline/feature_graph.h"
#include "keenline/io/graph_text.h"
#include "keenline/io/sink.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/progress.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Handles name the objects of a file. Those of the fixed parts lie below first_entity.
constexpr std::uint64_t no_owner = 0;
constexpr std::uint64_t model_space = 1;
constexpr std::uint64_t paper_space = 2;
constexpr std::uint64_t root_dictionary = 3;
constexpr std::uint64_t group_dictionary = 4;
constexpr std::uint64_t first_fixed = 0x10;
constexpr std::uint64_t first_entity = 0x100;

struct Layer {
  std::string_view name;
  int color;  // in AutoCAD's index
};
constexpr Layer creases{"CREASES", 1};
constexpr Layer borders{"BORDERS", 5};
constexpr Layer corners{"CORNERS", 3};

/// The axes in which DXF gives the plane of a circle: its "arbitrary axis algorithm".
struct ObjectAxes {
  Point x;
  Point y;
  Point z;

  explicit ObjectAxes(const Point& normal) : z(normal) {
    constexpr double near_pole = 1.0 / 64;
    const bool is_near_pole = std::abs(z[0]) < near_pole && std::abs(z[1]) < near_pole;
    x = unit(cross(is_near_pole ? Point{0, 1, 0} : Point{0, 0, 1}, z));
    y = unit(cross(z, x));
  }
  [[nodiscard]] Point coordinates(const Point& p) const { return {dot(p, x), dot(p, y), dot(p, z)}; }
};

bool is_fitted(const Polyline& line) { return !std::holds_alternative<std::monostate>(line.fitted); }

/// A POLYLINE is an object of its own, and so is each vertex and the end of their sequence.
std::uint64_t handle_count(const Polyline& line) { return is_fitted(line) ? 1 : line.vertices.size() + 2; }

class DxfWriter {
 public:
  DxfWriter(const FeatureGraph& graph, Sink& sink, Progress& progress)
      : graph_(graph), sink_(sink), progress_(progress), extent_(extent_of(graph)) {}

  void write() {
    write_header();
    write_tables();
    write_blocks();
    write_entities();
    write_objects();
    code(0, "EOF");
    flush();
  }

 private:
  void code(int group, std::string_view value) {
    fmt::format_to(std::back_inserter(text_), "{}\n{}\n", group, value);
  }
  void code(int group, int value) { fmt::format_to(std::back_inserter(text_), "{}\n{}\n", group, value); }
  void code(int group, double value) {
    fmt::format_to(std::back_inserter(text_), "{}\n", group);
    append_number(text_, value);
    text_ += '\n';
  }
  void point(int group, const Point& p) {
    for (int axis = 0; axis < 3; ++axis) code(group + 10 * axis, p[static_cast<std::size_t>(axis)]);
  }
  void handle(int group, std::uint64_t value) {
    fmt::format_to(std::back_inserter(text_), "{}\n{:X}\n", group, value);
  }
  void flush() {
    sink_.write(text_);
    text_.clear();
  }

  void begin_section(std::string_view name) {
    code(0, "SECTION");
    code(2, name);
  }
  void end_section() {
    code(0, "ENDSEC");
    flush();
  }

  void write_header() {
    std::uint64_t next = first_entity + graph_.corners.size();
    for (const Polyline& line : graph_.polylines) next += handle_count(line);
    begin_section("HEADER");
    code(9, "$ACADVER");
    code(1, "AC1015");
    code(9, "$HANDSEED");
    handle(5, next);
    code(9, "$EXTMIN");
    // Without anything in it, a drawing reaches from 1e20 to -1e20.
    point(10, extent_.is_empty() ? Point{1e20, 1e20, 1e20} : extent_.low);
    code(9, "$EXTMAX");
    point(10, extent_.is_empty() ? Point{-1e20, -1e20, -1e20} : extent_.high);
    code(9, "$INSUNITS");
    code(70, 0);
    end_section();
    begin_section("CLASSES");
    end_section();
  }

  // --- tables: CAD programs expect each of them, though most have nothing to say

  /// Returns the table's handle.
  std::uint64_t begin_table(std::string_view name, int entries) {
    const std::uint64_t table = next_fixed_++;
    code(0, "TABLE");
    code(2, name);
    handle(5, table);
    handle(330, no_owner);
    code(100, "AcDbSymbolTable");
    code(70, entries);
    return table;
  }
  void begin_entry(std::string_view type, std::uint64_t table, std::uint64_t number, std::string_view marker,
                   std::string_view name) {
    code(0, type);
    handle(type == "DIMSTYLE" ? 105 : 5, number);
    handle(330, table);
    code(100, "AcDbSymbolTableRecord");
    code(100, marker);
    code(2, name);
  }
  void end_table() { code(0, "ENDTAB"); }

  void write_tables() {
    begin_section("TABLES");
    write_view_table();
    write_line_types();
    write_layers();
    write_text_style();
    for (const std::string_view name : {"VIEW", "UCS"}) {
      (void)begin_table(name, 0);
      end_table();
    }
    const std::uint64_t applications = begin_table("APPID", 1);
    begin_entry("APPID", applications, next_fixed_++, "AcDbRegAppTableRecord", "ACAD");
    code(70, 0);
    end_table();
    const std::uint64_t dimension_styles = begin_table("DIMSTYLE", 1);
    code(100, "AcDbDimStyleTable");
    begin_entry("DIMSTYLE", dimension_styles, next_fixed_++, "AcDbDimStyleTableRecord", "Standard");
    code(70, 0);
    end_table();
    const std::uint64_t records = begin_table("BLOCK_RECORD", 2);
    begin_entry("BLOCK_RECORD", records, model_space, "AcDbBlockTableRecord", "*Model_Space");
    begin_entry("BLOCK_RECORD", records, paper_space, "AcDbBlockTableRecord", "*Paper_Space");
    end_table();
    end_section();
  }

  /// So that the drawing fills the window when it is opened, far from the origin too.
  void write_view_table() {
    const auto middle = [&](std::size_t axis) {
      return extent_.is_empty() ? 0 : 0.5 * extent_.low[axis] + 0.5 * extent_.high[axis];
    };
    const double height = std::max(extent_.high[0] - extent_.low[0], extent_.high[1] - extent_.low[1]);
    const std::uint64_t table = begin_table("VPORT", 1);
    begin_entry("VPORT", table, next_fixed_++, "AcDbViewportTableRecord", "*Active");
    code(70, 0);
    const auto pair = [&](int group, double x, double y) {
      code(group, x);
      code(group + 10, y);
    };
    pair(10, 0, 0);  // in the window: from corner to corner
    pair(11, 1, 1);
    pair(12, middle(0), middle(1));
    point(16, {0, 0, 1});  // seen from above
    point(17, {0, 0, 0});
    code(40, height > 0 ? 1.1 * height : 1.0);
    code(41, 1.0);
    code(42, 50.0);
    end_table();
  }

  void write_line_types() {
    const std::uint64_t table = begin_table("LTYPE", 3);
    for (const std::string_view name : {"ByBlock", "ByLayer", "Continuous"}) {
      begin_entry("LTYPE", table, next_fixed_++, "AcDbLinetypeTableRecord", name);
      code(70, 0);
      code(3, name == "Continuous" ? "Solid line" : "");
      code(72, 65);
      code(73, 0);
      code(40, 0.0);
    }
    end_table();
  }

  void write_layers() {
    const std::initializer_list<Layer> layers{{"0", 7}, creases, borders, corners};
    const std::uint64_t table = begin_table("LAYER", static_cast<int>(layers.size()));
    for (const Layer& layer : layers) {
      begin_entry("LAYER", table, next_fixed_++, "AcDbLayerTableRecord", layer.name);
      code(70, 0);
      code(62, layer.color);
      code(6, "Continuous");
    }
    end_table();
  }

  void write_text_style() {
    const std::uint64_t table = begin_table("STYLE", 1);
    begin_entry("STYLE", table, next_fixed_++, "AcDbTextStyleTableRecord", "Standard");
    code(70, 0);
    code(40, 0.0);
    code(41, 1.0);
    code(50, 0.0);
    code(71, 0);
    code(42, 1.0);
    code(3, "txt");
    code(4, "");
    end_table();
  }

  void write_blocks() {
    begin_section("BLOCKS");
    for (const std::uint64_t record : {model_space, paper_space}) {
      const std::string_view name = record == model_space ? "*Model_Space" : "*Paper_Space";
      begin_object("BLOCK", next_fixed_++, record, "0");
      code(100, "AcDbBlockBegin");
      code(2, name);
      code(70, 0);
      point(10, {0, 0, 0});
      code(3, name);
      code(1, "");
      begin_object("ENDBLK", next_fixed_++, record, "0");
      code(100, "AcDbBlockEnd");
    }
    end_section();
  }

  void write_objects() {
    begin_section("OBJECTS");
    code(0, "DICTIONARY");
    handle(5, root_dictionary);
    handle(330, no_owner);
    code(100, "AcDbDictionary");
    code(281, 1);
    code(3, "ACAD_GROUP");
    handle(350, group_dictionary);
    code(0, "DICTIONARY");
    handle(5, group_dictionary);
    handle(330, root_dictionary);
    code(100, "AcDbDictionary");
    code(281, 1);
    end_section();
  }

  // --- the drawing

  void begin_object(std::string_view type, std::uint64_t number, std::uint64_t owner,
                    std::string_view layer) {
    code(0, type);
    handle(5, number);
    handle(330, owner);
    code(100, "AcDbEntity");
    code(8, layer);
  }
  void begin_entity(std::string_view type) { begin_object(type, next_entity_++, model_space, layer_); }

  void write_entities() {
    begin_section("ENTITIES");
    for (const Polyline& line : graph_.polylines) {
      progress_.check();
      layer_ = line.kind == LineKind::Crease ? creases.name : borders.name;
      closed_ = line.closed;
      if (is_fitted(line)) std::visit([&](const auto& curve) { write_curve(curve); }, line.fitted);
      else write_polyline(line);
      flush();
    }
    layer_ = corners.name;
    for (const GraphCorner& corner : graph_.corners) {
      begin_entity("POINT");
      code(100, "AcDbPoint");
      point(10, corner.position);
      flush();
    }
    end_section();
  }

  void write_polyline(const Polyline& line) {
    constexpr int closed = 1;
    constexpr int in_space = 8;
    constexpr int vertex_in_space = 32;
    const std::uint64_t polyline = next_entity_;
    begin_entity("POLYLINE");
    code(100, "AcDb3dPolyline");
    code(66, 1);
    point(10, {0, 0, 0});
    code(70, in_space | (line.closed ? closed : 0));
    for (const Point& p : line.vertices) {
      begin_object("VERTEX", next_entity_++, polyline, layer_);
      code(100, "AcDbVertex");
      code(100, "AcDb3dPolylineVertex");
      point(10, p);
      code(70, vertex_in_space);
    }
    begin_object("SEQEND", next_entity_++, polyline, layer_);
  }

  void write_curve(const std::monostate& /*none*/) {}

  void write_curve(const FittedLine& line) {
    begin_entity("LINE");
    code(100, "AcDbLine");
    point(10, line.start);
    point(11, line.end);
  }

  void write_curve(const FittedArc& arc) {
    const ObjectAxes axes(arc.normal);
    const bool is_circle = arc.sweep_deg == 360;
    begin_entity(is_circle ? "CIRCLE" : "ARC");
    code(100, "AcDbCircle");
    point(10, axes.coordinates(arc.center));
    code(40, arc.radius);
    point(210, arc.normal);
    if (is_circle) return;
    const auto in_turn = [](double degrees) {
      if (degrees < 0) degrees += 360;
      return degrees >= 360 ? degrees - 360 : degrees;
    };
    const double start =
        in_turn(kernels::angle_of(dot(arc.x_axis, axes.y), dot(arc.x_axis, axes.x)) * (180 / kernels::pi));
    code(100, "AcDbArc");
    code(50, start);
    code(51, in_turn(start + arc.sweep_deg));
  }

  void write_curve(const FittedSpline& spline) {
    begin_entity("SPLINE");
    code(100, "AcDbSpline");
    code(70, closed_ ? 1 : 0);
    code(71, 3);
    code(72, static_cast<int>(spline.knots.size()));
    code(73, static_cast<int>(spline.control_points.size()));
    code(74, 0);
    for (const double knot : spline.knots) code(40, knot);
    for (const Point& p : spline.control_points) point(10, p);
  }

  const FeatureGraph& graph_;
  Sink& sink_;
  Progress& progress_;
  Extent extent_;
  std::string text_;
  std::uint64_t next_fixed_ = first_fixed;
  std::uint64_t next_entity_ = first_entity;
  std::string_view layer_;  // of the line at hand
  bool closed_ = false;     // whether that is closed
};

}  // namespace

void write_graph_dxf(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  DxfWriter(graph, sink, progress).write();
}

}  // namespace keenline
