#include "keenline/io/graph_files.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/graph_step.h"

#include "support/expect_error.h"
#include "support/sample_graph.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::TemporaryFolder;

std::vector<std::string> all_names(const TemporaryFolder& folder) {
  std::vector<std::string> paths;
  for (const GraphFormat& format : graph_formats())
    paths.push_back(folder.file("a" + std::string(format.extension)));
  return paths;
}

TEST(GraphFiles, ExtensionChoosesTheFormat) {
  EXPECT_EQ(find_graph_format("a.b.DXF").extension, ".dxf");
  EXPECT_EQ(find_graph_format("a.geojson").extension, ".geojson");
  EXPECT_EQ(find_graph_format("a.json").extension, ".json");
  for (const char* const path : {"a", ".dxf", "a.dwg", "dxf", "a.dxf.gz"}) {
    test::expect_error<InvalidArgument>([&] { (void)find_graph_format(path); }, path, graph_extensions());
  }
}

TEST(GraphFiles, StepNeedsOpenCascade) {
  if (has_step()) {
    EXPECT_EQ(find_graph_format("a.stp").extension, ".stp");
    EXPECT_EQ(graph_extensions(), ".dxf, .gpkg, .geojson, .json, .obj, .ply, .step or .stp");
  } else {
    test::expect_error<InvalidArgument>([] { (void)find_graph_format("a.step"); }, "'a.step'", "OpenCASCADE",
                                        ".dxf, .gpkg, .geojson, .json, .obj or .ply");
  }
}

TEST(GraphFiles, AllAppearTogether) {
  const TemporaryFolder folder;
  const std::vector<std::string> paths = all_names(folder);
  bool asked = false;
  write_graph(paths, test::sample_graph(), no_progress(), [&] {
    asked = true;
    for (const std::string& path : paths) EXPECT_FALSE(std::filesystem::exists(path));
  });
  EXPECT_TRUE(asked);
  EXPECT_EQ(folder.entries(), paths.size());
  for (const std::string& path : paths) EXPECT_FALSE(TemporaryFolder::read(path).empty()) << path;
}

TEST(GraphFiles, TheSameGraphGivesTheSameBytesAndAnEmptyOneAFile) {
  const TemporaryFolder folder;
  for (const FeatureGraph& graph : {test::sample_graph(), FeatureGraph()}) {
    for (const GraphFormat& format : graph_formats()) {
      const std::string text = test::written(format.write, graph);
      EXPECT_FALSE(text.empty());
      EXPECT_EQ(test::written(format.write, graph), text) << format.extension;
    }
  }
}

TEST(GraphFiles, OneFailureLeavesNothing) {
  const TemporaryFolder folder;
  std::vector<std::string> paths = all_names(folder);
  paths.push_back(folder.file("missing/a.obj"));
  EXPECT_THROW(write_graph(paths, test::sample_graph()), OutputError);
  paths.back() = folder.file("a.dwg");
  EXPECT_THROW(write_graph(paths, test::sample_graph()), InvalidArgument);
  paths.back() = folder.file("./a.obj");
  test::expect_error<InvalidArgument>([&] { write_graph(paths, test::sample_graph()); }, "named twice");
  paths.pop_back();
  FeatureGraph broken = test::sample_graph();
  broken.polylines[1].vertices.clear();
  EXPECT_THROW(write_graph(paths, broken), InvalidArgument);
  EXPECT_THROW(
      write_graph(paths, test::sample_graph(), no_progress(), [] { throw OutputError("stdout", "full"); }),
      OutputError);
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(GraphFiles, JsonIsReadBack) {
  const TemporaryFolder folder;
  const std::vector<std::string> paths{folder.file("a.json")};
  write_graph(paths, test::sample_graph());
  EXPECT_EQ(read_graph(paths[0]).polylines[1].vertices, test::sample_graph().polylines[1].vertices);
  test::expect_error<InputError>([&] { (void)read_graph(folder.file("none.json")); }, "none.json");
}

}  // namespace
}  // namespace keenline
