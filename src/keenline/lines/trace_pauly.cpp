#include "keenline/lines/trace_pauly.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/lines/pattern_lines.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

void validate(const TracePaulyOptions& options) {
  require_in_range("length_weight", options.length_weight, 0, 1);
  std::vector<Point> none;
  relax_snake(none, false, options.snake, {});
}

/// Scores of the points against the largest; all 1 for borders, which have none to tell them apart.
std::vector<double> strengths_of(const LinePoints& points, const FeatureLabels& labels, LineKind kind) {
  std::vector<double> strengths(points.points.size(), 1);
  if (kind == LineKind::Border || labels.score.size() != labels.size()) return strengths;
  double largest = 0;
  for (const std::uint32_t point : points.points)
    largest = std::max(largest, static_cast<double>(labels.score[point]));
  if (!(largest > 0)) return strengths;
  constexpr double least = 1e-3;  // what weighs nothing cannot be divided by
  for (std::size_t i = 0; i < strengths.size(); ++i)
    strengths[i] = std::max(least, static_cast<double>(labels.score[points.points[i]]) / largest);
  return strengths;
}

/// The field that snakes climb: the mean strength of the points around a place, weighted by a Gaussian.
class StrengthField {
 public:
  StrengthField(const LinePoints& points, std::vector<double> strengths)
      : positions_(points.positions), strengths_(std::move(strengths)), search_(positions_) {}

  /// Those that a vertex may come to feel: it moves by a spacing or two.
  [[nodiscard]] std::vector<std::uint32_t> around(const Point& place) const {
    constexpr int most = 96;
    std::vector<std::uint32_t> found = search_.nearest_to(place, most);
    std::erase_if(found, [&](std::uint32_t i) { return distance(place, positions_[i]) > 2 * reach; });
    return found;
  }

  [[nodiscard]] Point gradient(const Point& place, const std::vector<std::uint32_t>& around) const {
    double weights = 0;
    double total = 0;
    Point weights_slope{};
    Point total_slope{};
    for (const std::uint32_t i : around) {
      const Point way = difference(place, positions_[i]);
      const double squared = dot(way, way);
      if (squared > reach * reach) continue;
      const double weight = kernels::exp_of_negative(-squared / (width * width));
      const Point slope = scaled(-2 * weight / (width * width), way);
      weights += weight;
      total += weight * strengths_[i];
      weights_slope = sum(weights_slope, slope);
      total_slope = sum(total_slope, scaled(strengths_[i], slope));
    }
    if (!(weights > 0)) return {};
    const double per_square = 1 / (weights * weights);
    return scaled(per_square, difference(scaled(weights, total_slope), scaled(total, weights_slope)));
  }

 private:
  static constexpr double width = 1.5;        // spacings
  static constexpr double reach = 3 * width;  // a Gaussian is 1e-4 there

  const std::vector<Point>& positions_;
  std::vector<double> strengths_;
  NeighborSearch search_;
};

void relax(PatternLine& line, const StrengthField& field, const SnakeOptions& options) {
  // A loop at a corner hangs on it: an open snake whose two ends are one.
  const bool hangs = line.closed && line.start_corner;
  if (hangs) line.vertices.push_back(line.vertices.front());
  std::vector<std::vector<std::uint32_t>> around;
  for (const Point& vertex : line.vertices) around.push_back(field.around(vertex));
  relax_snake(line.vertices, line.closed && !hangs, options,
              [&](std::size_t vertex, const Point& place) { return field.gradient(place, around[vertex]); });
  if (hangs) line.vertices.pop_back();
}

}  // namespace

FeatureGraph trace_pauly(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                         double spacing, const TracePaulyOptions& options, Progress& progress) {
  validate(options);
  const std::size_t cycle = cycle_of(options.shortest_cycle, cloud);
  FeatureGraph graph;
  for (const LineKind kind : {LineKind::Crease, LineKind::Border}) {
    const LinePoints points = line_points(cloud, search, labels, spacing, kind, progress);
    std::vector<double> strengths = strengths_of(points, labels, kind);
    std::vector<WeightedEdge> edges = points.edges;
    for (WeightedEdge& edge : edges)
      edge.weight = 1 / (strengths[edge.a] * strengths[edge.b]) + options.length_weight * edge.weight;
    PatternLines lines = lines_of(clean_pattern(points, std::move(edges), cycle, progress), points);
    progress.begin("tracing lines", lines.lines.size());
    const StrengthField field(points, std::move(strengths));
    tbb::parallel_for(std::size_t{0}, lines.lines.size(), [&](std::size_t i) {
      progress.check();
      relax(lines.lines[i], field, options.snake);
      progress.advance(1);
    });
    add_lines(graph, lines, points.frame, kind);
  }
  return graph;
}

}  // namespace keenline
