#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "keenline/cloud.h"

namespace keenline::test {

/// The `count` nearest other points by (distance, index), from all of them.
/// \pre squares of coordinates neither overflow nor vanish
inline std::vector<std::uint32_t> nearest_by_force(const std::vector<Point>& points, std::size_t query,
                                                   std::size_t count) {
  std::vector<std::pair<double, std::uint32_t>> others;
  const Point& p = points[query];
  if (!is_finite(p)) return {};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& q = points[i];
    if (!is_finite(q) || q == p) continue;
    const Point d{q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    others.emplace_back(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], static_cast<std::uint32_t>(i));
  }
  const std::size_t found = std::min(count, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(found), others.end());
  std::vector<std::uint32_t> nearest;
  for (std::size_t i = 0; i < found; ++i) nearest.push_back(others[i].second);
  return nearest;
}

/// The `count` points nearest to any position by (distance, index), those at it included.
/// \pre squares of coordinates neither overflow nor vanish
inline std::vector<std::uint32_t> nearest_to_by_force(const std::vector<Point>& points, const Point& position,
                                                      std::size_t count) {
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point& q = points[i];
    if (!is_finite(q)) continue;
    const Point d{q[0] - position[0], q[1] - position[1], q[2] - position[2]};
    all.emplace_back(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], static_cast<std::uint32_t>(i));
  }
  std::sort(all.begin(), all.end());
  all.resize(std::min(count, all.size()));
  std::vector<std::uint32_t> nearest;
  for (const auto& [distance, index] : all) nearest.push_back(index);
  return nearest;
}

}  // namespace keenline::test
