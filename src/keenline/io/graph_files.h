#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "keenline/feature_graph.h"
#include "keenline/progress.h"

namespace keenline {

class Sink;

/// One row of the table of formats that hold a drawing.
struct GraphFormat {
  std::string_view extension;  ///< ".dxf"
  void (*write)(const FeatureGraph& graph, Sink& sink, Progress& progress);
};

/// Those that this build can write: STEP only where it was built with OpenCASCADE.
[[nodiscard]] std::span<const GraphFormat> graph_formats();

/// ".dxf, .gpkg, … or .ply"
[[nodiscard]] std::string graph_extensions();

/// By the extension of `path`, in any case. \throw InvalidArgument naming all there are when it is no such
/// format.
[[nodiscard]] const GraphFormat& find_graph_format(std::string_view path);

/// Writes the graph to each of the paths, in the format of its extension: all beside their targets first,
/// flushed, then `before_commit` is called, then all are renamed. What fails before leaves every target as it
/// was. \throw InvalidArgument for an invalid graph, another extension, or one file named twice;
/// OutputError; Cancelled.
void write_graph(std::span<const std::string> paths, const FeatureGraph& graph,
                 Progress& progress = no_progress(), const std::function<void()>& before_commit = {});

/// Reads what was written as .json, bit for bit. \throw InputError; OutOfMemory.
[[nodiscard]] FeatureGraph read_graph(const std::string& path);

}  // namespace keenline
