#include "evaluate_lines.h"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"

#include "terminal.h"

namespace keenline::cli {
namespace {

struct Measure {
  std::string_view key;
  std::string_view words;
  double value;
};

std::array<Measure, 8> distances_of(const GraphComparison& c) {
  return {{{"found_to_truth_mean", "found to truth, mean", c.found_to_truth.mean},
           {"found_to_truth_max", "found to truth, largest", c.found_to_truth.largest},
           {"truth_to_found_mean", "truth to found, mean", c.truth_to_found.mean},
           {"truth_to_found_max", "truth to found, largest", c.truth_to_found.largest},
           {"chamfer", "Chamfer", c.chamfer()},
           {"hausdorff", "Hausdorff", c.hausdorff()},
           {"corner_mean", "true corner to found, mean", c.corners.mean},
           {"corner_max", "true corner to found, largest", c.corners.largest}}};
}

/// 0 of nothing is 0.
double in_units(double distance, double unit) { return distance == 0 ? 0 : distance / unit; }

nlohmann::json json_counts(const GraphCounts& counts) {
  return {{"length", counts.length},
          {"corners", counts.corners},
          {"polylines", counts.polylines},
          {"loops", counts.loops},
          {"loose_ends", counts.loose_ends}};
}

nlohmann::json json_comparison(const GraphComparison& c, std::optional<double> spacing) {
  nlohmann::json object{{"found", json_counts(c.found)},          {"truth", json_counts(c.truth)},
                        {"length_ratio", c.length_ratio},         {"missed_corners", c.missed_corners},
                        {"invented_corners", c.invented_corners}, {"diagonal", c.diagonal}};
  for (const Measure& measure : distances_of(c)) {
    nlohmann::json distance{{"distance", measure.value},
                            {"in_diagonals", in_units(measure.value, c.diagonal)}};
    if (spacing) distance["in_spacings"] = in_units(measure.value, *spacing);
    object[std::string(measure.key)] = std::move(distance);
  }
  return object;
}

std::string table_of(const std::string& name, const GraphComparison& c, std::optional<double> spacing) {
  std::string text = fmt::format("{}\n  {:<30} {:>12} {:>12}\n", escaped(name, 4096), "", "found", "truth");
  const auto row = [&](std::string_view words, auto found, auto truth) {
    text += fmt::format("  {:<30} {:>12.6g} {:>12.6g}\n", words, static_cast<double>(found),
                        static_cast<double>(truth));
  };
  row("length", c.found.length, c.truth.length);
  row("corners", c.found.corners, c.truth.corners);
  row("polylines", c.found.polylines, c.truth.polylines);
  row("loops", c.found.loops, c.truth.loops);
  row("loose ends", c.found.loose_ends, c.truth.loose_ends);
  text += fmt::format("  {:<30} {:>12} {:>12}\n", "corners invented, missed", c.invented_corners,
                      c.missed_corners);
  text +=
      fmt::format("  {:<30} {:>12} {:>12}{}\n", "", "distance", "/ diagonal", spacing ? "          / h" : "");
  for (const Measure& measure : distances_of(c)) {
    text += fmt::format("  {:<30} {:>12.6g} {:>12.6f}", measure.words, measure.value,
                        in_units(measure.value, c.diagonal));
    if (spacing) text += fmt::format(" {:>12.4f}", in_units(measure.value, *spacing));
    text += '\n';
  }
  return text;
}

}  // namespace

void evaluate_lines(const std::vector<std::string>& found, const std::string& truth,
                    const GraphComparisonOptions& options, bool json, bool quiet) {
  std::vector<GraphComparison> comparisons;
  {
    TerminalProgress progress(quiet);
    const FeatureGraph true_graph = read_graph(truth);
    for (const std::string& path : found)
      comparisons.push_back(compare_graphs(read_graph(path), true_graph, options, progress));
  }
  nlohmann::json files = nlohmann::json::array();
  std::string text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (json) {
      files.push_back(json_comparison(comparisons[i], options.spacing));
      files.back()["file"] = found[i];
    } else {
      text += table_of(found[i], comparisons[i], options.spacing);
    }
  }
  if (!json) return print(text);
  nlohmann::json object{{"truth", truth}, {"files", std::move(files)}};
  if (options.spacing) object["spacing"] = *options.spacing;
  print_json(std::move(object));
}

}  // namespace keenline::cli
