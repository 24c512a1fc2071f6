#include "keenline/lines/candidates.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
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
                       double spacing, const Progress& progress) {
  if (labels.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} labels for {} points", labels.size(), cloud.size()));
  std::vector<bool> is_chosen(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) is_chosen[i] = is_candidate(labels.kind[i]);
  placed_ = place_points(cloud, search, is_chosen, spacing);
  const std::vector<std::uint32_t>& points = placed_.points;
  // Both copies of the lists, for as long as it takes to put the one together.
  constexpr std::uint64_t bytes_per_candidate =
      2 * std::uint64_t{neighbors_near} * sizeof(std::uint32_t) + 80;
  require_memory(size() * bytes_per_candidate, "candidates of lines");
  std::vector<std::vector<std::uint32_t>> near(size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        for (const std::uint32_t point : search.nearest(points[i], neighbors_near)) {
                          const auto place = std::lower_bound(points.begin(), points.end(), point);
                          if (place != points.end() && *place == point)
                            near[i].push_back(static_cast<std::uint32_t>(place - points.begin()));
                        }
                      }
                    });
  near_.reserve(std::transform_reduce(near.begin(), near.end(), std::size_t{0}, std::plus<>(),
                                      [](const auto& list) { return list.size(); }));
  offsets_.reserve(size() + 1);
  for (const auto& list : near) {
    near_.insert(near_.end(), list.begin(), list.end());
    offsets_.push_back(near_.size());
  }
}

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
    std::uint32_t size = candidates.copies()[seed];
    for (const std::uint32_t other : candidates.near(seed)) {
      if (result.cluster[other] != none || distance(positions[seed], positions[other]) > radius) continue;
      result.cluster[other] = name;
      total = sum(total, positions[other]);
      ++count;
      size += candidates.copies()[other];
    }
    result.centroids.push_back(scaled(1.0 / count, total));
    result.sizes.push_back(size);
  }
  return result;
}

}  // namespace keenline
