#include "keenline/synth/curve.h"

#include <cmath>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {

using kernels::angle_of;
using kernels::pi;
using kernels::sin_cos;

void Box::include(const Vec3& p) {
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

Curve Curve::segment(const Vec3& start, const Vec3& end) { return {start, end}; }

Curve Curve::arc(const Vec3& start, const Vec3& end, const Vec3& center, const Vec3& normal) {
  Curve arc(start, end);
  // A counterclockwise arc bulges to the right of its chord, however far it sweeps.
  const Vec3 middle = unit(cross(end - start, normal));
  arc.frame_ = {center, middle, cross(normal, middle), normal};
  arc.radius_ = distance(center, start);
  const Vec3 radius = end - center;
  arc.half_angle_ = angle_of(dot(radius, arc.frame_.y), dot(radius, middle));
  arc.cos_half_angle_ = dot(radius, middle) / arc.radius_;
  return arc;
}

Curve Curve::circle(const Vec3& center, double radius, const Vec3& normal, const Vec3& x_axis) {
  const Vec3 seam = center + radius * x_axis;
  Curve circle(seam, seam);
  const Vec3 middle = -1 * x_axis;
  circle.frame_ = {center, middle, cross(normal, middle), normal};
  circle.radius_ = radius;
  circle.half_angle_ = pi;
  circle.cos_half_angle_ = -1;
  return circle;
}

double Curve::length() const { return is_straight() ? distance(start_, end_) : 2 * half_angle_ * radius_; }

Vec3 Curve::at(double t) const {
  if (t <= 0) return start_;
  if (t >= 1) return end_;
  if (is_straight()) return start_ + t * (end_ - start_);
  return center() + radius_ * outward(half_angle_ * (2 * t - 1));
}

Vec3 Curve::outward(double angle) const {
  const auto [sin, cos] = sin_cos(angle);
  return cos * frame_.x + sin * frame_.y;
}

Vec3 Curve::start_direction() const {
  return is_straight() ? unit(end_ - start_) : unit(cross(normal(), start_ - center()));
}

Vec3 Curve::end_direction() const {
  return is_straight() ? unit(end_ - start_) : unit(cross(normal(), end_ - center()));
}

bool Curve::spans(const Vec3& p, double slack) const {
  if (is_circle()) return true;
  const Vec3 to_p = p - center();
  const double along = dot(to_p, frame_.x);
  const double across = dot(to_p, frame_.y);
  return along >= std::sqrt(along * along + across * across) * cos_half_angle_ - slack;
}

double Curve::distance_to(const Vec3& p) const {
  if (is_straight()) {
    const Vec3 chord = end_ - start_;
    const double t = dot(p - start_, chord) / dot(chord, chord);
    return distance(p, at(t));
  }
  if (!spans(p)) return std::min(distance(p, start_), distance(p, end_));
  const Vec3 to_p = p - center();
  const double along = dot(to_p, frame_.x);
  const double across = dot(to_p, frame_.y);
  const double off_circle = std::sqrt(along * along + across * across) - radius_;
  const double off_plane = dot(to_p, frame_.z);
  return std::sqrt(off_circle * off_circle + off_plane * off_plane);
}

Box Curve::bounds() const {
  Box box;
  box.include(start_);
  box.include(end_);
  if (is_straight()) return box;
  for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    // The circle's extreme points along this axis lie where the axis' projection into its plane points.
    const Vec3 projected = frame_.x.*axis * frame_.x + frame_.y.*axis * frame_.y;
    const double size = synth::length(projected);
    if (size == 0) continue;
    for (const double side : {-radius_, radius_}) {
      const Vec3 extreme = center() + (side / size) * projected;
      if (spans(extreme)) box.include(extreme);
    }
  }
  return box;
}

Curve Curve::mapped(const Frame& frame) const {
  Curve result = *this;
  result.start_ = frame.point(start_);
  result.end_ = frame.point(end_);
  result.frame_ = {frame.point(frame_.origin), frame.direction(frame_.x), frame.direction(frame_.y),
                   frame.direction(frame_.z)};
  return result;
}

bool is_smooth_joint(const Curve& previous, const Curve& next) {
  return distance(previous.end_direction(), next.start_direction()) < 1e-9;
}

}  // namespace keenline::synth
