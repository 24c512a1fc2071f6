#include "keenline/lines/ends.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "keenline/kernels/symmetric3.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// In spacings of the points around: a gap in a line is no longer.
constexpr double facing_reach = 6;

/// How far the ends have to be prolonged until they meet, if they do.
std::optional<double> way_to_meeting(const Ray& a, const Ray& b) {
  const double s = std::max(a.scale, b.scale);
  const double cosine = dot(a.direction, b.direction);
  if (cosine > parallel) return std::nullopt;
  if (cosine < -smooth_turn) {
    const Point gap = difference(b.start, a.start);
    const Point on = unit(difference(a.direction, b.direction));
    const double along = dot(gap, on);
    const double aside = length(difference(gap, scaled(along, on)));
    // Lines bend: the longer the gap, the more they may miss each other.
    if (along < -line_overrun * s || along > facing_reach * s) return std::nullopt;
    if (aside > std::max(largest_miss * s, 0.3 * along)) return std::nullopt;
    return std::abs(along) / 2;
  }
  const Approach at = approach_of(a, b);
  const auto [least, most] = std::minmax(at.first, at.second);
  if (at.miss > largest_miss * s || least < -line_overrun * s || most > line_reach * s) return std::nullopt;
  return std::max(most, -least);
}

struct Meeting {
  double way;
  std::size_t first;
  std::size_t second;
};

/// All pairs of ends that could come together, nearest first.
std::vector<Meeting> possible_meetings(const std::vector<Path>& paths, const std::vector<PathEnd>& ends) {
  FootGrid grid;
  for (std::size_t i = 0; i < ends.size(); ++i) grid.insert({i, 0, foot_at(paths, ends[i])});
  std::vector<Meeting> meetings;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Ray ray = ray_from(paths, ends[i]);
    // Two ends of one path this short are no loop with a gap.
    const bool is_short = static_cast<double>(paths[ends[i].path].feet.size()) < 3 * line_reach;
    grid.near(ray.start, 2 * line_reach * ray.scale, [&](const FootGrid::Entry& entry) {
      const std::size_t j = entry.path;
      if (j <= i || (is_short && ends[i].path == ends[j].path)) return;
      if (const auto way = way_to_meeting(ray, ray_from(paths, ends[j]))) meetings.push_back({*way, i, j});
    });
  }
  std::sort(meetings.begin(), meetings.end(), [](const Meeting& a, const Meeting& b) {
    if (a.way != b.way) return a.way < b.way;
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  });
  return meetings;
}

/// Do all ends point to their common point? Of two that could come together it is known.
bool agree(const std::vector<Path>& paths, const std::vector<PathEnd>& ends) {
  constexpr double slack = 1.5;  // the common point is not quite where two of them meet
  if (ends.size() == 2) return true;
  std::vector<const Foot*> feet;
  feet.reserve(ends.size());
  for (const PathEnd& end : ends) feet.push_back(&foot_at(paths, end));
  const Point middle = common_point(feet).position;
  return std::all_of(ends.begin(), ends.end(), [&](const PathEnd& end) {
    const Ray ray = ray_from(paths, end);
    const Point d = difference(middle, ray.start);
    const double along = dot(d, ray.direction);
    const double aside = length(difference(d, scaled(along, ray.direction)));
    return along > -slack * line_overrun * ray.scale && along < slack * line_reach * ray.scale &&
           aside < slack * largest_miss * ray.scale;
  });
}

}  // namespace

const Foot& foot_at(const std::vector<Path>& paths, const PathEnd& end) {
  const std::vector<Foot>& feet = paths[end.path].feet;
  return end.at_back ? feet.back() : feet.front();
}

Ray ray_from(const std::vector<Path>& paths, const PathEnd& end) {
  const Foot& foot = foot_at(paths, end);
  return {foot.position, scaled(end.at_back ? 1 : -1, foot.tangent), foot.scale};
}

Approach approach_of(const Ray& a, const Ray& b) {
  const Point gap = difference(b.start, a.start);
  const double c = dot(a.direction, b.direction);
  const double on_a = dot(gap, a.direction);
  const double on_b = dot(gap, b.direction);
  const double first = (on_a - c * on_b) / (1 - c * c);
  const double second = (c * on_a - on_b) / (1 - c * c);
  const Point p = sum(a.start, scaled(first, a.direction));
  const Point q = sum(b.start, scaled(second, b.direction));
  return {first, second, distance(p, q)};
}

CommonPoint common_point(std::span<const Foot* const> feet) {
  const auto count = static_cast<double>(feet.size());
  Point mean{};
  for (const Foot* foot : feet) mean = sum(mean, scaled(1 / count, foot->position));
  kernels::Symmetric3 matrix;
  Point right{};
  for (const Foot* foot : feet) {
    for (const Point& normal : foot->normals) {
      add_square(matrix, normal, 1);
      right = sum(right, scaled(dot(normal, difference(foot->position, mean)), normal));
    }
  }
  const kernels::Eigen3 eigen = kernels::eigen_decomposition(matrix);
  const double draw = 0.001 * count;  // planes that are within 3 degrees of parallel do not count
  Point offset{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Point& axis = eigen.vectors[i];
    offset = sum(offset, scaled(dot(axis, right) / (eigen.values[i] + draw), axis));
  }
  CommonPoint common{sum(mean, offset), 0};
  for (const Foot* foot : feet) {
    for (const Point& normal : foot->normals) {
      const double miss = dot(normal, difference(foot->position, common.position));
      common.residual += miss * miss / (2 * count);
    }
  }
  common.residual = std::sqrt(common.residual);
  return common;
}

std::vector<std::vector<PathEnd>> gather_ends(const std::vector<Path>& paths) {
  std::vector<PathEnd> ends;
  for (std::size_t p = 0; p < paths.size(); ++p)
    if (!paths[p].closed) ends.insert(ends.end(), {{p, false}, {p, true}});
  std::vector<std::vector<std::size_t>> groups;  // of ends
  groups.reserve(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) groups.push_back({i});
  const auto ends_of = [&](const std::vector<std::size_t>& group) {
    std::vector<PathEnd> members;
    members.reserve(group.size());
    for (const std::size_t i : group) members.push_back(ends[i]);
    return members;
  };
  std::vector<std::size_t> group_of(ends.size());
  std::iota(group_of.begin(), group_of.end(), std::size_t{0});
  for (const Meeting& meeting : possible_meetings(paths, ends)) {
    const std::size_t a = group_of[meeting.first];
    const std::size_t b = group_of[meeting.second];
    if (a == b) continue;
    std::vector<std::size_t> all = groups[a];
    all.insert(all.end(), groups[b].begin(), groups[b].end());
    if (!agree(paths, ends_of(all))) continue;
    for (const std::size_t i : groups[b]) group_of[i] = a;
    groups[a] = std::move(all);
    groups[b].clear();
  }
  std::vector<std::vector<PathEnd>> gathered;
  gathered.reserve(groups.size());
  for (const std::vector<std::size_t>& group : groups)
    if (!group.empty()) gathered.push_back(ends_of(group));
  return gathered;
}

}  // namespace keenline
