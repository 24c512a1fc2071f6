#pragma once

#include <vector>

#include "keenline/cloud.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/progress.h"

namespace keenline {

/// Whatever is used of a neighbourhood is the nearest part of it, and all of it where it is smaller.
struct SmoothOptions {
  int neighbors = 24;         ///< 3 to 255; more smooth more, and blur what is smaller
  int normal_neighbors = 16;  ///< 3 to 255; those that the first normal of a point is taken from
  double angle_deg = 20;      ///< 1 to 90; normals that differ by more hardly see each other
  int normal_rounds = 8;      ///< 0 to 1000
  int position_rounds = 6;    ///< 0 to 1000; 0 moves nothing
};

/// The positions without their noise, edges and corners kept: normals are averaged where they are alike,
/// then points move onto the planes of those neighbours whose normals are like theirs. Neighbourhoods stay
/// what they are. Normals are lines: none is ever given a side.
/// Sources: Zheng, Fu, Au, Tai 2011, "Bilateral normal filtering for mesh denoising" (weights by distance
/// and by the difference of normals; positions after normals); Sun, Rosin, Martin, Langbein 2007, "Fast and
/// effective feature-preserving mesh denoising" (moving along the neighbours' normals); both steps for
/// points: Valdivia et al. 2013, "Normal correction towards smoothing point-based surfaces", and Huang et
/// al. 2013, "Edge-aware point set resampling".
/// Departures: an average normal is the main axis of the weighted sum of n n^T, so that signs do not matter;
/// the difference of two normals is the sine between them.
/// Clean points: nothing moves on planes; near an edge a tenth of a spacing h on average, up to 8 h away
/// from it; a surface bent to radius R moves outwards by about 5 h^2 / R with the default options, because
/// planes that touch it beside a point pass above that point.
/// Points that are not finite, that have fewer than 3 neighbours or whose neighbours lie on one line stay
/// where they are, and no point moves onto a plane of theirs.
/// Offsets are exact and displacements are summed apart from coordinates: 1e7 with millimetres loses
/// nothing.
/// Threads: any number, same bits on every CPU. Cost: O(n neighbors rounds), about 20 us per point and core
/// with the default options. Memory: 72 bytes per point beside the cloud.
/// \pre neighborhoods were found in this cloud
/// \throw InvalidArgument when an option is out of range or unless neighborhoods.size() == cloud.size();
/// OutOfMemory; Cancelled.
[[nodiscard]] std::vector<Point> smooth_positions(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                                  const SmoothOptions& options = {},
                                                  Progress& progress = no_progress());

}  // namespace keenline
