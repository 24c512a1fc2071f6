#include "support/textbook_gauss.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

/// 256 q², rounded down; the altitude tells the area.
double shape_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  if (a.norm() == 0) return 0;
  const double altitude = (b - b.dot(a.normalized()) * a.normalized()).norm();
  const double area = altitude * a.norm() / 2;
  const double q = 4 * std::sqrt(3.0) * area / (a.squaredNorm() + b.squaredNorm() + (a - b).squaredNorm());
  return std::min(255.0, std::floor(256 * q * q));
}

struct Triangle {
  Eigen::Vector3d a;  // the point is the origin
  Eigen::Vector3d b;
  double shape = 0;
};

void keep_best(std::vector<Triangle>& triangles, std::size_t wanted) {
  if (wanted >= triangles.size()) return;
  std::vector<double> shapes;
  for (const Triangle& triangle : triangles) shapes.push_back(triangle.shape);
  std::ranges::sort(shapes, std::greater());
  std::erase_if(triangles, [&](const Triangle& triangle) { return triangle.shape < shapes[wanted - 1]; });
}

}  // namespace

TextbookLabel textbook_gauss(const PointCloud& cloud, std::size_t point,
                             std::span<const std::uint32_t> neighbors, const GaussOptions& options) {
  const Eigen::Vector3d p = vector_of(cloud.positions[point]);
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < neighbors.size(); ++i)
    for (std::size_t j = i + 1; j < neighbors.size(); ++j) {
      const Eigen::Vector3d a = vector_of(cloud.positions[neighbors[i]]) - p;
      const Eigen::Vector3d b = vector_of(cloud.positions[neighbors[j]]) - p;
      triangles.push_back({a, b, shape_of(a, b)});
    }
  if (options.triangles) keep_best(triangles, static_cast<std::size_t>(*options.triangles));
  std::vector<Eigen::Vector3d> lines;
  for (const auto& [a, b, shape] : triangles) {
    const Eigen::Vector3d normal = a.cross(b);
    if (normal.norm() > 0 && normal.norm() >= options.min_sine * a.norm() * b.norm())
      lines.push_back(normal.normalized());
  }
  if (lines.size() < 3) return {Kind::Flat, 0};
  const double needed = std::max(3.0, std::ceil(static_cast<double>(lines.size()) / 10));
  TextbookLabel label;
  for (const int size : cluster_sizes(lines, options.sigma_deg * std::numbers::pi / 180))
    if (size >= needed) ++label.clusters;
  if (label.clusters == 1) label.kind = Kind::Flat;
  else if (label.clusters == 0 || label.clusters > options.max_clusters.value_or(4))
    label.kind = Kind::Curved;
  else label.kind = label.clusters == 2 ? Kind::Edge : Kind::Corner;
  return label;
}

}  // namespace keenline::test
