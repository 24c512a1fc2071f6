#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/lines/placed_points.h"
#include "keenline/neighborhood/spanning_pattern.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;

/// The points that lines of a kind may run through, and the graph that a pattern of them is taken from.
struct LinePoints : PlacedPoints {
  /// Each with its 12 nearest others up to 3 spacings away, by places in `points`; every edge once. The
  /// weight is the length in spacings.
  std::vector<WeightedEdge> edges;
};

/// Edges and corners for creases, borders for borders, each with its 16 nearest points of the cloud,
/// which bridge the gaps of thin labels; see place_points(). Threads: any number, same result.
/// \throw InvalidArgument unless labels.size() == cloud.size(); OutOfMemory; Cancelled.
[[nodiscard]] LinePoints line_points(const PointCloud& cloud, const NeighborSearch& search,
                                     const FeatureLabels& labels, double spacing, LineKind kind,
                                     const Progress& progress);

/// `given`, or half the square root of the number of finite points, at least 5.
/// \throw InvalidArgument unless `given` is 1 or more
[[nodiscard]] std::size_t cycle_of(std::optional<int> given, const PointCloud& cloud);

/// The pattern of the points by these weights, one for every edge, cleaned as the papers have it: components
/// with fewer nodes than `cycle` edges dropped, branches with less than half as many edges cut.
[[nodiscard]] NodeGraph clean_pattern(const LinePoints& points, std::vector<WeightedEdge> edges,
                                      std::size_t cycle, const Progress& progress);

/// A line of a pattern, in the frame of its points; the members are those of Polyline.
struct PatternLine {
  std::vector<Point> vertices{};
  bool closed = false;
  std::optional<std::uint32_t> start_corner{};
  std::optional<std::uint32_t> end_corner{};
  std::uint64_t support = 0;
};

struct PatternLines {
  std::vector<Point> corners;
  std::vector<PatternLine> lines;
};

/// The pattern cut at its junctions. Junctions that a chain of less than 3 spacings connects are one corner,
/// in their middle. A line is supported by the points on it and by those that have their nearest node on it.
[[nodiscard]] PatternLines lines_of(const NodeGraph& pattern, const LinePoints& points);

/// Adds them to a graph, in the cloud's own coordinates.
void add_lines(FeatureGraph& graph, const PatternLines& lines, const TraceFrame& frame, LineKind kind);

}  // namespace keenline
