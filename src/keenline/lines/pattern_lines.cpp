#include "keenline/lines/pattern_lines.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/neighborhood/disjoint_sets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// About two spacings to each side: detectors find four of five points of a line, and tell no more than one
/// point at a place from those beside it.
constexpr int points_beside = 16;
constexpr int graph_neighbors = 12;
constexpr double longest_edge = 3;       // spacings
constexpr double one_corner_within = 3;  // spacings
constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

bool may_be_on(LineKind kind, Kind label) {
  return kind == LineKind::Border ? label == Kind::Border : label == Kind::Edge || label == Kind::Corner;
}

std::vector<bool> members_of(const PointCloud& cloud, const NeighborSearch& search,
                             const FeatureLabels& labels, LineKind kind, const Progress& progress) {
  std::vector<bool> is_member(cloud.size());
  for (std::uint32_t i = 0; i < cloud.size(); ++i) {
    if (!may_be_on(kind, labels.kind[i])) continue;
    progress.check();
    is_member[i] = true;
    for (const std::uint32_t j : search.nearest(i, points_beside)) is_member[j] = true;
  }
  return is_member;
}

std::vector<WeightedEdge> edges_between(const std::vector<Point>& positions, const Progress& progress) {
  const NeighborSearch search(positions, progress);
  std::vector<std::vector<WeightedEdge>> found(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(positions.size()), 256),
                    [&](const tbb::blocked_range<std::uint32_t>& range) {
                      progress.check();
                      for (std::uint32_t i = range.begin(); i < range.end(); ++i) {
                        for (const std::uint32_t j : search.nearest(i, graph_neighbors)) {
                          const double length = distance(positions[i], positions[j]);
                          if (length <= longest_edge)
                            found[i].push_back({std::min(i, j), std::max(i, j), length});
                        }
                      }
                    });
  std::vector<WeightedEdge> edges;
  for (const auto& part : found) edges.insert(edges.end(), part.begin(), part.end());
  const auto ends = [](const WeightedEdge& edge) { return std::pair(edge.a, edge.b); };
  std::sort(edges.begin(), edges.end(), [&](const auto& x, const auto& y) { return ends(x) < ends(y); });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [&](const auto& x, const auto& y) { return ends(x) == ends(y); }),
              edges.end());
  return edges;
}

/// Which junctions are one corner.
class Corners {
 public:
  Corners(const NodeGraph& pattern, const std::vector<NodeChain>& chains, const std::vector<Point>& positions)
      : same_(pattern.size()), number_(pattern.size(), none) {
    for (const NodeChain& chain : chains) {
      const std::uint32_t a = chain.nodes.front();
      const std::uint32_t b = chain.nodes.back();
      if (chain.is_loop || pattern.degree_of(a) < 3 || pattern.degree_of(b) < 3) continue;
      double length = 0;
      for (std::size_t i = 1; i < chain.nodes.size(); ++i)
        length += distance(positions[chain.nodes[i - 1]], positions[chain.nodes[i]]);
      if (length < one_corner_within) same_.join(a, b);
    }
    std::vector<double> members;
    for (std::uint32_t node = 0; node < pattern.size(); ++node) {
      if (pattern.degree_of(node) < 3) continue;
      const std::uint32_t first = same_.find(node);
      if (first == node) {
        number_[node] = static_cast<std::uint32_t>(middles_.size());
        middles_.push_back({});
        members.push_back(0);
      }
      number_[node] = number_[first];
      middles_[number_[node]] = sum(middles_[number_[node]], positions[node]);
      members[number_[node]] += 1;
    }
    for (std::size_t i = 0; i < members.size(); ++i) middles_[i] = scaled(1 / members[i], middles_[i]);
  }

  [[nodiscard]] const std::vector<Point>& middles() const { return middles_; }
  [[nodiscard]] std::optional<std::uint32_t> at(std::uint32_t node) const {
    return number_[node] == none ? std::nullopt : std::optional(number_[node]);
  }

 private:
  DisjointSets same_;
  std::vector<std::uint32_t> number_;  // of the corner that a junction belongs to
  std::vector<Point> middles_;
};

