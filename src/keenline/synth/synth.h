#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/progress.h"

namespace keenline {

enum class Sampling : std::uint8_t {
  Random,  ///< uniform by area
  Grid,    ///< a regular lattice on every face, half a spacing off edges and borders: full of ties
  Mesh,  ///< lattice inside the faces, and points exactly on edges, borders and corners, as mesh vertices lie
  Scan   ///< a virtual scanner: rays from six stations, occlusion, uneven density
};

/// How far points are moved off the surface: normally distributed with this standard deviation, independently
/// in every coordinate; of a scan, along the ray.
struct Noise {
  enum class Unit : std::uint8_t { Spacing, BoundingBoxDiagonal };
  double amount =
      0;  ///< >= 0, in `unit`: SynthCloud::spacing, or the diagonal of the shape's axis-parallel box
  Unit unit = Unit::Spacing;
};

struct SynthOptions {
  std::string shape = "cube";    ///< a name from synth_shapes()
  std::uint64_t points = 10000;  ///< 1 to max_points; grid, mesh and scan come close, random is exact
  Sampling sampling = Sampling::Random;
  Noise noise;
  std::uint64_t seed = 1;           ///< grids and meshes without noise do not depend on it
  std::optional<double> angle_deg;  ///< only for a shape with SynthShape::angle, within that range
  double feature_band = 0.5;        ///< >= 0: truth_feature is 1 within this many spacings of a sharp feature
};

/// What angle a shape takes, in degrees. Crease: the dihedral angle (180 is flat, and no edge). Cone: the
/// full opening.
struct AngleRange {
  double smallest = 0;
  double largest = 0;
  double standard = 0;  ///< when none is given
};

/// One row of the table of shapes.
struct SynthShape {
  std::string_view name;
  std::string_view summary;
  std::optional<AngleRange> angle;
};

/// A line of the shape's exact truth.
struct TruthCurve {
  std::vector<Point> vertices;  ///< ordered; a closed curve does not repeat its first vertex
  bool closed = false;
  bool border = false;  ///< rim of an open surface instead of a sharp edge
};

/// Points in a fixed order: that of the faces (grid, mesh), of the rays (scan), or none (random).
struct SynthCloud {
  PointCloud cloud;  ///< attributes truth_feature, truth_kind (uint8) and truth_distance (float64)
  std::vector<TruthCurve>
      curves;  ///< from corner to corner; arcs have vertices at most `spacing` and 5 degrees apart
  std::vector<Point> corners;         ///< where three edges meet, or two at an angle
  std::vector<Point> border_corners;  ///< where two borders meet at an angle: not sharp
  std::vector<Point> peaks;           ///< sharp points that lie on no edge: the apex of a cone
  double spacing = 0;                 ///< h = sqrt(area / points)
};

[[nodiscard]] std::span<const SynthShape> synth_shapes();

/// Points on a shape whose sharp features are known exactly. Same options, same bits, on every CPU and any
/// number of threads. All truth is that of the point before noise: truth_distance: to the nearest sharp edge,
/// corner or peak (infinite when there is none); truth_feature: 1 where that is at most feature_band * h;
/// truth_kind, a number of Kind: within the same band of a corner Corner, else of a peak Peak, of an edge
/// Edge, of a border Border; elsewhere Flat or Curved, as the face is. Where faces join smoothly there is no
/// edge: the attributes of a rounded shape know none, only its curves and corners are those it had before it
/// was rounded. \throw InvalidArgument for an unknown shape or an option out of range; Cancelled.
[[nodiscard]] SynthCloud synthesize(const SynthOptions& options, Progress& progress = no_progress());

}  // namespace keenline
