#include "keenline/io/graph_obj.h"

#include <cstddef>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "keenline/io/graph_text.h"
#include "keenline/io/graph_vertices.h"
#include "keenline/io/sink.h"
#include "keenline/progress.h"

namespace keenline {

void write_graph_obj(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  const GraphVertices vertices = number_vertices(graph);
  std::string text;
  for (const Point& p : vertices.positions) {
    text = "v";
    for (const double coordinate : p) append_number(text += ' ', coordinate);
    sink.write(text += '\n');
  }
  // OBJ counts from 1.
  for (const LineKind kind : {LineKind::Crease, LineKind::Border}) {
    sink.write(kind == LineKind::Crease ? "g creases\n" : "g borders\n");
    for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
      if (graph.polylines[i].kind != kind) continue;
      progress.check();
      text = "l";
      for (const std::uint32_t number : vertices.lines[i])
        fmt::format_to(std::back_inserter(text), " {}", std::uint64_t{number} + 1);
      if (graph.polylines[i].closed)
        fmt::format_to(std::back_inserter(text), " {}", std::uint64_t{vertices.lines[i].front()} + 1);
      sink.write(text += '\n');
    }
  }
  sink.write("g corners\n");
  for (std::size_t i = 0; i < graph.corners.size(); ++i) sink.write(fmt::format("p {}\n", i + 1));
}

}  // namespace keenline
