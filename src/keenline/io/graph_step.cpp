#include "keenline/io/graph_step.h"

#include "keenline/errors.h"

#ifdef KEENLINE_STEP

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRep_Builder.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cstddef>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Pnt.hxx>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "keenline/feature_graph.h"
#include "keenline/io/sink.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/progress.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// OpenCASCADE's Precision::Confusion(): what is nearer is one point.
constexpr double confusion = 1e-7;

gp_Pnt point(const Point& p) { return {p[0], p[1], p[2]}; }
gp_Dir direction(const Point& p) { return {p[0], p[1], p[2]}; }

/// The library never prints, and OpenCASCADE's default messenger does.
class Silence {
 public:
  Silence() : printers_(Message::DefaultMessenger()->Printers()) {
    Message::DefaultMessenger()->ChangePrinters().Clear();
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
  ~Silence() { Message::DefaultMessenger()->ChangePrinters() = printers_; }

 private:
  Message_SequenceOfPrinters printers_;
};

struct EdgeOf {
  TopoDS_Shape operator()(const FittedLine& fitted) const {
    return BRepBuilderAPI_MakeEdge(point(fitted.start), point(fitted.end)).Edge();
  }
  TopoDS_Shape operator()(const FittedArc& arc) const {
    const gp_Circ circle(gp_Ax2(point(arc.center), direction(arc.normal), direction(arc.x_axis)), arc.radius);
    if (arc.sweep_deg == 360) return BRepBuilderAPI_MakeEdge(circle).Edge();
    return BRepBuilderAPI_MakeEdge(circle, 0, arc.sweep_deg / 180 * kernels::pi).Edge();
  }
  TopoDS_Shape operator()(const FittedSpline& spline) const {
    TColgp_Array1OfPnt poles(1, static_cast<int>(spline.control_points.size()));
    for (std::size_t i = 0; i < spline.control_points.size(); ++i)
      poles.SetValue(static_cast<int>(i) + 1, point(spline.control_points[i]));
    std::vector<double> values;
    std::vector<int> counts;
    for (const double knot : spline.knots) {
      if (values.empty() || knot != values.back()) {
        values.push_back(knot);
        counts.push_back(0);
      }
      ++counts.back();
    }
    TColStd_Array1OfReal knots(1, static_cast<int>(values.size()));
    TColStd_Array1OfInteger multiplicities(1, static_cast<int>(values.size()));
    for (int i = 0; i < knots.Length(); ++i) {
      knots.SetValue(i + 1, values[static_cast<std::size_t>(i)]);
      multiplicities.SetValue(i + 1, counts[static_cast<std::size_t>(i)]);
    }
    constexpr int degree = 3;
    const Handle(Geom_BSplineCurve) curve = new Geom_BSplineCurve(poles, knots, multiplicities, degree);
    return BRepBuilderAPI_MakeEdge(curve).Edge();
  }
  TopoDS_Shape operator()(std::monostate /*none*/) const {
    BRepBuilderAPI_MakePolygon polygon;
    const Point* last = nullptr;
    const auto add = [&](const Point& p) {
      if (last != nullptr && distance(*last, p) <= confusion) return;
      polygon.Add(point(p));
      last = &p;
    };
    for (const Point& p : line.vertices) add(p);
    // Closing is an edge as well, and OpenCASCADE's Close() would not ask how long it is.
    if (line.closed) add(line.vertices.front());
    return polygon.Wire();
  }

  const Polyline& line;
};

class StepWriter {
 public:
  StepWriter(const FeatureGraph& graph, Progress& progress) : graph_(graph), progress_(progress) {}

