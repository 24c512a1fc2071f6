#pragma once

#include <optional>
#include <span>

#include "keenline/cloud.h"

namespace keenline {

class GaussMap;
struct Face;

/// The line in which two faces meet, as the neighbours of a point tell it. Lengths are those of
/// GaussMap::offsets().
struct Crease {
  Point foot;       ///< from the point to the nearest point of the line
  Point direction;  ///< unit vector, up to its sign
  double distance;  ///< length of foot
  double scatter;   ///< root mean square distance of the neighbours from their plane, the larger of the two
};

/// The crease of the first two faces. Every neighbour belongs to the face whose plane through the point it is
/// nearest to, at most 40 degrees off it; a plane of least squares is laid through those of each, and the
/// planes meet in the line. Nothing if the neighbours of a face are fewer than three or lie in one row, or if
/// the planes are within 6 degrees of each other. \pre faces.size() >= 2
[[nodiscard]] std::optional<Crease> first_crease(const GaussMap& map, std::span<const Face> faces);

/// Does the point lie beside the crease of the first two faces and not on it? The crease is more than half a
/// spacing away, by more than twice the scatter tells, and at least two neighbours lie along the same piece
/// of it, half as far off. Without them the point is the best that the cloud has to show of the crease. A
/// face born below 4 degrees goes through the point, and where both do, the point is on the crease. \pre
/// faces.size() >= 2
[[nodiscard]] bool is_beside_crease(const GaussMap& map, std::span<const Face> faces);

/// Do the faces meet in a corner: do three or more have normals that span space, and at least three of the
/// neighbours, by the planes through the point, each? The lines of triangles across an edge gather in one
/// more cluster often enough, but those lie on no face of their own. \pre faces.size() <= 255
[[nodiscard]] bool make_corner(const GaussMap& map, std::span<const Face> faces);

}  // namespace keenline
