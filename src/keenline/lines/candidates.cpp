#include "keenline/lines/candidates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr int neighbors_near = 64;  // pi 4.5²

bool is_candidate(Kind kind) { return kind == Kind::Edge || kind == Kind::Corner; }

/// Towards the mean of what is near, across the line along which that lies; the less it is a line, the less.
Point drawn_together(const std::vector<Point>& positions, std::size_t own,
                     std::span<const std::uint32_t> near, double radius) {
  const Point& here = positions[own];
  Point total{};
  double count = 1;
  kernels::Symmetric3 squares;
  for (const std::uint32_t other : near) {
    const Point offset = difference(positions[other], here);
    if (dot(offset, offset) > radius * radius) continue;
    total = sum(total, offset);
    add_square(squares, offset, 1);
    ++count;
  }
  const Point mean = scaled(1 / count, total);
  add_square(squares, mean, -count);
  const kernels::Eigen3 axes = kernels::eigen_decomposition(squares);
  if (!(axes.values[0] > 0)) return here;
  const Point& along = axes.vectors[0];
  const Point across = difference(mean, scaled(dot(mean, along), along));
  return sum(here, scaled(1 - std::max(0.0, axes.values[1]) / axes.values[0], across));
}

}  // namespace

Candidates::Candidates(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                       double spacing, const Progress& progress)
    : spacing_(spacing) {
  if (labels.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} labels for {} points", labels.size(), cloud.size()));
  if (!(spacing > 0) || std::isinf(spacing)) return;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_candidate(labels.kind[i]) || !is_drawable(cloud.positions[i])) continue;
    if (points_.empty()) origin_ = cloud.positions[i];
    const Point offset = difference(cloud.positions[i], origin_);
    const Point position{offset[0] / spacing, offset[1] / spacing, offset[2] / spacing};
    if (!is_finite(position)) continue;
    points_.push_back(static_cast<std::uint32_t>(i));
    positions_.push_back(position);
  }
  std::vector<std::vector<std::uint32_t>> near(size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        for (const std::uint32_t point : search.nearest(points_[i], neighbors_near)) {
                          const auto place = std::lower_bound(points_.begin(), points_.end(), point);
                          if (place != points_.end() && *place == point)
                            near[i].push_back(static_cast<std::uint32_t>(place - points_.begin()));
                        }
                      }
                    });
  for (const auto& list : near) {
    near_.insert(near_.end(), list.begin(), list.end());
    offsets_.push_back(near_.size());
  }
}

Point Candidates::in_cloud(const Point& position) const { return sum(origin_, scaled(spacing_, position)); }

std::vector<Point> contracted(const Candidates& candidates, double radius, int rounds) {
  std::vector<Point> positions = candidates.positions();
  std::vector<Point> next(positions.size());
  for (int round = 0; round < rounds; ++round) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 256),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t i = range.begin(); i < range.end(); ++i)
                          next[i] = drawn_together(positions, i, candidates.near(i), radius);
                      });
    positions.swap(next);
  }
  return positions;
}

CandidateClusters cluster(const Candidates& candidates, std::span<const Point> positions,
                          std::span<const float> scores, double radius) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> order(candidates.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return scores[a] > scores[b]; });
  CandidateClusters result;
  result.cluster.assign(candidates.size(), none);
  for (const std::uint32_t seed : order) {
    if (result.cluster[seed] != none) continue;
    const auto name = static_cast<std::uint32_t>(result.sizes.size());
    result.cluster[seed] = name;
    Point total = positions[seed];
    std::uint32_t count = 1;
    for (const std::uint32_t other : candidates.near(seed)) {
      if (result.cluster[other] != none || distance(positions[seed], positions[other]) > radius) continue;
      result.cluster[other] = name;
      total = sum(total, positions[other]);
      ++count;
    }
    result.centroids.push_back(scaled(1.0 / count, total));
    result.sizes.push_back(count);
  }
  return result;
}

}  // namespace keenline
