#include "label_counts.h"

#include <algorithm>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/text.h"

namespace keenline::cli {

std::map<std::string, std::size_t> counts_per_kind(const FeatureLabels& labels) {
  std::map<std::string, std::size_t> counts;
  for (const Kind kind : all_kinds) counts[std::string(name_of(kind))] = 0;
  for (const Kind kind : labels.kind) ++counts[std::string(name_of(kind))];
  return counts;
}

std::size_t count_features(const FeatureLabels& labels) {
  return static_cast<std::size_t>(std::count_if(labels.kind.begin(), labels.kind.end(), is_feature));
}

std::string label_lines(const FeatureLabels& labels, const std::vector<std::string>& outputs) {
  std::string text;
  const auto counts = counts_per_kind(labels);
  for (const Kind kind : all_kinds) {
    const std::size_t count = counts.at(std::string(name_of(kind)));
    if (count == 0) continue;
    text += fmt::format("  {:<10} {:>12}  {:5.1f} %\n", name_of(kind), grouped(count),
                        100.0 * static_cast<double>(count) / static_cast<double>(labels.size()));
  }
  text += fmt::format("{} sharp points; result in ", grouped(count_features(labels)));
  for (std::size_t i = 0; i < outputs.size(); ++i)
    text += fmt::format("{}{}", i > 0 ? ", " : "", escaped(outputs[i], 4096));
  text += '\n';
  return text;
}

}  // namespace keenline::cli
