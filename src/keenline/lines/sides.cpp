#include "keenline/lines/sides.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/lines/arc_length.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// Where on its line a vertex looks for its sides: not beside the corners.
double away_from_corners(double place, const Polyline& line, double total, double margin) {
  margin = std::min(margin, 0.5 * total);
  if (line.start_corner) place = std::max(place, margin);
  if (line.end_corner) place = std::min(place, total - margin);
  return place;
}

bool is_bent(const LineSides& sides) {
  const auto is_plane = [](const Side& side) {
    return std::all_of(side.surface.height.begin() + 3, side.surface.height.end(),
                       [](double factor) { return factor == 0; });
  };
  return !is_plane(sides.left) || !is_plane(sides.right);
}

/// For every vertex the nearest one along the line that has sides, the earlier of two; as many as there are
/// vertices where there is none at most `limit` away.
std::vector<std::size_t> nearest_known(const ArcLength& arc, bool closed, double limit,
                                       const std::vector<std::optional<LineSides>>& sides) {
  const std::size_t count = sides.size();
  std::vector<std::size_t> nearest(count, count);
  std::vector<double> ways(count, limit);
  // There and back again: from the one before or behind, twice round where the line is closed.
  const auto pass = [&](auto vertex, auto way_between) {
    std::size_t last = count;
    double way = 0;
    for (std::size_t k = 0; k < (closed ? 2 * count : count); ++k) {
      const std::size_t i = vertex(k % count);
      if (last < count) way += way_between(i);
      if (sides[i]) {
        last = i;
        way = 0;
      }
      if (last == count || !(way < ways[i] || (nearest[i] == count && way == limit))) continue;
      nearest[i] = last;
      ways[i] = way;
    }
  };
  const auto piece_before = [&](std::size_t i) {
    return i > 0 ? arc.at(i) - arc.at(i - 1) : arc.total() - arc.at(count - 1);
  };
  const auto piece_behind = [&](std::size_t i) {
    return (i + 1 < count ? arc.at(i + 1) : arc.total()) - arc.at(i);
  };
  pass([](std::size_t k) { return k; }, piece_before);
  pass([&](std::size_t k) { return count - 1 - k; }, piece_behind);
  return nearest;
}

/// Between the sides at a place, inside the body.
double dihedral_deg(const LineSides& sides, const SideNormals& normals) {
  // Into each surface from the line, perpendicular to both.
  const Point line = cross(normals.left, normals.right);
  const auto into = [&](const Point& normal, const Point& inward) {
    const Point across = cross(normal, line);
    return dot(across, inward) < 0 ? scaled(-1, across) : across;
  };
  const Point left = into(normals.left, sides.left.inward);
  const Point right = into(normals.right, sides.right.inward);
  return kernels::angle_of(length(cross(left, right)), dot(left, right)) * (180 / kernels::pi);
}

}  // namespace

const std::optional<LineSides>* KnownSides::at(const Point& position, const Point& direction) const {
  const auto found = sides_.find({position, direction});
  return found == sides_.end() ? nullptr : &found->second;
}

void KnownSides::add(const Point& position, const Point& direction, const std::optional<LineSides>& sides) {
  sides_.emplace(std::pair(position, direction), sides);
}

std::vector<std::optional<LineSides>> sides_along(const Polyline& line, const PointCloud& cloud,
                                                  const NeighborSearch& search, double spacing,
                                                  const SidesOptions& options, Progress& progress,
                                                  KnownSides* known) {
  const ArcLength arc(line);
  const std::size_t count = line.vertices.size();
  std::vector<std::optional<LineSides>> found(count);
  struct Look {
    Point position;
    Point direction;
    std::optional<LineSides> sides;
  };
  const auto look_at = [&](double place) {
    Look look{arc.point(place), arc.direction(place, 1.5 * options.stretch * spacing), {}};
    const auto* const before = known != nullptr ? known->at(look.position, look.direction) : nullptr;
    look.sides = before != nullptr
                     ? *before
                     : find_sides(cloud, search, look.position, look.direction, line.kind, spacing, options);
    return look;
  };
  std::vector<Look> looks(count);
  std::vector<std::optional<Look>> nearer_looks(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    progress.check();
    const auto place_for = [&](double margin) {
      return away_from_corners(arc.at(i), line, arc.total(), margin * spacing);
    };
    const double place = place_for(options.reach);
    looks[i] = look_at(place);
    found[i] = looks[i].sides;
    const double nearer = place_for(options.stretch);
    if (nearer != place && line.kind == LineKind::Crease && found[i] && is_bent(*found[i])) {
      nearer_looks[i] = look_at(nearer);
      found[i] = nearer_looks[i]->sides;
    }
    progress.advance(1);
  });
  if (known != nullptr) {
    *known = {};
    const auto keep = [&](const Look& look) { known->add(look.position, look.direction, look.sides); };
    for (const Look& look : looks) keep(look);
    for (const std::optional<Look>& look : nearer_looks)
      if (look) keep(*look);
  }
  const std::vector<std::size_t> nearest = nearest_known(arc, line.closed, options.reach * spacing, found);
  std::vector<std::optional<LineSides>> sides(count);
  for (std::size_t i = 0; i < count; ++i)
    if (nearest[i] < count) sides[i] = found[nearest[i]];
  return sides;
}

void describe(Polyline& line, const std::vector<std::optional<LineSides>>& sides) {
  line.dihedral_deg.clear();
  line.normals.clear();
  line.residual.clear();
  const ArcLength arc(line);
  for (const std::size_t known : nearest_known(arc, line.closed, arc.total(), sides)) {
    if (known == sides.size()) return;
    const LineSides& here = *sides[known];
    const auto normal_of = [&](const Side& side) {
      return side.surface.normal(side.surface.offset_of(line.vertices[known]));
    };
    line.residual.push_back(std::max(here.left.residual, here.right.residual));
    if (line.kind == LineKind::Border) {
      line.normals.push_back({normal_of(here.left), normal_of(here.left)});
    } else {
      line.normals.push_back({normal_of(here.left), normal_of(here.right)});
      line.dihedral_deg.push_back(dihedral_deg(here, line.normals.back()));
    }
  }
}

void measure_sides(FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search, double spacing,
                   Progress& progress) {
  validate(graph);
  if (!(spacing > 0 && std::isfinite(spacing)))
    throw InvalidArgument(fmt::format("spacing: found {}, expected a number above 0", spacing));
  std::uint64_t vertices = 0;
  for (const Polyline& line : graph.polylines) vertices += line.vertices.size();
  progress.begin("measuring lines", vertices);
  tbb::parallel_for(std::size_t{0}, graph.polylines.size(), [&](std::size_t i) {
    Polyline& line = graph.polylines[i];
    std::vector<double> residual = std::move(line.residual);
    describe(line, sides_along(line, cloud, search, spacing, {}, progress));
    if (!residual.empty()) line.residual = std::move(residual);
  });
}

}  // namespace keenline
