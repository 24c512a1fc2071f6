#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/vcm_estimate_edges.h>
#include <CGAL/vcm_estimate_normals.h>
#include <array>
#include <cmath>

#include "keenline/cloud.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"

#include "rivals.h"

namespace keenline::bench {

std::vector<bool> cgal_edges(const PointCloud& cloud) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> points;
  points.reserve(cloud.size());
  for (const Point& p : cloud.positions) points.emplace_back(p[0], p[1], p[2]);
  // Radii in spacings, as its manual's example has them in proportion to each other.
  const double spacing = estimate_spacing(cloud, NeighborSearch(cloud.positions));
  constexpr double threshold = 0.16;
  std::vector<std::array<double, 6>> covariances;
  const auto maps =
      CGAL::parameters::point_map(CGAL::Identity_property_map<Kernel::Point_3>()).geom_traits(Kernel());
  CGAL::compute_vcm(points, covariances, 10 * spacing, 3 * spacing, maps);
  std::vector<bool> edges;
  edges.reserve(covariances.size());
  for (auto& covariance : covariances) edges.push_back(CGAL::vcm_is_on_feature_edge(covariance, threshold));
  return edges;
}

}  // namespace keenline::bench
