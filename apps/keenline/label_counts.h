#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "keenline/labels.h"

namespace keenline::cli {

/// Points of every kind, by its name; 0 where there are none.
[[nodiscard]] std::map<std::string, std::size_t> counts_per_kind(const FeatureLabels& labels);

/// Edges, corners and peaks.
[[nodiscard]] std::size_t count_features(const FeatureLabels& labels);

/// Lines of a summary: a kind that there is, its points, its share; then how many are sharp, and in which
/// files all that is.
[[nodiscard]] std::string label_lines(const FeatureLabels& labels, const std::vector<std::string>& outputs);

}  // namespace keenline::cli
