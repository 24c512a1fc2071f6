#include "keenline/synth/face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "keenline/kernels/portable_math.h"
#include "keenline/synth/polynomial.h"

namespace keenline::synth {
namespace {

using kernels::sin_cos;

constexpr double no_hit = std::numeric_limits<double>::infinity();
// Shapes are about one unit in size; coordinates carry errors of a few 1e-16.
constexpr double tolerance = 1e-9;

/// Whether `p` lies left of the line from a to b. A point on the line counts as moved up a little, and less
/// to the right: the same rule as "a.y <= p.y" below, so that tests on one line never contradict each other.
bool is_left_of(const Vec3& a, const Vec3& b, const Vec3& p) {
  const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  if (side != 0) return side > 0;
  return b.x != a.x ? b.x > a.x : b.y < a.y;
}

/// Whether a horizontal line from `p` to the right crosses the curve an odd number of times. An arc is its
/// chord, plus one crossing more or less where `p` lies between arc and chord.
bool crosses_oddly(const Curve& curve, const Vec3& p) {
  const bool inside_circle = !curve.is_straight() && distance(p, curve.center()) < curve.radius();
  if (curve.is_circle()) return inside_circle;
  const Vec3& a = curve.start();
  const Vec3& b = curve.end();
  const bool left = is_left_of(a, b, p);
  const bool crosses_chord = (a.y <= p.y) != (b.y <= p.y) && left == (b.y > a.y);
  const bool arc_is_left = curve.normal().z < 0;
  return crosses_chord != (inside_circle && left == arc_is_left);
}

/// Green's theorem: the integral of (x dy - y dx) / 2 along the curve.
double swept_area(const Curve& curve) {
  const Vec3& a = curve.start();
  const Vec3& b = curve.end();
  if (curve.is_straight()) return 0.5 * (a.x * b.y - a.y * b.x);
  const Vec3& c = curve.center();
  const double sweep = 2 * curve.half_angle() * curve.normal().z;
  return 0.5 * (curve.radius() * curve.radius() * sweep + c.x * (b.y - a.y) - c.y * (b.x - a.x));
}

double enclosed_area(const Outline& outline) {
  double area = 0;
  for (const Curve& curve : outline) area += swept_area(curve);
  return std::abs(area);
}

/// How many steps of at least `spacing` fit; a hair short counts as fitting.
std::size_t steps_that_fit(double length, double spacing) {
  return static_cast<std::size_t>(std::max(0.0, std::floor(length / spacing + tolerance)));
}

/// The largest number up to `x` with 12 significant bits: its small multiples are exact, in single precision
/// too.
double with_few_bits(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::floor(mantissa * 4096), exponent - 12);
}

}  // namespace

PlaneFace::PlaneFace(const Frame& frame, std::vector<Outline> outlines)
    : frame_(frame), outlines_(std::move(outlines)) {
  for (const Curve& curve : outlines_.front()) local_bounds_.include(curve.bounds());
}

double PlaneFace::area() const {
  double area = 2 * enclosed_area(outlines_.front());
  for (const Outline& outline : outlines_) area -= enclosed_area(outline);
  return area;
}

Box PlaneFace::bounds() const {
  Box box;
  for (const Curve& curve : outlines_.front()) box.include(curve.mapped(frame_).bounds());
  return box;
}

bool PlaneFace::contains(const Vec3& local) const {
  bool inside = false;
  for (const Outline& outline : outlines_)
    for (const Curve& curve : outline) inside ^= crosses_oddly(curve, local);
  return inside;
}

Vec3 PlaneFace::random_point(RandomStream& random) const {
  const Vec3 size = local_bounds_.high - local_bounds_.low;
  for (;;) {
    const double x = random.uniform();
    const double y = random.uniform();
    const Vec3 local = local_bounds_.low + Vec3{x * size.x, y * size.y, 0};
    if (contains(local)) return frame_.point(local);
  }
}

