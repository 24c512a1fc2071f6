#include "keenline/io/graph_geojson.h"

#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "keenline/io/graph_attributes.h"
#include "keenline/io/graph_text.h"
#include "keenline/io/sink.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

void append_property(std::string& text, std::string_view name, std::optional<double> value) {
  fmt::format_to(std::back_inserter(text), ", \"{}\": ", name);
  if (value) append_number(text, *value);
  else text += "null";
}

std::string corner_feature(const GraphCorner& corner, std::size_t number) {
  std::string text = R"({"type": "Feature", "geometry": {"type": "Point", "coordinates": )";
  append_json(text, corner.position);
  fmt::format_to(std::back_inserter(text), R"(}}, "properties": {{"kind": "corner", "corner": {})", number);
  append_property(text, "residual", corner.residual);
  return text + "}}";
}

std::string line_feature(const Polyline& line, std::size_t number) {
  std::string text = R"({"type": "Feature", "geometry": {"type": "LineString", "coordinates": )";
  append_json_list(text, line.vertices, [](std::string& to, const Point& p) { append_json(to, p); });
  if (line.closed) {
    text.back() = ',';
    append_json(text += ' ', line.vertices.front());
    text += ']';
  }
  const LineAttributes attributes = attributes_of(line);
  fmt::format_to(std::back_inserter(text), R"(}}, "properties": {{"kind": "{}", "line": {}, "closed": {})",
                 attributes.kind, number, attributes.closed);
  append_property(text, "length", attributes.length);
  append_property(text, "start_corner", attributes.start_corner);
  append_property(text, "end_corner", attributes.end_corner);
  fmt::format_to(std::back_inserter(text), R"(, "support": {})", attributes.support);
  append_property(text, "dihedral_deg", attributes.dihedral_deg);
  append_property(text, "residual", attributes.residual);
  return text + "}}";
}

}  // namespace

void write_graph_geojson(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  std::string head = "{\"type\": \"FeatureCollection\",\n\"keenline\": {\"crs\": ";
  if (graph.crs.empty()) head += "null";
  else append_json(head, graph.crs);
  sink.write(head +
             ", \"coordinates\": \"those of the point cloud, not converted to WGS 84\"},\n\"features\": [");

  std::string_view separator = "\n";
  const auto add = [&](const std::string& feature) {
    progress.check();
    sink.write(separator);
    sink.write(feature);
    separator = ",\n";
  };
  for (std::size_t i = 0; i < graph.polylines.size(); ++i) add(line_feature(graph.polylines[i], i));
  for (std::size_t i = 0; i < graph.corners.size(); ++i) add(corner_feature(graph.corners[i], i));
  sink.write("\n]}\n");
}

}  // namespace keenline