  void write(Sink& sink) {
    Interface_Static::SetCVal("write.step.schema", "AP214IS");
    Interface_Static::SetIVal("write.step.assembly", 0);    // one product, not one for every line
    Interface_Static::SetIVal("write.precision.mode", -1);  // the smallest tolerance that occurs
    add_lines("CREASES", LineKind::Crease);
    add_lines("BORDERS", LineKind::Border);
    add_corners();

    const Handle(StepData_StepModel) model = writer_.Model();
    name_products(model);
    APIHeaderSection_MakeHeader header(model);
    header.SetName(new TCollection_HAsciiString("keenline"));
    header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));
    header.SetOriginatingSystem(new TCollection_HAsciiString("keenline"));
    StepData_StepWriter writer(model);
    writer.FloatWriter().SetFormat("%.16E");      // to the last bit
    writer.FloatWriter().SetZeroSuppress(false);  // it would suppress exponents too
    writer.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
    std::ostringstream stream;
    if (!writer.Print(stream)) throw OutputError("STEP", "OpenCASCADE could not write its model");
    std::string text = stream.str();
    if (!graph_.crs.empty()) name_metres(text);
    sink.write(text);
  }

 private:
  /// OpenCASCADE numbers the products of all files that a program writes: same graph, same bytes.
  void name_products(const Handle(StepData_StepModel) & model) const {
    std::size_t product = 0;
    for (int i = 1; i <= model->NbEntities(); ++i) {
      const Handle(StepBasic_Product) entity = Handle(StepBasic_Product)::DownCast(model->Value(i));
      if (entity.IsNull()) continue;
      const Handle(TCollection_HAsciiString) name = new TCollection_HAsciiString(products_.at(product++));
      entity->SetId(name);
      entity->SetName(name);
    }
  }

  /// Asked for metres OpenCASCADE would multiply every number by a rounded factor, and only the second time.
  static void name_metres(std::string& text) {
    constexpr std::string_view millimetre = "SI_UNIT(.MILLI.,.METRE.)";
    constexpr std::string_view metre = "SI_UNIT($,.METRE.)";
    for (auto at = text.find(millimetre); at != std::string::npos; at = text.find(millimetre, at))
      text.replace(at, millimetre.size(), metre);
  }

  void add_lines(const char* product, LineKind kind) {
    TopoDS_Compound lines;
    builder_.MakeCompound(lines);
    std::size_t count = 0;
    for (std::size_t i = 0; i < graph_.polylines.size(); ++i) {
      const Polyline& line = graph_.polylines[i];
      if (line.kind != kind) continue;
      progress_.check();
      const bool has_length = std::any_of(line.vertices.begin(), line.vertices.end(), [&](const Point& p) {
        return distance(line.vertices.front(), p) > confusion;
      });
      if (!has_length) {
        throw OutputError("STEP", fmt::format("polyline {} is not longer than {}, the smallest length of "
                                              "OpenCASCADE: give the cloud a smaller unit",
                                              i, confusion));
      }
      builder_.Add(lines, std::visit(EdgeOf{line}, line.fitted));
      ++count;
    }
    if (count > 0) transfer(product, lines);
  }

  void add_corners() {
    if (graph_.corners.empty()) return;
    TopoDS_Compound corners;
    builder_.MakeCompound(corners);
    for (const GraphCorner& corner : graph_.corners)
      builder_.Add(corners, BRepBuilderAPI_MakeVertex(point(corner.position)).Vertex());
    transfer("CORNERS", corners);
  }

  void transfer(const char* product, const TopoDS_Compound& shapes) {
    progress_.check();
    products_.push_back(product);
    if (writer_.Transfer(shapes, STEPControl_AsIs) != IFSelect_RetDone)
      throw OutputError("STEP", fmt::format("OpenCASCADE could not take over the {}", product));
  }

  const FeatureGraph& graph_;
  Progress& progress_;
  STEPControl_Writer writer_;
  BRep_Builder builder_;
  std::vector<const char*> products_;
};

}  // namespace

bool has_step() { return true; }

void write_graph_step(const FeatureGraph& graph, Sink& sink, Progress& progress) {
  static std::mutex mutex;  // of OpenCASCADE's settings, which the whole program shares
  const std::lock_guard lock(mutex);
  const Silence silence;
  try {
    StepWriter(graph, progress).write(sink);
  } catch (const Standard_Failure& failure) {
    throw OutputError("STEP", fmt::format("OpenCASCADE: {}", failure.GetMessageString()));
  }
}

}  // namespace keenline

#else

namespace keenline {

bool has_step() { return false; }

void write_graph_step(const FeatureGraph& /*graph*/, Sink& /*sink*/, Progress& /*progress*/) {
  throw OutputError("STEP", "this build has no OpenCASCADE");
}

}  // namespace keenline

#endif
