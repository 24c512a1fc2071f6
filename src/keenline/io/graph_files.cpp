#include "keenline/io/graph_files.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <list>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/graph_dxf.h"
#include "keenline/io/graph_geojson.h"
#include "keenline/io/graph_gpkg.h"
#include "keenline/io/graph_json.h"
#include "keenline/io/graph_obj.h"
#include "keenline/io/graph_ply.h"
#include "keenline/io/graph_step.h"
#include "keenline/io/output_file.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

constexpr std::array table{
    GraphFormat{".dxf", write_graph_dxf},         GraphFormat{".gpkg", write_graph_gpkg},
    GraphFormat{".geojson", write_graph_geojson}, GraphFormat{".json", write_graph_json},
    GraphFormat{".obj", write_graph_obj},         GraphFormat{".ply", write_graph_ply},
    GraphFormat{".step", write_graph_step},       GraphFormat{".stp", write_graph_step},
};
/// Those at the end of the table.
constexpr std::size_t step_formats = 2;

}  // namespace

std::span<const GraphFormat> graph_formats() {
  return std::span(table).first(has_step() ? table.size() : table.size() - step_formats);
}

std::string graph_extensions() {
  const auto formats = graph_formats();
  std::string text(formats[0].extension);
  for (std::size_t i = 1; i < formats.size(); ++i)
    text += fmt::format("{}{}", i + 1 < formats.size() ? ", " : " or ", formats[i].extension);
  return text;
}

const GraphFormat& find_graph_format(std::string_view path) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const GraphFormat& format) {
    return path.size() > format.extension.size() &&
           starts_with_ignoring_case(path.substr(path.size() - format.extension.size()), format.extension);
  });
  const auto possible = static_cast<std::ptrdiff_t>(graph_formats().size());
  if (found - table.begin() < possible) return *found;
  throw InvalidArgument(fmt::format("output {}: {}expected a name that ends in {}", quoted(path, 4096),
                                    found != table.end() ? "this build has no STEP (no OpenCASCADE), " : "",
                                    graph_extensions()));
}

void write_graph(std::span<const std::string> paths, const FeatureGraph& graph, Progress& progress,
                 const std::function<void()>& before_commit) {
  validate(graph);
  for (const std::string& path : paths) (void)find_graph_format(path);
  require_distinct_outputs(paths);
  progress.begin("writing", 0);
  std::list<OutputFile> files;
  for (const std::string& path : paths) {
    OutputFile& file = files.emplace_back(path);
    find_graph_format(path).write(graph, file, progress);
    file.store();
  }
  progress.check();
  if (before_commit) before_commit();
  for (OutputFile& file : files) file.commit();
}

FeatureGraph read_graph(const std::string& path) { return read_graph_json(MappedFile(path).source()); }

}  // namespace keenline
