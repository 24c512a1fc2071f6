#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

enum class LineKind : std::uint8_t {
  Crease,  ///< two surfaces meet at an angle
  Border   ///< rim of an open surface: not sharp
};

/// "crease", "border".
[[nodiscard]] std::string_view name_of(LineKind kind);

/// Where lines end together. One in which no line ends is a sharp point of its own.
struct GraphCorner {
  Point position{};
  std::optional<double> residual;  ///< by how much the surfaces that meet here miss the position
};

/// From start to end on the straight.
struct FittedLine {
  Point start{};
  Point end{};
};

/// From center + radius * x_axis counter-clockwise about the normal.
struct FittedArc {
  Point center{};
  Point normal{0, 0, 1};   ///< unit vector
  Point x_axis{1, 0, 0};   ///< unit vector perpendicular to the normal
  double radius = 1;       ///< more than 0
  double sweep_deg = 360;  ///< more than 0; 360 is the whole circle
};

/// A cubic B-spline that begins and ends at its first and last control point.
struct FittedSpline {
  std::vector<Point> control_points;  ///< at least 4
  std::vector<double> knots;          ///< four more; never falling
};

using FittedCurve = std::variant<std::monostate, FittedLine, FittedArc, FittedSpline>;

/// The unit normals of the two surfaces that meet at a vertex; they point out of the body where that is
/// known. Of lines traced from a cloud it is not: see Polyline::dihedral_deg.
struct SideNormals {
  Point left{};  ///< seen from outside, looking along the line
  Point right{};
};

/// An ordered line. What is known of each vertex stands in a vector as long as `vertices`, or an empty one.
struct Polyline {
  std::vector<Point> vertices{};
  bool closed = false;  ///< goes on from the last vertex to the first, which is not repeated
  LineKind kind = LineKind::Crease;
  /// The corners that the line ends in, with which its end vertices then coincide; none at a loose end. Of a
  /// closed line both are the corner at its first vertex, or none.
  std::optional<std::uint32_t> start_corner{};
  std::optional<std::uint32_t> end_corner{};
  std::uint64_t support = 0;  ///< how many points of the cloud back it
  /// Angle between the surfaces inside the body; 180 is flat. Points alone do not say where the body is:
  /// lines traced from a cloud are taken for convex, 0 to 180, and a concave edge reads 360 less its angle.
  std::vector<double> dihedral_deg{};
  std::vector<SideNormals> normals{};
  std::vector<double> residual{};  ///< how far the vertex is from the surfaces or points that it stands for
  FittedCurve fitted{};            ///< what the vertices sample, where a curve was fitted
};

/// Sharp features as a drawing: lines, and the corners in which they meet. Lengths and positions have the
/// unit of the cloud, positions its own (global) coordinates.
struct FeatureGraph {
  std::vector<GraphCorner> corners;
  std::vector<Polyline> polylines;
  std::string crs;  ///< coordinate reference system: WKT or "EPSG:…"; empty when unknown
};

/// An axis-parallel box; empty until it includes a point.
struct Extent {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()};
  Point high{-low[0], -low[1], -low[2]};

  void include(const Point& p);
  [[nodiscard]] bool is_empty() const { return low[0] > high[0]; }
};

/// Of all vertices and corners.
[[nodiscard]] Extent extent_of(const FeatureGraph& graph);

/// Along the straight pieces between the vertices; of a closed line back to the first.
[[nodiscard]] double length_of(const Polyline& line);

/// Number of straight pieces: one more in a closed line than in an open one of as many vertices.
[[nodiscard]] std::size_t segment_count(const Polyline& line);

/// Vertex at which straight piece `i` ends.
[[nodiscard]] const Point& segment_end(const Polyline& line, std::size_t i);

/// What a graph consists of.
struct GraphCounts {
  double length = 0;  ///< of all polylines together
  std::size_t corners = 0;
  std::size_t polylines = 0;
  std::size_t loops = 0;       ///< closed polylines
  std::size_t loose_ends = 0;  ///< ends of open polylines that lie in no corner
};

[[nodiscard]] GraphCounts counts_of(const FeatureGraph& graph);

/// No number of a valid graph is larger: so no square of a distance overflows.
inline constexpr double largest_graph_number = 1e150;

/// Whether a valid graph may hold it.
[[nodiscard]] bool is_drawable(const Point& p);

/// \throw InvalidArgument naming the corner or polyline, from 0, in which a number is not finite or beyond
/// largest_graph_number, a corner does not exist, vertices are fewer than 2 (closed: 3), a vector is neither
/// empty nor as long as the vertices, or a fitted curve is none.
void validate(const FeatureGraph& graph);

}  // namespace keenline
