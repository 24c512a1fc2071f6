#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "keenline/synth/curve.h"
#include "keenline/synth/face.h"

namespace keenline::synth {

/// A surface in exact pieces, and everything that is sharp about it.
struct Shape {
  std::vector<std::unique_ptr<const Face>> faces;
  std::vector<Curve> edges;
  std::vector<Curve> borders;  ///< rims of an open surface: not sharp
  std::vector<Vec3> corners;   ///< where three edges meet or two meet at an angle
  std::vector<Vec3> peaks;     ///< sharp points that lie on no edge
  /// Edges as they were drawn before they were rounded: beside the surface, and not sharp.
  std::vector<Curve> designed;

  [[nodiscard]] double area() const;
  [[nodiscard]] Box bounds() const;
};

/// To the nearest of the curves; infinite when there are none.
[[nodiscard]] double distance_to(std::span<const Curve> curves, const Vec3& p);
[[nodiscard]] double distance_to(std::span<const Vec3> points, const Vec3& p);

/// Puts a shape together so that faces and edges cannot contradict each other.
class ShapeBuilder {
 public:
  /// A plane face z = const bounded by the first outline, with holes. No edges: see rim().
  void cap(std::vector<Outline> outlines, double z);
  /// What stands on an outline between two heights, with upright edges wherever the outline has a kink.
  void wall(const Outline& outline, double low, double high);
  /// An outline at one height as edges.
  void rim(const Outline& outline, double z);
  /// cap, wall and rim: a straight prism with straight holes.
  void prism(const std::vector<Outline>& outlines, double low, double high);

  /// A chain of (distance from the z axis, z, 0) turned about that axis: edges where the chain has kinks,
  /// peaks where it meets the axis at an angle, borders where it ends off the axis.
  void revolve(const std::vector<Curve>& profile);

  /// A plane polygon. \pre its first three vertices are not in line
  void polygon(const std::vector<Vec3>& vertices);
  /// Polygons of vertex numbers; each pair of neighbours in a polygon is an edge.
  void polygons(const std::vector<Vec3>& vertices, const std::vector<std::vector<std::size_t>>& polygons);

  void face(std::unique_ptr<const Face> face) { shape_.faces.push_back(std::move(face)); }
  void edge(const Curve& curve) { shape_.edges.push_back(curve); }
  void border(const Curve& curve) { shape_.borders.push_back(curve); }
  void designed(const Curve& curve) { shape_.designed.push_back(curve); }

  /// Finds the corners and hands the shape over.
  [[nodiscard]] Shape finish() &&;

 private:
  Shape shape_;
};

/// A closed chain of straight segments.
[[nodiscard]] Outline polygon_outline(std::span<const Vec3> vertices);
[[nodiscard]] Outline circle_outline(const Vec3& center, double radius);

}  // namespace keenline::synth
