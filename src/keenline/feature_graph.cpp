#include "keenline/feature_graph.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

bool is_usable(double number) { return std::abs(number) <= largest_graph_number; }  // false for NaN
bool is_usable(const Point& p) { return is_drawable(p); }
bool is_usable(const SideNormals& n) { return is_usable(n.left) && is_usable(n.right); }

template <typename T>
bool all_usable(const std::vector<T>& values) {
  return std::all_of(values.begin(), values.end(), [](const T& value) { return is_usable(value); });
}

bool is_unit(const Point& p) { return std::abs(dot(p, p) - 1) < 1e-6; }

/// What is wrong with a curve; empty when nothing is.
struct FaultOfCurve {
  std::string operator()(const std::monostate& /*none*/) const { return {}; }

  std::string operator()(const FittedLine& line) const {
    return is_usable(line.start) && is_usable(line.end) ? "" : "a fitted line without finite ends";
  }

  std::string operator()(const FittedArc& arc) const {
    if (!is_usable(arc.center) || !is_usable(arc.radius) || !(arc.radius > 0))
      return "a fitted arc without a centre or radius";
    if (!is_unit(arc.normal) || !is_unit(arc.x_axis) || std::abs(dot(arc.normal, arc.x_axis)) > 1e-6)
      return "a fitted arc whose axes are not perpendicular unit vectors";
    if (!(arc.sweep_deg > 0 && arc.sweep_deg <= 360))
      return fmt::format("a fitted arc of {} degrees; expected more than 0, up to 360", arc.sweep_deg);
    return {};
  }

  std::string operator()(const FittedSpline& spline) const {
    const std::size_t controls = spline.control_points.size();
    if (controls < 4 || spline.knots.size() != controls + 4) {
      return fmt::format("a fitted spline of {} control points and {} knots; expected at least 4, and 4 more",
                         controls, spline.knots.size());
    }
    if (!all_usable(spline.control_points) || !all_usable(spline.knots))
      return "a fitted spline with a number that is not finite";
    if (!std::is_sorted(spline.knots.begin(), spline.knots.end())) return "a fitted spline whose knots fall";
    return {};
  }
};

std::string fault_of_corners(const Polyline& line, std::size_t corners) {
  for (const auto& corner : {line.start_corner, line.end_corner})
    if (corner && *corner >= corners) return fmt::format("ends in corner {} of {}", *corner, corners);
  if (line.closed && line.start_corner != line.end_corner)
    return "is closed but does not end in the corner in which it starts";
  return {};
}

std::string fault_of(const Polyline& line, std::size_t corners) {
  const std::size_t least = line.closed ? 3 : 2;
  const std::size_t count = line.vertices.size();
  if (count < least) return fmt::format("has {} vertices; expected at least {}", count, least);
  for (const auto& [name, size] :
       {std::pair("dihedral angles", line.dihedral_deg.size()), std::pair("normals", line.normals.size()),
        std::pair("residuals", line.residual.size())}) {
    if (size != 0 && size != count) return fmt::format("has {} {} for {} vertices", size, name, count);
  }
  if (!all_usable(line.vertices) || !all_usable(line.dihedral_deg) || !all_usable(line.normals) ||
      !all_usable(line.residual)) {
    return "has a number that is not finite or too large";
  }
  if (std::string fault = fault_of_corners(line, corners); !fault.empty()) return fault;
  const std::string fault = std::visit(FaultOfCurve(), line.fitted);
  return fault.empty() ? fault : "has " + fault;
}

}  // namespace

std::string_view name_of(LineKind kind) { return kind == LineKind::Crease ? "crease" : "border"; }

void Extent::include(const Point& p) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], p[axis]);
    high[axis] = std::max(high[axis], p[axis]);
  }
}

Extent extent_of(const FeatureGraph& graph) {
  Extent extent;
  for (const GraphCorner& corner : graph.corners) extent.include(corner.position);
  for (const Polyline& line : graph.polylines)
    for (const Point& p : line.vertices) extent.include(p);
  return extent;
}

std::size_t segment_count(const Polyline& line) {
  return line.vertices.empty() ? 0 : line.vertices.size() - (line.closed ? 0 : 1);
}

const Point& segment_end(const Polyline& line, std::size_t i) {
  return line.vertices[i + 1 < line.vertices.size() ? i + 1 : 0];
}

double length_of(const Polyline& line) {
  double length = 0;
  for (std::size_t i = 0; i < segment_count(line); ++i)
    length += distance(line.vertices[i], segment_end(line, i));
  return length;
}

GraphCounts counts_of(const FeatureGraph& graph) {
  GraphCounts counts;
  counts.corners = graph.corners.size();
  counts.polylines = graph.polylines.size();
  for (const Polyline& line : graph.polylines) {
    counts.length += length_of(line);
    if (line.closed) ++counts.loops;
    else counts.loose_ends += (line.start_corner ? 0U : 1U) + (line.end_corner ? 0U : 1U);
  }
  return counts;
}

bool is_drawable(const Point& p) { return is_usable(p[0]) && is_usable(p[1]) && is_usable(p[2]); }

void validate(const FeatureGraph& graph) {
  for (std::size_t i = 0; i < graph.corners.size(); ++i) {
    const GraphCorner& corner = graph.corners[i];
    if (!is_usable(corner.position) || !is_usable(corner.residual.value_or(0)))
      throw InvalidArgument(fmt::format("corner {} has a number that is not finite or too large", i));
  }
  for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
    const std::string fault = fault_of(graph.polylines[i], graph.corners.size());
    if (!fault.empty()) throw InvalidArgument(fmt::format("polyline {} {}", i, fault));
  }
}

}  // namespace keenline
