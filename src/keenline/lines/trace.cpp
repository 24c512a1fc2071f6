#include "keenline/lines/trace.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <numeric>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/detect/noise.h"
#include "keenline/errors.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/lines/junctions.h"
#include "keenline/lines/peaks.h"
#include "keenline/lines/rim_tracker.h"
#include "keenline/lines/walk.h"
#include "keenline/lines/wedge.h"
#include "keenline/order_statistics.h"

namespace keenline {
namespace {

std::vector<Foot> find_feet(const Tracker& tracker, const std::vector<std::uint32_t>& candidates,
                            Progress& progress) {
  std::vector<std::optional<Foot>> found(candidates.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, candidates.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        progress.check();
                        found[i] = tracker.find(candidates[i]);
                      }
                      progress.advance(range.size());
                    });
  std::vector<Foot> feet;
  for (const auto& foot : found)
    if (foot) feet.push_back(*foot);
  return feet;
}

double median_quality(const std::vector<Foot>& feet) {
  std::vector<double> qualities;
  qualities.reserve(feet.size());
  for (const Foot& foot : feet) qualities.push_back(foot.quality);
  return qualities.empty() ? 0 : median(qualities);
}

std::vector<Foot> better_than(double least, const std::vector<Foot>& feet) {
  std::vector<Foot> better;
  for (const Foot& foot : feet)
    if (foot.quality >= least) better.push_back(foot);
  return better;
}

/// Where a line bends, the surface beside it is broken: another crease may begin there that the detector has
/// not found, because it is blunter.
std::vector<std::uint32_t> points_beside_bends(const std::vector<Path>& paths, const PointCloud& cloud,
                                               const NeighborSearch& search, const TraceFrame& frame) {
  constexpr std::size_t step = 2;      // feet to each side
  constexpr double least_turn = 0.94;  // cosine of 20 degrees
  std::vector<std::uint32_t> points;
  for (const Path& path : paths) {
    if (path.feet.size() < 6) continue;
    for (std::size_t i = 0; i < path.feet.size(); ++i) {
      const bool at_end = !path.closed && (i == 0 || i + 1 == path.feet.size());
      const bool bends = i >= step && i + step < path.feet.size() &&
                         dot(path.feet[i - step].tangent, path.feet[i + step].tangent) < least_turn;
      if (!bends && !at_end) continue;
      const Foot& foot = path.feet[i];
      for (const std::uint32_t q : search.nearest_to(frame.global(foot.position), 41))
        if (distance(frame.local(cloud.positions[q]), foot.position) > 2 * foot.scale) points.push_back(q);
    }
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// The median of each coordinate: a stray that was labelled, however far out, costs the others no digits.
/// \pre !points.empty()
Point middle_of(const PointCloud& cloud, const std::vector<std::uint32_t>& points) {
  std::vector<double> values(points.size());
  Point middle{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < points.size(); ++i) values[i] = cloud.positions[points[i]][axis];
    middle[axis] = median(values);
  }
  return middle;
}

/// Points that no graph may hold are no candidates, whatever was said of them.
std::vector<std::uint32_t> points_of(std::initializer_list<Kind> kinds, const PointCloud& cloud,
                                     const FeatureLabels& labels) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (is_drawable(cloud.positions[i]) &&
        std::find(kinds.begin(), kinds.end(), labels.kind[i]) != kinds.end())
      points.push_back(i);
  return points;
}

std::vector<Path> trace_creases(const PointCloud& cloud, const NeighborSearch& search,
                                const FeatureLabels& labels, const std::vector<std::uint32_t>& candidates,
                                const TraceFrame& frame, Progress& progress) {
  if (candidates.empty()) return {};
  const WedgeView view = view_of(estimate_noise(cloud, search, progress));
  const WedgeTracker tracker(cloud, search, labels, frame, view);
  const std::vector<Foot> seeds = find_feet(tracker, candidates, progress);
  const double usual = median_quality(seeds);
  LineWalker walker(LineKind::Crease, view.unit);
  walker.walk(tracker, better_than(0.75 * usual, seeds), progress);
  const auto beside = points_beside_bends(walker.paths(), cloud, search, frame);
  progress.begin("tracing beside bends", 2 * beside.size());
  walker.walk(tracker, better_than(0.9 * usual, find_feet(tracker, beside, progress)), progress);
  return walker.paths();
}

