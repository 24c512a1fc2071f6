#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "keenline/progress.h"
#include "keenline/synth/curve.h"
#include "keenline/synth/random.h"

namespace keenline::synth {

/// A half line; `direction` is a unit vector.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// A closed chain of curves in the plane z = 0: each starts where the one before ends.
using Outline = std::vector<Curve>;

/// A piece of a shape's surface. Everything about it is exact up to rounding: nothing is triangulated.
class Face {
 public:
  Face() = default;
  Face(const Face&) = delete;
  Face& operator=(const Face&) = delete;
  virtual ~Face() = default;

  [[nodiscard]] virtual double area() const = 0;
  [[nodiscard]] virtual Box bounds() const = 0;
  [[nodiscard]] virtual bool is_curved() const = 0;
  /// Uniform by area.
  [[nodiscard]] virtual Vec3 random_point(RandomStream& random) const = 0;
  /// Appends a regular lattice, at least `spacing` between rows, that stays half a step off the ends of the
  /// face's own coordinates. Plane lattices have a pitch of few bits, at most `spacing`, so that equal
  /// distances are equal bits.
  virtual void add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const = 0;
  /// Distance along the ray to its first meeting with the face; infinite when there is none.
  [[nodiscard]] virtual double hit(const Ray& ray) const = 0;
};

/// A part of a plane: inside the first outline, outside the others.
class PlaneFace final : public Face {
 public:
  /// `frame` maps the outlines' plane into space.
  PlaneFace(const Frame& frame, std::vector<Outline> outlines);

  [[nodiscard]] double area() const override;
  [[nodiscard]] Box bounds() const override;
  [[nodiscard]] bool is_curved() const override { return false; }
  [[nodiscard]] Vec3 random_point(RandomStream& random) const override;
  void add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const override;
  [[nodiscard]] double hit(const Ray& ray) const override;

 private:
  [[nodiscard]] bool contains(const Vec3& local) const;

  Frame frame_;
  std::vector<Outline> outlines_;
  Box local_bounds_;
};

/// What a profile sweeps out when it turns about an axis parallel to z: parts of cylinders, cones, spheres
/// and tori.
class RevolvedFace final : public Face {
 public:
  /// \param axis a point on the axis
  /// \param profile (distance from the axis, z, 0); not a segment of constant z, as that sweeps out a plane
  /// \param turn how far it turns: an arc of the unit circle in the plane z = 0
  RevolvedFace(const Vec3& axis, const Curve& profile, const Curve& turn);

  [[nodiscard]] double area() const override;
  [[nodiscard]] Box bounds() const override { return bounds_; }
  [[nodiscard]] bool is_curved() const override { return true; }
  [[nodiscard]] Vec3 random_point(RandomStream& random) const override;
  void add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const override;
  [[nodiscard]] double hit(const Ray& ray) const override;

 private:
  [[nodiscard]] Vec3 at(const Vec3& profile_point, double angle) const;
  [[nodiscard]] bool contains(const Vec3& local) const;

  Vec3 axis_;  // z = 0
  Curve profile_;
  Curve turn_;
  double largest_radius_ = 0;
  Box bounds_;
};

/// Another face, moved.
class MovedFace final : public Face {
 public:
  /// \param frame of axes that are coordinate axes, so that bounds stay tight: where the face's own
  /// coordinates lie in space
  MovedFace(const Frame& frame, std::unique_ptr<const Face> face) : frame_(frame), face_(std::move(face)) {}

  [[nodiscard]] double area() const override { return face_->area(); }
  [[nodiscard]] Box bounds() const override;
  [[nodiscard]] bool is_curved() const override { return face_->is_curved(); }
  [[nodiscard]] Vec3 random_point(RandomStream& random) const override;
  void add_lattice(double spacing, std::vector<Vec3>& points, const Progress& progress) const override;
  [[nodiscard]] double hit(const Ray& ray) const override;

 private:
  Frame frame_;
  std::unique_ptr<const Face> face_;
};

}  // namespace keenline::synth
