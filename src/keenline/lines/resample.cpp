#include "keenline/lines/resample.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/lines/arc_length.h"
#include "keenline/memory.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double largest_cosine = 0.70710678118654752;  // of a bend: 45 degrees

/// How the line goes on at a place: the cosine between the step before and the step behind it.
double straightness(const ArcLength& arc, double place, double step) {
  const Point here = arc.point(place);
  const Point before = difference(here, arc.point(place - step));
  const Point behind = difference(arc.point(place + step), here);
  const double product = length(before) * length(behind);
  return product > 0 ? dot(before, behind) / product : 1;
}

/// Places of the vertices that stay for the bend that they make, rising.
std::vector<double> bends_of(const Polyline& line, const ArcLength& arc, double step) {
  const std::size_t count = line.vertices.size();
  const std::size_t first = line.closed ? 0 : 1;
  const std::size_t last = line.closed ? count : count - 1;
  std::vector<double> cosines(count, 1);
  for (std::size_t i = first; i < last; ++i) cosines[i] = straightness(arc, arc.at(i), step);
  const auto is_sharpest = [&](std::size_t i) {
    const auto yields_to = [&](std::size_t j) {
      return cosines[j] < cosines[i] || (cosines[j] == cosines[i] && j < i);
    };
    for (std::size_t j = i; j-- > 0 && arc.at(i) - arc.at(j) <= step;)
      if (yields_to(j)) return false;
    for (std::size_t j = i + 1; j < count && arc.at(j) - arc.at(i) <= step; ++j)
      if (yields_to(j)) return false;
    return true;
  };
  std::vector<double> places;
  for (std::size_t i = first; i < last; ++i)
    if (cosines[i] < largest_cosine && is_sharpest(i)) places.push_back(arc.at(i));
  return places;
}

/// Where the new vertices go. A place may be beyond the end of a closed line: then it is round again.
std::vector<double> places_along(const Polyline& line, const ArcLength& arc, double step) {
  std::vector<double> fixed = bends_of(line, arc, step);
  const bool begins_at_first = !line.closed || line.start_corner || fixed.empty();
  if (begins_at_first && (fixed.empty() || fixed.front() > 0)) fixed.insert(fixed.begin(), 0.0);
  fixed.push_back(fixed.front() + arc.total());
  const double fewest = line.closed && fixed.size() == 2 ? 3 : (line.closed && fixed.size() == 3 ? 2 : 1);
  std::vector<double> places;
  for (std::size_t f = 0; f + 1 < fixed.size(); ++f) {
    const double way = fixed[f + 1] - fixed[f];
    const double pieces = std::max(fewest, std::round(way / step));
    if (static_cast<double>(places.size()) + pieces > static_cast<double>(max_points))
      throw OutOfMemory(fmt::format("a step of {} makes too many vertices", step));
    constexpr double bytes_per_vertex = 130;
    require_memory(static_cast<std::uint64_t>(bytes_per_vertex * pieces), "resampling lines");
    const auto count = static_cast<std::size_t>(pieces);
    for (std::size_t k = 0; k < count; ++k)
      places.push_back(fixed[f] + way * (static_cast<double>(k) / pieces));
  }
  if (!line.closed) places.push_back(fixed.back());
  return places;
}

double mixed(double a, double b, double part) { return a + part * (b - a); }

Point mixed(const Point& a, const Point& b, double part) {
  const Point mean = sum(a, scaled(part, difference(b, a)));
  const double size = length(mean);
  return size > 0 ? scaled(1 / size, mean) : a;
}

SideNormals mixed(const SideNormals& a, const SideNormals& b, double part) {
  return {mixed(a.left, b.left, part), mixed(a.right, b.right, part)};
}

template <typename T>
std::vector<T> interpolated(const std::vector<T>& values, const ArcLength& arc,
                            const std::vector<double>& places) {
  std::vector<T> result;
  if (values.empty()) return result;
  for (const double place : places) {
    const auto [segment, part] = arc.spot(place);
    result.push_back(mixed(values[segment], values[segment + 1 < values.size() ? segment + 1 : 0], part));
  }
  return result;
}

Polyline resampled(const Polyline& line, double step, const Progress& progress) {
  progress.check();
  const ArcLength arc(line);
  const std::vector<double> places = places_along(line, arc, step);
  Polyline result = line;
  result.fitted = {};
  result.vertices.clear();
  for (const double place : places) result.vertices.push_back(arc.point(place));
  // Ends are where they were, to the bit.
  if (!line.closed || line.start_corner) result.vertices.front() = line.vertices.front();
  if (!line.closed) result.vertices.back() = line.vertices.back();
  result.dihedral_deg = interpolated(line.dihedral_deg, arc, places);
  result.normals = interpolated(line.normals, arc, places);
  result.residual = interpolated(line.residual, arc, places);
  return result;
}

}  // namespace

FeatureGraph resample_lines(const FeatureGraph& graph, double step, const Progress& progress) {
  validate(graph);
  if (!(step > 0 && std::isfinite(step)))
    throw InvalidArgument(fmt::format("step: found {}, expected a number above 0", step));
  FeatureGraph result = graph;
  for (Polyline& line : result.polylines) line = resampled(line, step, progress);
  return result;
}

}  // namespace keenline
