#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "keenline/io/graph_json.h"
#include "keenline/io/graph_text.h"
#include "keenline/io/sink.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr auto append_point = [](std::string& text, const Point& p) { append_json(text, p); };
constexpr auto append_sides = [](std::string& text, const SideNormals& normals) {
  append_json(text += '[', normals.left);
  append_json(text += ", ", normals.right);
  text += ']';
};

struct AppendCurve {
  std::string& text;

  void operator()(const std::monostate& /*none*/) const {}
  void operator()(const FittedLine& line) const {
    append_json(text += R"(, "curve": {"type": "line", "start": )", line.start);
    append_json(text += R"(, "end": )", line.end);
    text += '}';
  }
  void operator()(const FittedArc& arc) const {
    append_json(text += R"(, "curve": {"type": "arc", "center": )", arc.center);
    append_json(text += R"(, "normal": )", arc.normal);
    append_json(text += R"(, "x_axis": )", arc.x_axis);
    append_number(text += R"(, "radius": )", arc.radius);
    append_number(text += R"(, "sweep_deg": )", arc.sweep_deg);
    text += '}';
  }
  void operator()(const FittedSpline& spline) const {
    append_json_list(text += R"(, "curve": {"type": "spline", "control_points": )", spline.control_points,
                     append_point);
    append_json_list(text += R"(, "knots": )", spline.knots, append_number);
    text += '}';
  }
};

std::string text_of(const GraphCorner& corner) {
  std::string text = R"({"position": )";
  append_json(text, corner.position);
  if (corner.residual) append_number(text += R"(, "residual": )", *corner.residual);
  return text + '}';
}

std::string text_of(const Polyline& line) {
  const auto number_or_null = [](const std::optional<std::uint32_t>& corner) {
    return corner ? fmt::format("{}", *corner) : "null";
  };
  std::string text = R"({"vertices": )";
  append_json_list(text, line.vertices, append_point);
  fmt::format_to(std::back_inserter(text), R"(, "closed": {}, "kind": "{}", "corners": [{}, {}], "length": )",
                 line.closed, name_of(line.kind), number_or_null(line.start_corner),
                 number_or_null(line.end_corner));
  append_number(text, length_of(line));
  fmt::format_to(std::back_inserter(text), R"(, "support": {})", line.support);
  if (!line.dihedral_deg.empty())
    append_json_list(text += R"(, "dihedral_deg": )", line.dihedral_deg, append_number);
  if (!line.normals.empty()) append_json_list(text += R"(, "normals": )", line.normals, append_sides);
  if (!line.residual.empty()) append_json_list(text += R"(, "residual": )", line.residual, append_number);
  std::visit(AppendCurve{text}, line.fitted);
  return text + '}';
}

template <typename T>
void write_list(const std::vector<T>& items, Sink& sink, Progress& progress) {
  std::string_view separator = "\n";
  for (const T& item : items) {
    progress.check();
    sink.write(separator);
    sink.write(text_of(item));
    separator = ",\n";
  }
}

}  // namespace

void write_graph_json(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  std::string head = R"({"crs": )";
  if (graph.crs.empty()) head += "null";
  else append_json(head, graph.crs);
  sink.write(head + ",\n\"corners\": [");
  write_list(graph.corners, sink, progress);
  sink.write("],\n\"polylines\": [");
  write_list(graph.polylines, sink, progress);
  sink.write("]}\n");
}

}  // namespace keenline
