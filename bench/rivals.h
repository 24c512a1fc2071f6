#pragma once

#include <functional>
#include <string>
#include <vector>

namespace keenline {
struct PointCloud;
}

namespace keenline::bench {

/// Somebody else's way to the sharp points of a cloud; for comparison only.
struct Rival {
  std::string name;
  std::function<std::vector<bool>(const PointCloud& cloud)> sharp_points;
};

/// Those that this machine has. One thread each, neighbour search included.
[[nodiscard]] std::vector<Rival> rivals();

/// Voronoi covariance measure (Mérigot, Ovsjanikov, Guibas 2011) as CGAL has it: compute_vcm and its edge
/// test, with radii of 10 and 3 spacings. GPL.
[[nodiscard]] std::vector<bool> cgal_edges(const PointCloud& cloud);

/// PCL's normals from 16 neighbours, then its boundary estimation from as many: the way its users take to
/// edges, though made for rims.
[[nodiscard]] std::vector<bool> pcl_boundaries(const PointCloud& cloud);

}  // namespace keenline::bench
