#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "keenline/synth/vec3.h"

namespace keenline::synth {

/// An axis-parallel box; empty until it includes something.
struct Box {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high = -1 * low;

  void include(const Vec3& p);
  void include(const Box& other) {
    include(other.low);
    include(other.high);
  }
  [[nodiscard]] Vec3 center() const { return 0.5 * (low + high); }
  [[nodiscard]] double diagonal() const { return distance(low, high); }
};

/// A straight segment, a circular arc or a whole circle. Edges are such curves in space; outlines and
/// profiles are chains of them with z = 0.
class Curve {
 public:
  [[nodiscard]] static Curve segment(const Vec3& start, const Vec3& end);
  /// Counterclockwise about the unit vector `normal`. \pre start != end, both equally far from the centre
  [[nodiscard]] static Curve arc(const Vec3& start, const Vec3& end, const Vec3& center,
                                 const Vec3& normal = {0, 0, 1});
  /// About `normal` from center + radius * x_axis. \pre x_axis is a unit vector perpendicular to `normal`
  [[nodiscard]] static Curve circle(const Vec3& center, double radius, const Vec3& normal = {0, 0, 1},
                                    const Vec3& x_axis = {1, 0, 0});

  [[nodiscard]] bool is_straight() const { return radius_ == 0; }
  [[nodiscard]] bool is_circle() const { return cos_half_angle_ <= -1; }
  [[nodiscard]] const Vec3& start() const { return start_; }
  [[nodiscard]] const Vec3& end() const { return end_; }
  [[nodiscard]] double length() const;
  /// t = 0 is exactly start(), t = 1 exactly end(); arc length grows evenly with t.
  [[nodiscard]] Vec3 at(double t) const;
  [[nodiscard]] Vec3 start_direction() const;  ///< unit vector along the curve
  [[nodiscard]] Vec3 end_direction() const;
  [[nodiscard]] double distance_to(const Vec3& p) const;
  [[nodiscard]] Box bounds() const;
  [[nodiscard]] Curve mapped(const Frame& frame) const;

  // Arcs and circles only:
  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] const Vec3& center() const { return frame_.origin; }
  [[nodiscard]] const Vec3& normal() const { return frame_.z; }
  /// Angle on either side of the middle of the arc; pi for a circle.
  [[nodiscard]] double half_angle() const { return half_angle_; }
  /// The point of the arc's circle at this angle from the middle, as a unit vector from the centre.
  [[nodiscard]] Vec3 outward(double angle) const;
  /// Whether the direction from the centre to `p` lies within the arc (`p` projected into the arc's plane).
  [[nodiscard]] bool spans(const Vec3& p, double slack = 0) const;

 private:
  Curve(const Vec3& start, const Vec3& end) : start_(start), end_(end) {}

  Vec3 start_;
  Vec3 end_;
  Frame frame_;  // origin: centre; x: towards the middle of the arc; z: normal
  double radius_ = 0;
  double half_angle_ = 0;
  double cos_half_angle_ = 1;
};

/// True when `next` goes on where `previous` ends without a turn.
[[nodiscard]] bool is_smooth_joint(const Curve& previous, const Curve& next);

}  // namespace keenline::synth
