#include <pcl/features/boundary.h>
#include <pcl/features/normal_3d.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include "keenline/cloud.h"

#include "rivals.h"

namespace keenline::bench {

std::vector<bool> pcl_boundaries(const PointCloud& cloud) {
  constexpr int neighbors = 17;  // a point finds itself too
  const auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  points->reserve(cloud.size());
  for (const Point& p : cloud.positions) {
    const Point& origin = cloud.positions.front();  // PCL has single precision only
    points->emplace_back(static_cast<float>(p[0] - origin[0]), static_cast<float>(p[1] - origin[1]),
                         static_cast<float>(p[2] - origin[2]));
  }
  const auto tree = pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> normal_estimation;
  normal_estimation.setInputCloud(points);
  normal_estimation.setSearchMethod(tree);
  normal_estimation.setKSearch(neighbors);
  normal_estimation.compute(*normals);

  pcl::PointCloud<pcl::Boundary> boundaries;
  pcl::BoundaryEstimation<pcl::PointXYZ, pcl::Normal, pcl::Boundary> boundary_estimation;
  boundary_estimation.setInputCloud(points);
  boundary_estimation.setInputNormals(normals);
  boundary_estimation.setSearchMethod(tree);
  boundary_estimation.setKSearch(neighbors);
  boundary_estimation.compute(boundaries);

  std::vector<bool> result;
  result.reserve(boundaries.size());
  for (const pcl::Boundary& boundary : boundaries) result.push_back(boundary.boundary_point != 0);
  return result;
}

}  // namespace keenline::bench
