#include "keenline/lines/trace_gumhold.h"

#include <cstdint>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/detect/pattern_penalties.h"
#include "keenline/lines/pattern_lines.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

/// Of the points, with distances in spacings.
std::vector<PointPenalties> penalties_of(const LinePoints& points, const PointCloud& cloud,
                                         const NeighborSearch& search, int neighbors, Progress& progress) {
  std::vector<PointPenalties> penalties(points.points.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, penalties.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      LocalOffsets local;
                      std::vector<double> angles;
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const std::uint32_t point = points.points[i];
                        penalties[i] = point_penalties(cloud.positions, point,
                                                       search.nearest(point, neighbors), local, angles);
                        penalties[i].distance /= points.frame.spacing;
                      }
                      progress.advance(range.size());
                    });
  return penalties;
}

}  // namespace

FeatureGraph trace_gumhold(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                           double spacing, const TraceGumholdOptions& options, Progress& progress) {
  require_neighbor_count(options.neighbors);
  const std::size_t cycle = cycle_of(options.shortest_cycle, cloud);
  const PenaltyRule rule;
  FeatureGraph graph;
  for (const LineKind kind : {LineKind::Crease, LineKind::Border}) {
    const LinePoints points = line_points(cloud, search, labels, spacing, kind, progress);
    progress.begin("tracing lines", points.points.size());
    const auto penalties = penalties_of(points, cloud, search, options.neighbors, progress);
    std::vector<WeightedEdge> edges = points.edges;
    LocalOffsets local;
    for (WeightedEdge& edge : edges) {
      const Way way = way_between(points.positions, penalties, edge.a, edge.b, local);
      const auto penalty = kind == LineKind::Border ? edge_border_penalty : edge_crease_penalty;
      edge.weight = penalty(penalties[edge.a], penalties[edge.b], way.direction, rule) + way.relative_length;
    }
    const NodeGraph pattern = clean_pattern(points, std::move(edges), cycle, progress);
    add_lines(graph, lines_of(pattern, points), points.frame, kind);
  }
  return graph;
}

}  // namespace keenline
