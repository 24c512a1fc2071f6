#include "keenline/io/graph_step.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

#ifdef KEENLINE_STEP

#include <BRepAdaptor_Curve.hxx>
#include <BRep_Tool.hxx>
#include <GCPnts_AbscissaPoint.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <TopAbs_ShapeEnum.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <sstream>
#include <string>
#include <vector>

#include "keenline/kernels/portable_math.h"

namespace keenline {
namespace {

Point point(const gp_Pnt& p) { return {p.X(), p.Y(), p.Z()}; }

/// What another program reads.
struct Drawing {
  std::vector<GeomAbs_CurveType> types;
  std::vector<double> lengths;
  std::vector<Point> starts;
  std::vector<Point> free_points;
};

Drawing read_back(const FeatureGraph& graph) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  std::istringstream stream(test::written(write_graph_step, graph));
  STEPControl_Reader reader;
  EXPECT_EQ(reader.ReadStream("graph.step", stream), IFSelect_RetDone);
  reader.TransferRoots();
  Drawing drawing;
  for (int i = 1; i <= reader.NbShapes(); ++i) {
    const TopoDS_Shape shape = reader.Shape(i);
    for (TopExp_Explorer edges(shape, TopAbs_EDGE); edges.More(); edges.Next()) {
      const BRepAdaptor_Curve curve(TopoDS::Edge(edges.Current()));
      drawing.types.push_back(curve.GetType());
      drawing.lengths.push_back(GCPnts_AbscissaPoint::Length(curve));
      drawing.starts.push_back(point(curve.Value(curve.FirstParameter())));
    }
    for (TopExp_Explorer points(shape, TopAbs_VERTEX, TopAbs_EDGE); points.More(); points.Next())
      drawing.free_points.push_back(point(BRep_Tool::Pnt(TopoDS::Vertex(points.Current()))));
  }
  return drawing;
}

TEST(GraphStep, AnotherReaderFindsEveryPieceToTheBit) {
  FeatureGraph graph = test::sample_graph();
  graph.crs.clear();
  const Drawing drawing = read_back(graph);
  // Two pieces of the crease, one of the loose end, three of the closed border.
  ASSERT_EQ(drawing.starts.size(), 6U);
  const std::vector<Point>& crease = graph.polylines[0].vertices;
  const std::vector<Point>& border = graph.polylines[1].vertices;
  const std::vector<Point> expected{crease[0], crease[1], crease[2], border[0], border[1], border[2]};
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_DOUBLE_EQ(drawing.starts[i][axis], expected[i][axis]) << i;
  ASSERT_EQ(drawing.free_points.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(drawing.free_points[i], graph.corners[i].position);
}

TEST(GraphStep, HoldsFittedCurvesAsSuch) {
  FeatureGraph graph;
  const auto add = [&](const FittedCurve& curve, bool closed) {
    Polyline& line = graph.polylines.emplace_back();
    line.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
    line.closed = closed;
    line.fitted = curve;
  };
  add(FittedLine{{0, 0, 0}, {0, 0, 0.5}}, false);
  add(FittedArc{{1, 2, 3}, {0, 0, 1}, {1, 0, 0}, 2, 360}, true);
  add(FittedArc{{1, 2, 3}, {0, 1, 0}, {1, 0, 0}, 2, 90}, false);
  add(FittedSpline{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}},
      false);
  const Drawing drawing = read_back(graph);
  EXPECT_EQ(drawing.types, (std::vector<GeomAbs_CurveType>{GeomAbs_Line, GeomAbs_Circle, GeomAbs_Circle,
                                                           GeomAbs_BSplineCurve}));
  const std::vector<double> lengths{0.5, 4 * kernels::pi, kernels::pi, 4};
  ASSERT_EQ(drawing.lengths.size(), lengths.size());
  for (std::size_t i = 0; i < lengths.size(); ++i) EXPECT_NEAR(drawing.lengths[i], lengths[i], 1e-9) << i;
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(drawing.starts[1][axis], (Point{3, 2, 3})[axis], 1e-12);
}

TEST(GraphStep, SameGraphSameBytes) {
  EXPECT_EQ(test::written(write_graph_step, test::sample_graph()),
            test::written(write_graph_step, test::sample_graph()));
}

TEST(GraphStep, MetresWhereTheReferenceSystemIsKnown) {
  FeatureGraph graph = test::sample_graph();
  EXPECT_NE(test::written(write_graph_step, graph).find("SI_UNIT($,.METRE.)"), std::string::npos);
  graph.crs.clear();
  EXPECT_NE(test::written(write_graph_step, graph).find("SI_UNIT(.MILLI.,.METRE.)"), std::string::npos);
}

TEST(GraphStep, AnEmptyDrawingIsAFile) { EXPECT_TRUE(read_back({}).types.empty()); }

TEST(GraphStep, LeavesOutVerticesThatAreOneToOpenCascade) {
  FeatureGraph graph;
  graph.polylines.push_back({.vertices = {{0, 0, 0}, {1e-9, 0, 0}, {1, 0, 0}, {1, 0, 1e-8}, {2, 0, 0}}});
  EXPECT_EQ(read_back(graph).types.size(), 2U);
  graph.polylines.push_back({.vertices = {{0, 0, 0}, {1e-9, 0, 0}}});
  StringSink sink;
  EXPECT_THROW(write_graph_step(graph, sink, no_progress()), OutputError);
}

TEST(GraphStep, CanBeCancelled) {
  test::CancelledProgress cancelled;
  StringSink sink;
  EXPECT_THROW(write_graph_step(test::sample_graph(), sink, cancelled), Cancelled);
}

}  // namespace
}  // namespace keenline

#else

namespace keenline {
namespace {

TEST(GraphStep, WithoutOpenCascadeItSaysSo) {
  StringSink sink;
  EXPECT_THROW(write_graph_step(test::sample_graph(), sink, no_progress()), OutputError);
}

}  // namespace
}  // namespace keenline

#endif