std::vector<Path> trace_rims(const PointCloud& cloud, const NeighborSearch& search,
                             const FeatureLabels& labels, const TraceFrame& frame, Progress& progress) {
  const RimTracker tracker(cloud, search, labels, frame, progress);
  std::vector<std::uint32_t> all(tracker.size());
  std::iota(all.begin(), all.end(), 0U);
  LineWalker walker(LineKind::Border);
  walker.walk(tracker, find_feet(tracker, all, progress), progress);
  return walker.paths();
}

/// How far a point is from the straight pieces at a vertex.
double distance_to_pieces(const Point& p, const Polyline& line, std::size_t vertex) {
  const std::size_t count = line.vertices.size();
  double least = distance(p, line.vertices[vertex]);
  const auto include = [&](std::size_t other) {
    const Point along = difference(line.vertices[other], line.vertices[vertex]);
    const double squared = dot(along, along);
    if (!(squared > 0)) return;
    const double t = std::clamp(dot(difference(p, line.vertices[vertex]), along) / squared, 0.0, 1.0);
    least = std::min(least, distance(p, sum(line.vertices[vertex], scaled(t, along))));
  };
  if (vertex > 0 || line.closed) include(vertex > 0 ? vertex - 1 : count - 1);
  if (vertex + 1 < count || line.closed) include(vertex + 1 < count ? vertex + 1 : 0);
  return least;
}

/// Every candidate backs the nearest line of its kind, if that is near.
void count_support(FeatureGraph& graph, const PointCloud& cloud, const std::vector<std::uint32_t>& candidates,
                   LineKind kind, const TraceFrame& frame) {
  constexpr double nearby = 1.5;
  FootGrid vertices;
  for (std::size_t l = 0; l < graph.polylines.size(); ++l) {
    if (graph.polylines[l].kind != kind) continue;
    for (std::size_t v = 0; v < graph.polylines[l].vertices.size(); ++v) {
      Foot foot;
      foot.position = frame.local(graph.polylines[l].vertices[v]);
      vertices.insert({l, static_cast<std::ptrdiff_t>(v), foot});
    }
  }
  for (const std::uint32_t candidate : candidates) {
    const Point& p = cloud.positions[candidate];
    double least = nearby * frame.spacing;
    Polyline* nearest = nullptr;
    vertices.near(frame.local(p), 2 * nearby, [&](const FootGrid::Entry& entry) {
      Polyline& line = graph.polylines[entry.path];
      const double d = distance_to_pieces(p, line, static_cast<std::size_t>(entry.place));
      if (d < least) {
        least = d;
        nearest = &line;
      }
    });
    if (nearest != nullptr) ++nearest->support;
  }
}

}  // namespace

FeatureGraph trace_lines(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                         double spacing, const TraceOptions& options, Progress& progress) {
  if (labels.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} labels for {} points", labels.size(), cloud.size()));
  if (!(options.min_length >= 0))
    throw InvalidArgument(fmt::format("min_length: found {}, expected 0 or more", options.min_length));
  const std::vector<std::uint32_t> creases = points_of({Kind::Edge, Kind::Corner}, cloud, labels);
  const std::vector<std::uint32_t> borders = points_of({Kind::Border}, cloud, labels);
  const std::vector<std::uint32_t> peaks = points_of({Kind::Peak}, cloud, labels);
  const std::vector<std::uint32_t>& most_telling = !creases.empty()   ? creases
                                                   : !borders.empty() ? borders
                                                                      : peaks;
  if (!(spacing > 0) || most_telling.empty()) return {};
  const TraceFrame frame{middle_of(cloud, most_telling), spacing};
  progress.begin("tracing lines", 2 * (creases.size() + borders.size()));
  std::vector<Path> paths = trace_creases(cloud, search, labels, creases, frame, progress);
  const std::vector<Path> rims = trace_rims(cloud, search, labels, frame, progress);
  paths.insert(paths.end(), rims.begin(), rims.end());
  FeatureGraph graph = connect_paths(std::move(paths), frame, options.min_length, progress);
  count_support(graph, cloud, creases, LineKind::Crease, frame);
  count_support(graph, cloud, borders, LineKind::Border, frame);
  add_peaks(graph, cloud, search, labels, frame, progress);
  return graph;
}

}  // namespace keenline