/// Nothing is left of a chain inside a corner.
std::optional<PatternLine> line_of(const NodeChain& chain, const Corners& corners,
                                   const std::vector<Point>& positions) {
  PatternLine line;
  line.start_corner = corners.at(chain.nodes.front());
  line.end_corner = chain.is_loop ? line.start_corner : corners.at(chain.nodes.back());
  line.closed = chain.is_loop || (line.start_corner && line.start_corner == line.end_corner);
  for (const std::uint32_t node : chain.nodes) line.vertices.push_back(positions[node]);
  if (line.start_corner) line.vertices.front() = corners.middles()[*line.start_corner];
  if (line.closed && !chain.is_loop) line.vertices.pop_back();
  else if (line.end_corner && !line.closed) line.vertices.back() = corners.middles()[*line.end_corner];
  if (line.vertices.size() < (line.closed ? 3U : 2U)) return std::nullopt;
  return line;
}

/// A point that is no node has the nearest node it is connected with.
void count_support(PatternLines& lines, const std::vector<std::uint32_t>& line_at, const LinePoints& points) {
  std::vector<std::uint32_t> nearest = line_at;
  std::vector<double> length(points.points.size(), std::numeric_limits<double>::infinity());
  const auto offer = [&](std::uint32_t to, std::uint32_t node, double distance) {
    if (line_at[to] != none || line_at[node] == none || distance >= length[to]) return;
    length[to] = distance;
    nearest[to] = line_at[node];
  };
  for (const WeightedEdge& edge : points.edges) {
    offer(edge.a, edge.b, edge.weight);
    offer(edge.b, edge.a, edge.weight);
  }
  for (std::size_t i = 0; i < nearest.size(); ++i)
    if (nearest[i] != none) lines.lines[nearest[i]].support += points.copies[i];
}

}  // namespace

LinePoints line_points(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                       double spacing, LineKind kind, const Progress& progress) {
  if (labels.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} labels for {} points", labels.size(), cloud.size()));
  const std::vector<bool> is_member = members_of(cloud, search, labels, kind, progress);
  LinePoints result{place_points(cloud, search, is_member, spacing), {}};
  result.edges = edges_between(result.positions, progress);
  return result;
}

std::size_t cycle_of(std::optional<int> given, const PointCloud& cloud) {
  if (!given) return shortest_cycle_for(count_finite(cloud), 5);
  require_cycle(*given);
  return static_cast<std::size_t>(*given);
}

NodeGraph clean_pattern(const LinePoints& points, std::vector<WeightedEdge> edges, std::size_t cycle,
                        const Progress& progress) {
  NodeGraph pattern = spanning_pattern(points.points.size(), std::move(edges), cycle, progress);
  pattern.drop_small_parts(cycle);
  const std::size_t branch = (cycle + 1) / 2;
  pattern.prune_short_branches(branch);
  pattern.drop_small_parts(branch + 1);  // a blob of points has been but branches
  return pattern;
}

PatternLines lines_of(const NodeGraph& pattern, const LinePoints& points) {
  const std::vector<NodeChain> chains = pattern.chains();
  const Corners corners(pattern, chains, points.positions);
  PatternLines result{corners.middles(), {}};
  std::vector<std::uint32_t> line_at(points.points.size(), none);
  for (const NodeChain& chain : chains) {
    const auto line = line_of(chain, corners, points.positions);
    if (!line) continue;
    for (const std::uint32_t node : chain.nodes)
      if (line_at[node] == none) line_at[node] = static_cast<std::uint32_t>(result.lines.size());
    result.lines.push_back(*line);
  }
  count_support(result, line_at, points);
  return result;
}

void add_lines(FeatureGraph& graph, const PatternLines& lines, const TraceFrame& frame, LineKind kind) {
  const auto first_corner = static_cast<std::uint32_t>(graph.corners.size());
  for (const Point& corner : lines.corners) graph.corners.push_back({frame.global(corner), std::nullopt});
  for (const PatternLine& line : lines.lines) {
    Polyline& added = graph.polylines.emplace_back();
    for (const Point& vertex : line.vertices) added.vertices.push_back(frame.global(vertex));
    added.closed = line.closed;
    added.kind = kind;
    if (line.start_corner) added.start_corner = first_corner + *line.start_corner;
    if (line.end_corner) added.end_corner = first_corner + *line.end_corner;
    added.support = line.support;
  }
}

}  // namespace keenline
