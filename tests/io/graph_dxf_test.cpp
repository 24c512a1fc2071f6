#include "keenline/io/graph_dxf.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/text.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

/// One "0" group with the groups that follow it.
struct Object {
  std::string type;
  std::vector<std::pair<int, std::string>> groups;

  [[nodiscard]] std::string text(int code) const {
    for (const auto& [group, value] : groups)
      if (group == code) return value;
    return "none";
  }
  [[nodiscard]] double number(int code) const {
    double value = -12345;
    EXPECT_EQ(parse_number(text(code), value), Parsed::Ok) << type << " " << code;
    return value;
  }
  [[nodiscard]] Point point(int code) const { return {number(code), number(code + 10), number(code + 20)}; }
};

std::vector<Object> objects_of(const FeatureGraph& graph) {
  const std::string text = test::written(write_graph_dxf, graph);
  LineReader lines(text);
  std::vector<Object> objects;
  std::string_view code;
  std::string_view value;
  while (lines.next(code)) {
    EXPECT_TRUE(lines.next(value));
    int group = -1;
    EXPECT_EQ(parse_number(code, group), Parsed::Ok);
    if (group == 0) objects.push_back({std::string(value), {}});
    else objects.back().groups.emplace_back(group, value);
  }
  return objects;
}

std::vector<Object> of_type(const std::vector<Object>& objects, std::string_view type) {
  std::vector<Object> result;
  for (const Object& object : objects)
    if (object.type == type) result.push_back(object);
  return result;
}

FeatureGraph graph_of(const FittedCurve& curve) {
  FeatureGraph graph;
  graph.polylines = {{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .fitted = curve}};
  return graph;
}

TEST(GraphDxf, IsCompleteAndEveryHandleIsItsOwn) {
  for (const FeatureGraph& graph : {test::sample_graph(), FeatureGraph()}) {
    const auto objects = objects_of(graph);
    std::vector<std::string> sections;
    for (const Object& section : of_type(objects, "SECTION")) sections.push_back(section.text(2));
    EXPECT_EQ(sections,
              (std::vector<std::string>{"HEADER", "CLASSES", "TABLES", "BLOCKS", "ENTITIES", "OBJECTS"}));
    EXPECT_EQ(of_type(objects, "ENDSEC").size(), 6U);
    EXPECT_EQ(objects.back().type, "EOF");
    EXPECT_EQ(objects[0].groups[2].second, "AC1015");

    std::set<std::uint64_t> handles;
    std::set<std::uint64_t> owners;
    for (std::size_t i = 1; i < objects.size(); ++i) {
      const std::string handle = objects[i].text(objects[i].type == "DIMSTYLE" ? 105 : 5);
      if (handle == "none") continue;
      EXPECT_TRUE(handles.insert(std::stoull(handle, nullptr, 16)).second) << handle;
      owners.insert(std::stoull(objects[i].text(330), nullptr, 16));
    }
    owners.erase(0);
    for (const std::uint64_t owner : owners) EXPECT_EQ(handles.count(owner), 1U) << owner;
    // The header's seed is the first handle that is free.
    const std::uint64_t seed = std::stoull(objects[0].text(5), nullptr, 16);
    EXPECT_LT(*handles.rbegin(), seed);
    EXPECT_LE(seed, *handles.rbegin() + 0x100);
  }
}

TEST(GraphDxf, PolylinesHaveTheVerticesToTheBit) {
  const FeatureGraph graph = test::sample_graph();
  const auto objects = objects_of(graph);
  const auto polylines = of_type(objects, "POLYLINE");
  ASSERT_EQ(polylines.size(), 3U);
  EXPECT_EQ(polylines[0].text(8), "CREASES");
  EXPECT_EQ(polylines[0].text(70), "8");
  EXPECT_EQ(polylines[1].text(8), "BORDERS");
  EXPECT_EQ(polylines[1].text(70), "9");
  std::map<std::string, std::vector<Point>> vertices;
  for (const Object& vertex : of_type(objects, "VERTEX"))
    vertices[vertex.text(330)].push_back(vertex.point(10));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(vertices[polylines[i].text(5)], graph.polylines[i].vertices);
  EXPECT_EQ(of_type(objects, "SEQEND").size(), 3U);
  const auto points = of_type(objects, "POINT");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].point(10), graph.corners[0].position);
  EXPECT_EQ(points[0].text(8), "CORNERS");
}

TEST(GraphDxf, CirclesAndArcsInTheGroundPlaneAreAsTheyStand) {
  const FittedArc circle{{3, 4, 5}, {0, 0, 1}, {1, 0, 0}, 2, 360};
  const auto circles = of_type(objects_of(graph_of(circle)), "CIRCLE");
  ASSERT_EQ(circles.size(), 1U);
  EXPECT_EQ(circles[0].point(10), (Point{3, 4, 5}));
  EXPECT_EQ(circles[0].number(40), 2);

  const FittedArc arc{{3, 4, 5}, {0, 0, 1}, {0, -1, 0}, 2, 100};
  const auto arcs = of_type(objects_of(graph_of(arc)), "ARC");
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_EQ(arcs[0].point(10), (Point{3, 4, 5}));
  EXPECT_NEAR(arcs[0].number(50), 270, 1e-12);
  EXPECT_NEAR(arcs[0].number(51), 10, 1e-12);
}

TEST(GraphDxf, ATiltedArcIsGivenInItsOwnPlane) {
  // Normal along x: DXF's axes there are x = world y, y = world z.
  const FittedArc arc{{7, 8, 9}, {1, 0, 0}, {0, 0, 1}, 2, 90};
  const Object object = of_type(objects_of(graph_of(arc)), "ARC").at(0);
  EXPECT_EQ(object.point(210), (Point{1, 0, 0}));
  EXPECT_EQ(object.point(10), (Point{8, 9, 7}));
  EXPECT_NEAR(object.number(50), 90, 1e-12);
  EXPECT_NEAR(object.number(51), 180, 1e-12);
}

TEST(GraphDxf, LinesAndSplinesKeepTheirPoints) {
  const auto lines = of_type(objects_of(graph_of(FittedLine{{1, 2, 3}, {4, 5, 6}})), "LINE");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].point(11), (Point{4, 5, 6}));
  const FittedSpline spline{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}, {0, 0, 0, 0, 1, 1, 1, 1}};
  const auto splines = of_type(objects_of(graph_of(spline)), "SPLINE");
  ASSERT_EQ(splines.size(), 1U);
  EXPECT_EQ(splines[0].text(72), "8");
  EXPECT_EQ(splines[0].text(73), "4");
}

TEST(GraphDxf, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_dxf(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
