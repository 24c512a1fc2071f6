#include "keenline/io/graph_json.h"

#include <string>
#include <variant>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

FeatureGraph read(const std::string& text) { return read_graph_json({"g.json", text}); }

TEST(GraphJson, ComesBackBitForBit) {
  FeatureGraph graph = test::sample_graph();
  graph.polylines[0].fitted = FittedLine{{1, 2, 3}, {0.1, 0.2, 1e-300}};
  graph.polylines[1].fitted = FittedArc{{1e7, 0, 0}, {0.6, 0, 0.8}, {0, 1, 0}, 2.5, 359.9};
  graph.polylines[2].fitted =
      FittedSpline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {0, 0, 0, 0, 1, 1, 1, 1}};
  const std::string text = test::written(write_graph_json, graph);
  const FeatureGraph back = read(text);
  EXPECT_EQ(test::written(write_graph_json, back), text);
  EXPECT_EQ(back.crs, graph.crs);
  ASSERT_EQ(back.polylines.size(), 3U);
  EXPECT_EQ(back.corners[0].position, graph.corners[0].position);
  EXPECT_EQ(back.corners[0].residual, 0.25);
  EXPECT_FALSE(back.corners[1].residual);
  for (std::size_t i = 0; i < 3; ++i) {
    const Polyline& line = back.polylines[i];
    const Polyline& expected = graph.polylines[i];
    EXPECT_EQ(line.vertices, expected.vertices);
    EXPECT_EQ(line.closed, expected.closed);
    EXPECT_EQ(line.kind, expected.kind);
    EXPECT_EQ(line.start_corner, expected.start_corner);
    EXPECT_EQ(line.end_corner, expected.end_corner);
    EXPECT_EQ(line.support, expected.support);
    EXPECT_EQ(line.dihedral_deg, expected.dihedral_deg);
    EXPECT_EQ(line.residual, expected.residual);
    ASSERT_EQ(line.normals.size(), expected.normals.size());
    EXPECT_EQ(line.fitted.index(), expected.fitted.index());
  }
  EXPECT_EQ(back.polylines[0].normals[2].right, (Point{0.6, 0.8, 0}));
  EXPECT_EQ(std::get<FittedArc>(back.polylines[1].fitted).normal, (Point{0.6, 0, 0.8}));
  EXPECT_EQ(std::get<FittedSpline>(back.polylines[2].fitted).knots[4], 1);
}

TEST(GraphJson, NeedsLittleAndPassesOverTheUnknown) {
  const FeatureGraph graph = read(
      R"({"author": {"name": [1, {}]}, "corners": [], "polylines": [{"vertices": [[0,0,0],[1,0,0]], "length": "long"}]})");
  ASSERT_EQ(graph.polylines.size(), 1U);
  EXPECT_EQ(graph.polylines[0].kind, LineKind::Crease);
  EXPECT_FALSE(graph.polylines[0].closed);
}

TEST(GraphJson, RefusesWhatIsNotAGraphByItsPlace) {
  struct Case {
    std::string text;
    std::string place;
    std::string message;
  };
  const auto with_line = [](const std::string& line) {
    return R"({"corners": [], "polylines": [)" + line + "]}";
  };
  const std::string vertices = R"("vertices": [[0, 0, 0], [1, 0, 0]])";
  const std::vector<Case> cases{
      {"", "byte 0", "the end of the file"},
      {"{\"corners\": [}", "byte 13", "'}'"},
      {"[1e999]", "g.json", "too large for a double"},
      {"[]", "the whole", "found an array of 0, expected an object"},
      {"{}", "the whole", "a member 'corners'"},
      {R"({"corners": [{}], "polylines": []})", "corners[0]", "a member 'position'"},
      {R"({"corners": [{"position": [1, "2", 3]}], "polylines": []})", "corners[0].position[1]", "found '2'"},
      {R"({"corners": {}, "polylines": []})", "corners", "expected an array"},
      {R"({"crs": 5, "corners": [], "polylines": []})", "crs", "found 5, expected a string"},
      {with_line("3"), "polylines[0]", "expected an object"},
      {with_line(R"({"vertices": [[0, 0, 0], [1, 0]]})"), "polylines[0].vertices[1]", "an array of 2"},
      {with_line("{" + vertices + R"(, "closed": 1})"), "polylines[0].closed", "true or false"},
      {with_line("{" + vertices + R"(, "kind": "ridge"})"), "polylines[0].kind", "crease or border"},
      {with_line("{" + vertices + R"(, "corners": [-1, null]})"), "polylines[0].corners[0]",
       "an integer from 0"},
      {with_line("{" + vertices + R"(, "corners": [0.5, null]})"), "polylines[0].corners[0]",
       "an integer from 0"},
      {with_line("{" + vertices + R"(, "corners": [0, null]})"), "polyline 0", "corner 0 of 0"},
      {with_line("{" + vertices + R"(, "dihedral_deg": [90]})"), "polyline 0", "1 dihedral angles"},
      {with_line("{" + vertices + R"(, "curve": {"type": "ellipse"}})"), "polylines[0].curve.type", "arc"},
      {with_line(R"({"vertices": []})"), "polyline 0", "0 vertices"}};
  for (const Case& c : cases)
    test::expect_error<InputError>([&] { (void)read(c.text); }, "g.json", c.place, c.message);
}

TEST(GraphJson, DeepNestingIsNoStackOverflow) {
  const std::string deep(200000, '[');
  test::expect_error<InputError>([&] { (void)read(deep); }, "the end of the file");
  const std::string closed = deep + std::string(deep.size(), ']');
  test::expect_error<InputError>([&] { (void)read(closed); }, "expected an object");
}

}  // namespace
}  // namespace keenline
