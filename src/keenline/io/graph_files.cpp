#include "keenline/io/graph_files.h"

#include <algorithm>
#include <array>
#include <list>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/io/graph_dxf.h"
#include "keenline/io/graph_geojson.h"
#include "keenline/io/graph_gpkg.h"
#include "keenline/io/graph_json.h"
#include "keenline/io/graph_obj.h"
#include "keenline/io/graph_ply.h"
#include "keenline/io/output_file.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

constexpr std::array table{
    GraphFormat{".dxf", "DXF R2000: 3D polylines, circles, arcs and splines in layers", write_graph_dxf},
    GraphFormat{".gpkg", "GeoPackage: LINESTRING Z and POINT Z with attributes", write_graph_gpkg},
    GraphFormat{".geojson", "GeoJSON: LineString and Point with properties", write_graph_geojson},
    GraphFormat{".json", "the whole graph; can be read back", write_graph_json},
    GraphFormat{".obj", "Wavefront OBJ: line elements", write_graph_obj},
    GraphFormat{".ply", "PLY with edges, binary", write_graph_ply},
};

}  // namespace

std::span<const GraphFormat> graph_formats() { return table; }

const GraphFormat& find_graph_format(std::string_view path) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const GraphFormat& format) {
    return path.size() > format.extension.size() &&
           starts_with_ignoring_case(path.substr(path.size() - format.extension.size()), format.extension);
  });
  if (found != table.end()) return *found;
  std::vector<std::string_view> known;
  for (const GraphFormat& format : table) known.push_back(format.extension);
  throw InvalidArgument(
      fmt::format("output {}: expected a name that ends in {}", quoted(path, 4096), fmt::join(known, ", ")));
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
