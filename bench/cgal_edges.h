#pragma once

#include <vector>

namespace keenline {
struct PointCloud;
}

namespace keenline::bench {

/// Sharp points by the Voronoi covariance measure (Mérigot, Ovsjanikov, Guibas 2011) as CGAL has it. GPL: for
/// comparison only.
std::vector<bool> cgal_edges(const PointCloud& cloud);

}  // namespace keenline::bench
