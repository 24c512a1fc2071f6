#include "support/textbook_gauss.h"

#include <cmath>
#include <numbers>

#include <Eigen/Dense>

namespace keenline::test {
namespace {

Eigen::Vector3d vector_of(const Point& p) { return {p[0], p[1], p[2]}; }

/// Agglomeration: merge the closest pair of clusters until the closest are further apart than sigma.
std::vector<int> cluster_sizes(const std::vector<Eigen::Vector3d>& lines, double sigma) {
  const auto n = static_cast<Eigen::Index>(lines.size());
  Eigen::MatrixXd mean(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      mean(i, j) = std::acos(std::min(
          1.0, std::abs(lines[static_cast<std::size_t>(i)].dot(lines[static_cast<std::size_t>(j)]))));
  std::vector<int> size(lines.size(), 1);  // 0 = merged into another
  for (;;) {
    Eigen::Index a = -1;
    Eigen::Index b = -1;
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = i + 1; j < n; ++j)
        if (size[static_cast<std::size_t>(i)] > 0 && size[static_cast<std::size_t>(j)] > 0 &&
            (a < 0 || mean(i, j) < mean(a, b))) {
          a = i;
          b = j;
        }
    if (a < 0 || mean(a, b) > sigma) break;
    int& size_a = size[static_cast<std::size_t>(a)];
    int& size_b = size[static_cast<std::size_t>(b)];
    for (Eigen::Index c = 0; c < n; ++c) {
      if (c == a || c == b) continue;
      mean(a, c) = mean(c, a) = (size_a * mean(a, c) + size_b * mean(b, c)) / (size_a + size_b);
    }
    size_a += size_b;
    size_b = 0;
  }
  return size;
}

}  // namespace

TextbookLabel textbook_gauss(const PointCloud& cloud, std::size_t point,
                             std::span<const std::uint32_t> neighbors, double sigma_deg, int max_clusters,
                             double min_sine) {
  const Eigen::Vector3d p = vector_of(cloud.positions[point]);
  std::vector<Eigen::Vector3d> lines;
  for (std::size_t i = 0; i < neighbors.size(); ++i)
    for (std::size_t j = i + 1; j < neighbors.size(); ++j) {
      const Eigen::Vector3d a = vector_of(cloud.positions[neighbors[i]]) - p;
      const Eigen::Vector3d b = vector_of(cloud.positions[neighbors[j]]) - p;
      const Eigen::Vector3d normal = a.cross(b);
      if (normal.norm() > 0 && normal.norm() >= min_sine * a.norm() * b.norm())
        lines.push_back(normal.normalized());
    }
  if (lines.size() < 3) return {Kind::Flat, 0};
  const double needed = std::max(3.0, std::ceil(static_cast<double>(lines.size()) / 10));
  TextbookLabel label;
  for (const int size : cluster_sizes(lines, sigma_deg * std::numbers::pi / 180))
    if (size >= needed) ++label.clusters;
  if (label.clusters == 1) label.kind = Kind::Flat;
  else if (label.clusters == 0 || label.clusters > max_clusters) label.kind = Kind::Curved;
  else label.kind = label.clusters == 2 ? Kind::Edge : Kind::Corner;
  return label;
}

}  // namespace keenline::test
