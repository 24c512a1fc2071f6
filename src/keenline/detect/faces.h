#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

class GaussMap;

/// One significant direction of a Gauss map: a face of the surface that the point takes part in.
struct Face {
  /// Unit vector, up to its sign: where the lines gather that it was born of; of a lone face, all lines.
  Point normal;
  /// Height of the merge, in units of 1/728 degree, at which the lines of the face first were significant:
  /// how much the face scatters by itself.
  double birth;
  /// The face is a direction of its own at every sensitivity below this height; infinite for the oldest face.
  double death = std::numeric_limits<double>::infinity();
  /// Seen from the point, the neighbours that lie on the face leave a sector of more than 115 degrees empty.
  bool ends = false;
  /// The same with 160 degrees: too wide for chance, as on the rim of an open surface.
  bool is_half = false;
};

/// Working memory of find_faces(), kept between calls.
struct FaceWorkspace {
  struct Cluster {
    std::uint32_t next;    // the next line of the same cluster
    std::uint32_t last;    // the last line of the cluster that begins here
    std::uint32_t oldest;  // index of its oldest face in born, the first of a list
    std::uint32_t newest;  // index of the last face of that list
  };
  struct Birth {
    std::uint32_t first, lines;  // the lines that it was born of: so many from the first one on
    std::uint32_t next;          // the next face of the same cluster
    double height;
    double death;
  };
  std::vector<Cluster> clusters;
  std::vector<Birth> born;
};

/// The faces at the point whose Gauss map has been clustered, oldest first.
///
/// A face is born where a cluster first has `min_cluster` lines: its densest lines, which the mixed triangles
/// across an edge have not yet pulled aside. Where two clusters that hold faces merge, the faces of the
/// younger die (the elder rule of persistent homology); those that die at less than persistence times the
/// height of their birth never were directions of their own, but the scatter of one, and are not returned.
///
/// On an edge or a corner every face ends; beside an edge, on a thin wall or on a curved surface at
/// least one does not: that is what makes edges one point thin.
void find_faces(const GaussMap& map, int min_cluster, double persistence, FaceWorkspace& workspace,
                std::vector<Face>& faces);

/// Below this all lines are one direction, in units of 1/728 degree: no face dies at less than persistence
/// times one degree.
[[nodiscard]] double unresolved_angle(double persistence);

/// Face::is_half of the one face that find_faces() returns where all lines are nearer to each other than that
/// and than 7 degrees. Needs no clustering. \pre at least min_cluster lines
[[nodiscard]] bool lone_face_is_half(const GaussMap& map);

}  // namespace keenline
