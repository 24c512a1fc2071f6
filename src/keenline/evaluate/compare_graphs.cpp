#include "keenline/evaluate/compare_graphs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/evaluate/segment_tree.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double samples_per_spacing = 10;
constexpr double spacings_per_diagonal = 200;  // where no spacing is given
constexpr double most_samples = 1e6;

double diagonal_of(const FeatureGraph& graph) {
  const Extent extent = extent_of(graph);
  return extent.is_empty() ? 0 : distance(extent.low, extent.high);
}

/// Points of all lines. The first lie in the middle of equal steps and stand for a piece of the
/// line; the others are the vertices, where distances are often largest.
struct LineSamples {
  std::vector<Point> points;
  std::vector<double> weights;  // of the first: how long a piece
};

void add_even_samples(const Polyline& line, double step, LineSamples& samples) {
  const double length = length_of(line);
  if (!(length > 0)) return;
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(length / step)));
  const double part = length / static_cast<double>(count);
  double walked = 0;     // up to the start of the segment at hand
  std::size_t next = 0;  // number of the next sample
  for (std::size_t i = 0; i < segment_count(line); ++i) {
    const Point& a = line.vertices[i];
    const Point& b = segment_end(line, i);
    const double piece = distance(a, b);
    const bool is_last = i + 1 == segment_count(line);
    for (; next < count; ++next) {
      const double along = (static_cast<double>(next) + 0.5) * part - walked;
      if (along > piece && !is_last) break;
      const double t = piece > 0 ? std::clamp(along / piece, 0.0, 1.0) : 0;
      Point p{};
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] = a[axis] + t * (b[axis] - a[axis]);
      samples.points.push_back(p);
      samples.weights.push_back(part);
    }
    walked += piece;
  }
}

LineSamples samples_of(const FeatureGraph& graph, double step) {
  LineSamples samples;
  for (const Polyline& line : graph.polylines) add_even_samples(line, step, samples);
  for (const Polyline& line : graph.polylines)
    samples.points.insert(samples.points.end(), line.vertices.begin(), line.vertices.end());
  return samples;
}

SegmentTree tree_of(const FeatureGraph& graph) {
  std::vector<Segment> segments;
  for (const Polyline& line : graph.polylines)
    for (std::size_t i = 0; i < segment_count(line); ++i)
      segments.push_back({line.vertices[i], segment_end(line, i)});
  return SegmentTree(std::move(segments));
}

Deviation deviation(const FeatureGraph& from, const FeatureGraph& to, double step, Progress& progress) {
  const LineSamples samples = samples_of(from, step);
  if (samples.points.empty()) return {};
  const SegmentTree tree = tree_of(to);
  std::vector<double> distances(samples.points.size());
  progress.begin("measuring", distances.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, distances.size(), 1024), [&](const auto& range) {
    progress.check();
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      distances[i] = tree.distance_to_nearest(samples.points[i]);
    progress.advance(range.size());
  });
  Deviation result;
  result.largest = *std::max_element(distances.begin(), distances.end());
  const double length = std::accumulate(samples.weights.begin(), samples.weights.end(), 0.0);
  // One after the other, so that the number of threads does not show in the sum.
  for (std::size_t i = 0; i < samples.weights.size(); ++i)
    result.mean += samples.weights[i] / length * distances[i];
  if (samples.weights.empty()) result.mean = result.largest;  // lines without length
  return result;
}

/// From each corner of one to the nearest of the other.
std::vector<double> corner_distances(const FeatureGraph& from, const FeatureGraph& to) {
  std::vector<Segment> points;
  for (const GraphCorner& corner : to.corners) points.push_back({corner.position, corner.position});
  const SegmentTree tree(std::move(points));
  std::vector<double> distances;
  for (const GraphCorner& corner : from.corners)
    distances.push_back(tree.distance_to_nearest(corner.position));
  return distances;
}

std::size_t count_beyond(const std::vector<double>& distances, double tolerance) {
  const auto is_beyond = [&](double distance) { return distance > tolerance; };
  return static_cast<std::size_t>(std::count_if(distances.begin(), distances.end(), is_beyond));
}

void compare_corners(const FeatureGraph& found, const FeatureGraph& truth, double tolerance,
                     GraphComparison& result) {
  const std::vector<double> distances = corner_distances(truth, found);
  if (!distances.empty()) {
    const double sum = std::accumulate(distances.begin(), distances.end(), 0.0);
    result.corners = {sum / static_cast<double>(distances.size()),
                      *std::max_element(distances.begin(), distances.end())};
  }
  result.missed_corners = count_beyond(distances, tolerance);
  result.invented_corners = count_beyond(corner_distances(found, truth), tolerance);
}

}  // namespace

double GraphComparison::hausdorff() const { return std::max(found_to_truth.largest, truth_to_found.largest); }

GraphComparison compare_graphs(const FeatureGraph& found, const FeatureGraph& truth,
                               const GraphComparisonOptions& options, Progress& progress) {
  validate(found);
  validate(truth);
  if (options.spacing && !(*options.spacing > 0 && std::isfinite(*options.spacing)))
    throw InvalidArgument(fmt::format("spacing must be a number above 0, not {}", *options.spacing));

  GraphComparison result;
  result.found = counts_of(found);
  result.truth = counts_of(truth);
  if (result.truth.length > 0) result.length_ratio = result.found.length / result.truth.length;
  else if (result.found.length > 0) result.length_ratio = std::numeric_limits<double>::infinity();
  const bool has_truth = !truth.polylines.empty() || !truth.corners.empty();
  result.diagonal = diagonal_of(has_truth ? truth : found);

  const double spacing = options.spacing.value_or(result.diagonal / spacings_per_diagonal);
  const auto step_of = [&](double length) {
    return std::max(spacing / samples_per_spacing, length / most_samples);
  };
  result.found_to_truth = deviation(found, truth, step_of(result.found.length), progress);
  result.truth_to_found = deviation(truth, found, step_of(result.truth.length), progress);
  compare_corners(found, truth, spacing, result);
  return result;
}

}  // namespace keenline
