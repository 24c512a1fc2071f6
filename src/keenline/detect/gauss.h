#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct Neighborhoods;
struct PointCloud;

struct GaussOptions {
  /// Neighbours that a point needs to be decided; with fewer it is undecided. 3 to 255.
  int neighbors = 16;
  /// Sensitivity: lines closer than this on average are one direction. Degrees, 0 < sigma <= 90. Empty =
  /// chosen from the cloud by choose_sigma().
  std::optional<double> sigma_deg = 20.0;
  /// Lines that a cluster needs to be significant, >= 1. Empty = a tenth of the lines of the point, at
  /// least 3.
  std::optional<int> min_cluster;
  /// Up to so many significant clusters are a feature, more are curvature. 2 to 255.
  int max_clusters = 4;
  /// Triangles whose sine at the point is below this have no usable normal and are skipped. 0 to 1.
  double min_sine = 0.001;
  /// Points whose lines deviate less than this on average from their common direction are flat, whatever
  /// their clusters. Degrees, 0 to 90; 0 = off. 15 % of the range, as in the paper's second form (SMI 2010).
  double flatness_deg = 13.5;
  /// The paper's section 4 with these parameters and nothing else: no flatness test; sigma_deg must be a
  /// number.
  bool plain = false;
};

/// Sharp features by Gauss map clustering: every triangle of a point and two of its neighbours gives a line
/// through the unit sphere; lines are clustered by average linkage on the angle between them and cut at
/// sigma. One significant cluster is flat, two are an edge, three to max_clusters a corner, none or more are
/// curved; fewer than 3 lines: flat. The score is the largest angle, in degrees, at which two significant
/// clusters become one (0 below 90/64 degrees). Paper: Weber, Hahmann, Hagen, "Methods for Feature Detection
/// in Point Clouds", section 4. With the flatness test of the same authors' "Sharp Feature Detection in Point
/// Clouds", SMI 2010, unless plain. Departures: angles are whole multiples of 1/728 degree, see
/// docs/methods/gauss.md. Threads: any number, same bits. Cost: O(n k^4) worst case, O(n k^2) where the
/// surface is flat. Memory: k^4 bytes per thread up to k = 32, 2 k^4 above. \pre neighborhoods.size() ==
/// cloud.size() \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_gauss(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                         const GaussOptions& options = {},
                                         Progress& progress = no_progress());

/// One sensitivity for the whole cloud, in degrees: the one around which the fewest labels depend on its
/// exact value, among 64 candidates up to 90 degrees. Computed from at most 16,384 points, evenly spread over
/// the cloud's order. options.sigma_deg is not used. Threads: any number, same result. \pre and \throw as
/// detect_gauss()
[[nodiscard]] double choose_sigma(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                  const GaussOptions& options = {}, Progress& progress = no_progress());

/// The Gauss map of one point as detect_gauss() judges it, cut at sigma.
struct PointGaussMap {
  std::vector<std::array<float, 3>> lines;  ///< unit vectors; a line and its reverse are the same
  std::vector<int> cluster;  ///< of every line: its place in sizes, or -1 when its cluster is not significant
  std::vector<int> sizes;    ///< lines of every significant cluster, largest first
  Kind kind = Kind::Undecided;
};

/// \pre and \throw as detect_gauss(); InvalidArgument unless point < cloud.size()
[[nodiscard]] PointGaussMap gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                      std::size_t point, const GaussOptions& options = {},
                                      Progress& progress = no_progress());

}  // namespace keenline
