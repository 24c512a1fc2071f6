// Any bytes either make a graph that every format can hold and that comes back from .json, or are refused
// with an InputError; nothing else.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/graph_json.h"
#include "keenline/io/graph_step.h"
#include "keenline/io/sink.h"
#include "keenline/io/source.h"

namespace {

void require(bool fact) {
  if (!fact) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  keenline::FeatureGraph graph;
  try {
    graph = keenline::read_graph_json({"fuzz", {reinterpret_cast<const char*>(data), size}});
  } catch (const keenline::InputError& e) {
    require(std::string_view(e.what()).find('\n') == std::string_view::npos);
    return 0;
  }
  for (const keenline::GraphFormat& format : keenline::graph_formats()) {
    if (format.write == keenline::write_graph_step)
      continue;  // OpenCASCADE refuses what is shorter than 1e-7
    keenline::StringSink sink;
    format.write(graph, sink, keenline::no_progress());
    if (format.extension != ".json") continue;
    keenline::StringSink again;
    format.write(keenline::read_graph_json({"back", sink.text}), again, keenline::no_progress());
    require(again.text == sink.text);
  }
  return 0;
}
