#pragma once

#include <cstddef>
#include <optional>

#include "keenline/feature_graph.h"
#include "keenline/lines/side_surface.h"
#include "keenline/neighborhood/neighbor_search.h"

namespace keenline {

/// Which points beside a line tell of the surfaces there. Lengths are in spacings.
struct SidesOptions {
  double rim = 2.5;  ///< >= 0: nearer points are the edge's, which may be rounded or worn: they count where a
                     ///< face is too narrow to do without them, and then as few as possible
  double reach = 7;  ///< more than rim: farther points may belong to anything
  double stretch = 4;  ///< more than 0: so far along the line, both ways
};

/// One of the surfaces that meet in a line.
struct Side {
  SideSurface surface;
  Point inward{};           ///< unit vector across the line, from it into the surface
  double residual = 0;      ///< root mean square distance of its points, in the unit of the cloud
  std::size_t support = 0;  ///< number of those points
};

/// What meets in a line near one place, as seen from outside and looking along the line. A cloud does not
/// say what is outside: a line is taken for convex, the body in the smaller of the two angles. Of a border:
/// `left` is the surface; `right` stands upright on its rim, and is no surface of the body.
struct LineSides {
  Side left;
  Side right;
};

/// The two surfaces that meet near `position` in a line of this direction (a unit vector). Points between
/// rim and reach vote for half planes that begin at the line and follow it; the best two are refined
/// robustly, and either is bent, along the line or to a quadric, where that explains its points
/// significantly better (0.1 %). Then nearer points take part as far as they lie on a side. Nothing where
/// fewer than two such surfaces with at least 8 points each are found, where their points are on average
/// more than 0.35 spacings off, or where they meet at less than 7 degrees. Of a border: one surface and its
/// rim, from points up to reach along the line.
/// Threads: may be called from many at once. Cost: about 0.2 ms.
/// \pre spacing > 0
[[nodiscard]] std::optional<LineSides> find_sides(const PointCloud& cloud, const NeighborSearch& search,
                                                  const Point& position, const Point& direction,
                                                  LineKind kind, double spacing,
                                                  const SidesOptions& options = {});

}  // namespace keenline
