#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "keenline/detect/relabel.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct Neighborhoods;
struct PointCloud;

struct GaussOptions {
  /// Neighbours that a point needs to be decided; with fewer it is undecided. 3 to 255.
  int neighbors = 16;
  /// So many sizes of neighbourhood are looked at, see neighborhood_sizes(), and the majority decides whether
  /// a point is sharp. 1 to 5.
  int scales = 1;
  /// Sensitivity: lines closer than this on average are one direction. With plain, Auto is the paper's 20
  /// degrees.
  SigmaRule sigma_rule = SigmaRule::Auto;
  /// Degrees, 0 < sigma_deg <= 90, in steps of 1/728; used with SigmaRule::Given only.
  double sigma_deg = 20;
  /// Lines that a cluster needs to be significant, >= 1. Empty = a tenth of the lines of the point, at
  /// least 3.
  std::optional<int> min_cluster;
  /// Up to so many significant clusters are a feature, more are curvature. 2 to 255. Empty = 6; with plain
  /// the paper's 4.
  std::optional<int> max_clusters;
  /// Triangles whose sine at the point is below this have no usable normal and are skipped. 0 to 1.
  double min_sine = 0.001;
  /// So many triangles of a point, the best shaped, make its lines, and those shaped as well as the last; see
  /// kernels::triangle_shapes(). 3 to 32385. Empty = all.
  std::optional<int> triangles;
  /// How many times higher than its birth a cluster must merge with an older one to be a direction of its
  /// own; see find_faces(). 1 to 90. Empty = 3, or 2 unless thin, where nothing else tells an edge from
  /// chance.
  std::optional<double> persistence;
  /// Sharp points with fewer sharp points among their 16 nearest neighbours are not taken for sharp, border
  /// points with fewer border points not for borders: chance, not a line. 0 to 16.
  int min_support = 1;
  /// Of the band of points that see several faces, about two spacings to each side of an edge, only those at
  /// which the faces end and for which is_beside_crease() does not hold: one point thin where points lie on
  /// the edge.
  bool thin = true;
  /// The paper's section 4 with these parameters and nothing else.
  bool plain = false;
  /// Return the labels of all other sensitivities too: FeatureLabels::spectrum.
  bool keep_spectrum = false;
};

/// The sizes that `scales` stands for: `neighbors` first, then by turns larger and smaller ones in steps of
/// the square root of 2, from 3 to 255.
[[nodiscard]] std::vector<int> neighborhood_sizes(int neighbors, int scales);

/// Sharp features by Gauss map clustering: every triangle of a point and two of its neighbours gives a line
/// through the unit sphere; lines are clustered by average linkage on the angle between them.
///
/// Plain: clusters are cut at sigma. One significant cluster is flat, two are an edge, three to max_clusters
/// a corner, none or more are curved; fewer than 3 lines: flat. Otherwise the point may be a peak, see
/// is_peak(), where it is not flat; else the significant clusters must be the faces of a surface that end at
/// the point, see find_faces(): two are an edge, more a corner unless their normals lie in one plane; one
/// that ends is a border, one that does not is flat when all significant lines are one direction at sigma,
/// and curved otherwise.
///
/// The score is the largest angle, in degrees, at which two significant clusters become one (0 below 3
/// degrees). Paper: Weber, Hahmann, Hagen, "Methods for Feature Detection in Point Clouds", section 4.
/// Departures: see docs/methods/gauss.md. Threads: any number, same bits. Cost: O(n k^4). Memory: k^4 bytes
/// per thread up to k = 32, 2 k^4 above; about 20 bytes a point. \pre neighborhoods.size() == cloud.size()
/// \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_gauss(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                         const GaussOptions& options = {},
                                         Progress& progress = no_progress());

/// The same, with neighbours found as they are needed: there never is a table of all. Memory: about 60 bytes
/// a point at most. \pre the search is that of cloud.positions
[[nodiscard]] FeatureLabels detect_gauss(const PointCloud& cloud, const NeighborSearch& search,
                                         const GaussOptions& options = {},
                                         Progress& progress = no_progress());

/// The Gauss map of one point, cut at sigma.
struct PointGaussMap {
  std::vector<std::array<float, 3>> lines;  ///< unit vectors; a line and its reverse are the same
  std::vector<int> cluster;  ///< of every line: its place in sizes, or -1 when its cluster is not significant
  std::vector<int> sizes;    ///< lines of every significant cluster, largest first
  Kind kind = Kind::Undecided;  ///< as detect_gauss() has it before isolated points are filtered
  double sigma_deg = 0;         ///< where it is cut; with SigmaRule::Local in the middle of its range
};

/// Cost: as detect_gauss() when sigma is to be chosen from the cloud, that of one point otherwise.
/// \pre and \throw as detect_gauss(); InvalidArgument unless point < cloud.size()
[[nodiscard]] PointGaussMap gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                      std::size_t point, const GaussOptions& options = {},
                                      Progress& progress = no_progress());

}  // namespace keenline
