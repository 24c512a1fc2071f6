#pragma once

#include <span>
#include <string_view>

#include "keenline/progress.h"

namespace keenline {

struct FeatureGraph;
struct FeatureLabels;
class NeighborSearch;
struct PointCloud;

/// One way from labelled points to lines. Every one takes the labels of every method.
struct LineTracer {
  std::string_view name;     ///< as on the command line: "walk"
  std::string_view summary;  ///< one line
  std::string_view paper;    ///< authors, year; or empty
  /// As trace_lines().
  FeatureGraph (*trace)(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                        double spacing, Progress& progress);
};

/// All of them. The first one is the default: it measures best (see docs/lines.md).
[[nodiscard]] std::span<const LineTracer> line_tracers();

/// \throw InvalidArgument naming those there are.
[[nodiscard]] const LineTracer& find_tracer(std::string_view name);

}  // namespace keenline
