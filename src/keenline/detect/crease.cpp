#include "keenline/detect/crease.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "keenline/detect/faces.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/detect/span_space.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double largest_sine_off_face = 0.64278760968653933;  // 40 degrees
constexpr double smallest_squared_sine = 0.01;                 // of the angle between the planes: 6 degrees
constexpr double smallest_flatness = 0.001;  // of variances: a row of points is in no plane of its own
constexpr std::size_t smallest_count_on_face = 3;
constexpr double birth_through_point = 4 * kernels::angle_units_per_degree;

struct Plane {
  Point normal;
  double offset;   // normal * x of its points
  double scatter;  // root mean square distance of the points that it is fitted to
};

/// The face whose plane through the point the neighbour is nearest to; none if that is too far off.
std::size_t nearest_face(const Point& q, double length, std::span<const Face> faces) {
  std::size_t nearest = faces.size();
  double smallest = largest_sine_off_face * length;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double off_face = std::abs(dot(q, faces[f].normal));
    if (off_face > smallest) continue;
    smallest = off_face;
    nearest = f;
  }
  return nearest;
}

using Room = std::array<std::size_t, 255>;

/// For every neighbour the index of its face, see nearest_face().
std::span<const std::size_t> faces_of_neighbors(const GaussMap& map, std::span<const Face> faces,
                                                Room& room) {
  const std::size_t count = map.offsets().size();
  for (std::size_t i = 0; i < count; ++i) room[i] = nearest_face(map.offsets()[i], map.lengths()[i], faces);
  return std::span(room).first(count);
}

/// The plane of the neighbours that belong to one of the faces.
std::optional<Plane> fit_plane(const GaussMap& map, std::span<const std::size_t> face_of, std::size_t face) {
  std::array<Point, 255> on_face;
  std::size_t count = 0;
  Point mean{0, 0, 0};
  for (std::size_t i = 0; i < map.offsets().size(); ++i) {
    if (face_of[i] != face) continue;
    const Point& q = map.offsets()[i];
    on_face[count++] = q;
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += q[axis];
  }
  if (count < smallest_count_on_face) return std::nullopt;
  for (double& coordinate : mean) coordinate /= static_cast<double>(count);
  kernels::Symmetric3 tensor;
  for (std::size_t i = 0; i < count; ++i)
    kernels::add_outer_product(tensor, on_face[i][0] - mean[0], on_face[i][1] - mean[1],
                               on_face[i][2] - mean[2]);
  const kernels::Eigen3 axes = kernels::eigen_decomposition(tensor);
  if (axes.values[1] < smallest_flatness * axes.values[0]) return std::nullopt;
  const Point normal = axes.vectors[2];
  const double variance = std::max(0.0, axes.values[2]) / static_cast<double>(count);
  return Plane{normal, dot(normal, mean), std::sqrt(variance)};
}

/// The distance at which k points lie around one if each has a square of side 1 to itself, inverted.
double spacing_of(const GaussMap& map) {
  const auto k = static_cast<double>(map.lengths().size());
  return map.lengths().back() * std::sqrt(kernels::pi / (k + 0.5));
}

}  // namespace

std::optional<Crease> first_crease(const GaussMap& map, std::span<const Face> faces) {
  Room room;
  const auto face_of = faces_of_neighbors(map, faces, room);
  const std::optional<Plane> a = fit_plane(map, face_of, 0);
  if (!a) return std::nullopt;
  const std::optional<Plane> b = fit_plane(map, face_of, 1);
  if (!b) return std::nullopt;
  const double cosine = dot(a->normal, b->normal);
  const double squared_sine = 1 - cosine * cosine;
  if (squared_sine < smallest_squared_sine) return std::nullopt;

  // The foot is the combination of the normals that both planes go through.
  const double along_a = (a->offset - cosine * b->offset) / squared_sine;
  const double along_b = (b->offset - cosine * a->offset) / squared_sine;
  Crease crease;
  crease.foot = sum(scaled(along_a, a->normal), scaled(along_b, b->normal));
  const Point along = cross(a->normal, b->normal);
  for (std::size_t axis = 0; axis < 3; ++axis) crease.direction[axis] = along[axis] / std::sqrt(squared_sine);
  crease.distance = length(crease.foot);
  crease.scatter = std::max(a->scatter, b->scatter);
  return crease;
}

bool make_corner(const GaussMap& map, std::span<const Face> faces) {
  if (faces.size() < 3) return false;
  std::array<std::size_t, 256> neighbors{};  // of each face, then those of none
  Room room;
  for (const std::size_t face : faces_of_neighbors(map, faces, room)) ++neighbors[face];
  kernels::Symmetric3 squares;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (neighbors[f] >= smallest_count_on_face) kernels::add_square(squares, faces[f].normal, 1);
  return normals_span_space(squares);
}

bool is_beside_crease(const GaussMap& map, std::span<const Face> faces) {
  if (std::max(faces[0].birth, faces[1].birth) < birth_through_point) return false;
  const std::optional<Crease> crease = first_crease(map, faces);
  if (!crease) return false;
  const double spacing = spacing_of(map);
  if (crease->distance - 2 * crease->scatter <= 0.5 * spacing) return false;
  int better = 0;
  for (const Point& q : map.offsets()) {
    const Point from_foot = difference(q, crease->foot);
    const double along = dot(from_foot, crease->direction);
    const double squared_distance = dot(from_foot, from_foot) - along * along;
    const bool is_near = std::abs(along) < 2.5 * spacing;
    if (is_near && squared_distance < 0.25 * crease->distance * crease->distance) ++better;
  }
  return better >= 2;
}

}  // namespace keenline
