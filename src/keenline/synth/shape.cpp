#include "keenline/synth/shape.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "keenline/synth/curve_network.h"

namespace keenline::synth {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Frame at_height(double z) { return {.origin = {0, 0, z}}; }

/// The arc's share of the unit circle.
Curve turn_of(const Curve& arc) {
  if (arc.is_circle()) return Curve::circle({}, 1);
  return Curve::arc(unit(arc.start() - arc.center()), unit(arc.end() - arc.center()), {}, arc.normal());
}

/// A point of a profile, turned into the xz plane.
Vec3 in_xz(const Vec3& profile_point) { return {profile_point.x, 0, profile_point.y}; }

}  // namespace

double Shape::area() const {
  double area = 0;
  for (const auto& face : faces) area += face->area();
  return area;
}

Box Shape::bounds() const {
  Box box;
  for (const auto& face : faces) box.include(face->bounds());
  return box;
}

double distance_to(std::span<const Curve> curves, const Vec3& p) {
  double nearest = infinity;
  for (const Curve& curve : curves) nearest = std::min(nearest, curve.distance_to(p));
  return nearest;
}

double distance_to(std::span<const Vec3> points, const Vec3& p) {
  double nearest = infinity;
  for (const Vec3& point : points) nearest = std::min(nearest, distance(point, p));
  return nearest;
}

void ShapeBuilder::cap(std::vector<Outline> outlines, double z) {
  shape_.faces.push_back(std::make_unique<PlaneFace>(at_height(z), std::move(outlines)));
}

void ShapeBuilder::wall(const Outline& outline, double low, double high) {
  const Vec3 bottom{0, 0, low};
  const Vec3 top{0, 0, high};
  const Curve* previous = &outline.back();
  for (const Curve& curve : outline) {
    if (curve.is_straight()) {
      const Vec3& a = curve.start();
      const Vec3& b = curve.end();
      polygon({a + bottom, b + bottom, b + top, a + top});
    } else {
      const Curve profile = Curve::segment({curve.radius(), low, 0}, {curve.radius(), high, 0});
      shape_.faces.push_back(std::make_unique<RevolvedFace>(curve.center(), profile, turn_of(curve)));
    }
    if (!is_smooth_joint(*previous, curve)) edge(Curve::segment(curve.start() + bottom, curve.start() + top));
    previous = &curve;
  }
}

void ShapeBuilder::rim(const Outline& outline, double z) {
  for (const Curve& curve : outline) edge(curve.mapped(at_height(z)));
}

void ShapeBuilder::prism(const std::vector<Outline>& outlines, double low, double high) {
  for (const double z : {low, high}) {
    cap(outlines, z);
    for (const Outline& outline : outlines) rim(outline, z);
  }
  for (const Outline& outline : outlines) wall(outline, low, high);
}

void ShapeBuilder::revolve(const std::vector<Curve>& profile) {
  const auto circle = [](const Vec3& p) { return Curve::circle({0, 0, p.y}, p.x); };
  const auto close_end = [&](const Vec3& p, const Vec3& direction) {
    if (p.x > 0) return border(circle(p));
    const bool is_flat = std::abs(direction.y) < 1e-9;
    if (!is_flat) shape_.peaks.push_back(in_xz(p));
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Curve& curve = profile[i];
    if (curve.is_straight() && curve.start().y == curve.end().y) {
      std::vector<Outline> disc;
      for (const double radius :
           {std::max(curve.start().x, curve.end().x), std::min(curve.start().x, curve.end().x)})
        if (radius > 0) disc.push_back(circle_outline({}, radius));
      cap(std::move(disc), curve.start().y);
    } else {
      shape_.faces.push_back(std::make_unique<RevolvedFace>(Vec3{}, curve, Curve::circle({}, 1)));
    }
    if (i > 0 && !is_smooth_joint(profile[i - 1], curve)) edge(circle(curve.start()));
  }
  if (profile.front().is_circle()) return;
  close_end(profile.front().start(), profile.front().start_direction());
  close_end(profile.back().end(), profile.back().end_direction());
}

void ShapeBuilder::polygon(const std::vector<Vec3>& vertices) {
  const Vec3& origin = vertices[0];
  const Vec3 x = unit(vertices[1] - origin);
  const Vec3 normal = unit(cross(x, vertices[2] - origin));
  const Vec3 y = cross(normal, x);
  std::vector<Vec3> local;
  local.reserve(vertices.size());
  for (const Vec3& vertex : vertices) local.push_back({dot(vertex - origin, x), dot(vertex - origin, y), 0});
  shape_.faces.push_back(
      std::make_unique<PlaneFace>(Frame{origin, x, y, normal}, std::vector<Outline>{polygon_outline(local)}));
}

void ShapeBuilder::polygons(const std::vector<Vec3>& vertices,
                            const std::vector<std::vector<std::size_t>>& polygons) {
  std::set<std::pair<std::size_t, std::size_t>> known;
  for (const auto& numbers : polygons) {
    std::vector<Vec3> ring;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      ring.push_back(vertices[numbers[i]]);
      const auto ends = std::minmax(numbers[i], numbers[(i + 1) % numbers.size()]);
      if (known.insert(ends).second) edge(Curve::segment(vertices[ends.first], vertices[ends.second]));
    }
    polygon(ring);
  }
}

Shape ShapeBuilder::finish() && {
  shape_.corners = corners_of(shape_.edges);
  return std::move(shape_);
}

Outline polygon_outline(std::span<const Vec3> vertices) {
  Outline outline;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    outline.push_back(Curve::segment(vertices[i], vertices[(i + 1) % vertices.size()]));
  return outline;
}

Outline circle_outline(const Vec3& center, double radius) { return {Curve::circle(center, radius)}; }

}  // namespace keenline::synth