void PlaneFace::add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const {
  const double pitch = with_few_bits(spacing);
  const Vec3 size = local_bounds_.high - local_bounds_.low;
  const std::size_t columns = steps_that_fit(size.x, spacing);
  const std::size_t rows = steps_that_fit(size.y, spacing);
  const auto offset = [&](std::size_t i, std::size_t count) {
    return (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * pitch;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    progress.check();
    for (std::size_t column = 0; column < columns; ++column) {
      const Vec3 local = local_bounds_.center() + Vec3{offset(column, columns), offset(row, rows), 0};
      if (contains(local)) points.push_back(frame_.point(local));
    }
  }
}

double PlaneFace::hit(const Ray& ray) const {
  const double t = dot(frame_.z, frame_.origin - ray.origin) / dot(frame_.z, ray.direction);
  if (!(t > 0 && t < no_hit)) return no_hit;
  const Vec3 from_origin = ray.origin + t * ray.direction - frame_.origin;
  return contains({dot(from_origin, frame_.x), dot(from_origin, frame_.y), 0}) ? t : no_hit;
}

RevolvedFace::RevolvedFace(const Vec3& axis, const Curve& profile, const Curve& turn)
    : axis_{axis.x, axis.y, 0}, profile_(profile), turn_(turn) {
  const Box r_and_z = profile.bounds();
  largest_radius_ = r_and_z.high.x;
  const Box directions = turn.bounds();
  for (const double r : {r_and_z.low.x, r_and_z.high.x}) {
    for (const Vec3& corner : {directions.low, directions.high}) {
      bounds_.include(axis_ + r * corner + Vec3{0, 0, r_and_z.low.y});
      bounds_.include(axis_ + r * corner + Vec3{0, 0, r_and_z.high.y});
    }
  }
}

double RevolvedFace::area() const {
  // Pappus: length of the profile times the way of its centroid.
  double centroid = 0.5 * (profile_.start().x + profile_.end().x);
  if (!profile_.is_straight()) {
    const double half = profile_.half_angle();
    centroid = profile_.center().x + profile_.radius() * sin_cos(half).sin / half * profile_.outward(0).x;
  }
  return 2 * turn_.half_angle() * centroid * profile_.length();
}

Vec3 RevolvedFace::at(const Vec3& profile_point, double angle) const {
  return axis_ + profile_point.x * turn_.outward(angle) + Vec3{0, 0, profile_point.y};
}

Vec3 RevolvedFace::random_point(RandomStream& random) const {
  const double angle = turn_.half_angle() * (2 * random.uniform() - 1);
  for (;;) {
    const Vec3 profile_point = profile_.at(random.uniform());
    if (random.uniform() * largest_radius_ < profile_point.x) return at(profile_point, angle);
  }
}

void RevolvedFace::add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const {
  const std::size_t rings = steps_that_fit(profile_.length(), spacing);
  for (std::size_t ring = 0; ring < rings; ++ring) {
    progress.check();
    const Vec3 profile_point = profile_.at((static_cast<double>(ring) + 0.5) / static_cast<double>(rings));
    const double way = 2 * turn_.half_angle() * profile_point.x;
    const std::size_t count = turn_.is_circle() ? static_cast<std::size_t>(std::round(way / spacing))
                                                : steps_that_fit(way, spacing);
    for (std::size_t i = 0; i < count; ++i) {
      const double part = (2 * static_cast<double>(i) + 1) / static_cast<double>(count) - 1;
      points.push_back(at(profile_point, turn_.half_angle() * part));
    }
  }
}

bool RevolvedFace::contains(const Vec3& local) const {
  const double r = std::sqrt(local.x * local.x + local.y * local.y);
  return profile_.distance_to({r, local.z, 0}) <= tolerance && turn_.spans(local, tolerance);
}

namespace {

/// A polynomial in t that vanishes where o + t d meets the surface that `profile` (or its prolongation)
/// sweeps out about the z axis.
Quartic revolved_along(const Curve& profile, const Vec3& o, const Vec3& d) {
  const double r0 = o.x * o.x + o.y * o.y;  // squared distance from the axis: r0 + r1 t + r2 t^2
  const double r1 = 2 * (o.x * d.x + o.y * d.y);
  const double r2 = d.x * d.x + d.y * d.y;
  if (profile.is_straight()) {
    const Vec3& a = profile.start();
    const double slope = (profile.end().x - a.x) / (profile.end().y - a.y);
    const double k0 = a.x + slope * (o.z - a.y);  // the cone's radius at that height: k0 + k1 t
    const double k1 = slope * d.z;
    return {r0 - k0 * k0, r1 - 2 * k0 * k1, r2 - k1 * k1};
  }
  const double c = profile.center().x;
  const double z = o.z - profile.center().y;
  const double s0 = r0 + z * z + c * c - profile.radius() * profile.radius();
  const double s1 = r1 + 2 * z * d.z;
  const double s2 = r2 + d.z * d.z;
  if (c == 0) return {s0, s1, s2};  // a sphere
  const double q = 4 * c * c;
  return {s0 * s0 - q * r0, 2 * s0 * s1 - q * r1, 2 * s0 * s2 + s1 * s1 - q * r2, 2 * s1 * s2, s2 * s2};
}

}  // namespace

double RevolvedFace::hit(const Ray& ray) const {
  // Counted from where the ray comes nearest to the face, where numbers are small and roots precise.
  const Vec3 center = bounds_.center();
  const double reach = 0.5 * bounds_.diagonal() + tolerance;
  const double way = dot(center - ray.origin, ray.direction);
  const Vec3 nearest = ray.origin + way * ray.direction;
  const double half_chord_squared = reach * reach - dot(nearest - center, nearest - center);
  if (half_chord_squared <= 0) return no_hit;
  const double half_chord = std::sqrt(half_chord_squared);
  const Vec3 start = nearest - axis_;
  for (const double t : roots_of(revolved_along(profile_, start, ray.direction), -half_chord, half_chord))
    if (way + t > 0 && contains(start + t * ray.direction)) return way + t;
  return no_hit;
}

Box MovedFace::bounds() const {
  const Box local = face_->bounds();
  Box box;
  box.include(frame_.point(local.low));
  box.include(frame_.point(local.high));
  return box;
}

Vec3 MovedFace::random_point(RandomStream& random) const { return frame_.point(face_->random_point(random)); }

void MovedFace::add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const {
  const std::size_t first = points.size();
  face_->add_lattice(spacing, points, progress);
  for (std::size_t i = first; i < points.size(); ++i) points[i] = frame_.point(points[i]);
}

double MovedFace::hit(const Ray& ray) const {
  const auto local = [&](const Vec3& d) {
    return Vec3{dot(d, frame_.x), dot(d, frame_.y), dot(d, frame_.z)};
  };
  return face_->hit({local(ray.origin - frame_.origin), local(ray.direction)});
}

}  // namespace keenline::synth
