#include "keenline/evaluate/evaluate.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/read.h"

#include "commands.h"
#include "evaluate_lines.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct EvaluateArguments {
  std::vector<std::string> predictions;
  std::string truth;
  std::string true_lines;
  double spacing = 0;  // used when the user gave it
  int threads = 0;
  bool kinds = false;
  bool json = false;
  bool quiet = false;
};

/// `comparison` is compare() or compare_kinds(). \throw InputError naming the prediction when it cannot be
/// compared: the fault is in the files, not in the call.
template <typename Comparison>
auto compare_file(const Comparison& comparison, const std::string& path,
                  const std::optional<PointCloud>& truth, Progress& progress) {
  const PointCloud prediction = read_cloud(path, progress).cloud;
  try {
    return comparison(prediction, truth ? *truth : prediction);
  } catch (const InvalidArgument& e) {
    throw InputError(path, e.what());
  }
}

nlohmann::json json_scores(const Scores& s) {
  return {{"precision", s.precision}, {"recall", s.recall}, {"f1", s.f1}, {"mcc", s.mcc}, {"iou", s.iou}};
}

void print_json_evaluation(const EvaluateArguments& arguments, const std::vector<Confusion>& confusions,
                           const Summary& summary) {
  nlohmann::json files = nlohmann::json::array();
  for (std::size_t i = 0; i < confusions.size(); ++i) {
    const Confusion& c = confusions[i];
    nlohmann::json file = json_scores(scores(c));
    file["file"] = arguments.predictions[i];
    file["true_positive"] = c.true_positive;
    file["false_positive"] = c.false_positive;
    file["false_negative"] = c.false_negative;
    file["true_negative"] = c.true_negative;
    files.push_back(file);
  }
  print_json({{"files", std::move(files)},
              {"macro_mean", json_scores(summary.macro_mean)},
              {"median", json_scores(summary.median)},
              {"micro", json_scores(summary.micro)}});
}

void print_evaluation(const EvaluateArguments& arguments, const std::vector<Confusion>& confusions,
                      const Summary& summary) {
  std::vector<std::string> names;
  for (const std::string& path : arguments.predictions) names.push_back(escaped(path, 4096));
  std::size_t width = std::string_view("macro mean").size();
  for (const std::string& name : names) width = std::max(width, name.size());
  std::string text = fmt::format("{:<{}} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "", width, "precision", "recall",
                                 "F1", "MCC", "IoU");
  const auto row = [&](const std::string& name, const Scores& s) {
    text += fmt::format("{:<{}} {:9.3f} {:9.3f} {:9.3f} {:9.3f} {:9.3f}\n", name, width, s.precision,
                        s.recall, s.f1, s.mcc, s.iou);
  };
  for (std::size_t i = 0; i < confusions.size(); ++i) row(names[i], scores(confusions[i]));
  row("macro mean", summary.macro_mean);
  row("median", summary.median);
  row("micro", summary.micro);
  print(text);
}

void print_json_kinds(const EvaluateArguments& arguments, const KindConfusion& confusion) {
  nlohmann::json matrix = nlohmann::json::object();
  for (std::size_t t = 0; t < all_kinds.size(); ++t)
    for (std::size_t f = 0; f < all_kinds.size(); ++f)
      matrix[std::string(name_of(all_kinds[t]))][std::string(name_of(all_kinds[f]))] = confusion.counts[t][f];
  print_json({{"files", arguments.predictions}, {"kinds", std::move(matrix)}});
}

void print_kinds(const KindConfusion& confusion) {
  std::string text = fmt::format("{:<16}", "truth \\ found");
  for (const Kind kind : all_kinds) text += fmt::format(" {:>9}", name_of(kind));
  text += '\n';
  for (std::size_t t = 0; t < all_kinds.size(); ++t) {
    text += fmt::format("{:<16}", name_of(all_kinds[t]));
    for (const std::uint64_t count : confusion.counts[t]) text += fmt::format(" {:>9}", count);
    text += '\n';
  }
  print(text);
}

void evaluate_kinds(const EvaluateArguments& arguments) {
  KindConfusion confusion;
  {
    TerminalProgress progress(arguments.quiet);
    std::optional<PointCloud> truth;
    if (!arguments.truth.empty()) truth = read_cloud(arguments.truth, progress).cloud;
    for (const std::string& path : arguments.predictions)
      confusion += compare_file(compare_kinds, path, truth, progress);
  }
  if (arguments.json) print_json_kinds(arguments, confusion);
  else print_kinds(confusion);
}

void evaluate(const CLI::App& command, const EvaluateArguments& arguments) {
  limit_threads(arguments.threads);
  if (!arguments.true_lines.empty()) {
    GraphComparisonOptions options;
    if (command.count("--spacing") > 0) options.spacing = arguments.spacing;
    evaluate_lines(arguments.predictions, arguments.true_lines, options, arguments.json, arguments.quiet);
    return;
  }
  if (arguments.kinds) {
    evaluate_kinds(arguments);
    return;
  }
  std::vector<Confusion> confusions;
  {
    TerminalProgress progress(arguments.quiet);
    std::optional<PointCloud> truth;
    if (!arguments.truth.empty()) truth = read_cloud(arguments.truth, progress).cloud;
    for (const std::string& path : arguments.predictions)
      confusions.push_back(compare_file(compare, path, truth, progress));
  }
  const Summary summary = summarize(confusions);
  if (arguments.json) print_json_evaluation(arguments, confusions, summary);
  else print_evaluation(arguments, confusions, summary);
}

}  // namespace

void add_evaluate(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("evaluate", "Measure labels or lines against the truth");
  const auto arguments = std::make_shared<EvaluateArguments>();
  command
      ->add_option(
          "PREDICTION", arguments->predictions,
          "Labelled clouds: attribute feature, and truth or truth_feature; with --lines: lines (.json)")
      ->required();
  CLI::Option* const truth =
      command->add_option("--truth", arguments->truth, "Take truth (or truth_feature) from this file instead")
          ->type_name("FILE");
  CLI::Option* const lines = command
                                 ->add_option("--lines", arguments->true_lines,
                                              "Compare lines with the true ones in this file (.json)")
                                 ->type_name("FILE")
                                 ->excludes(truth);
  command
      ->add_option("--spacing", arguments->spacing, "Point spacing h of the cloud: give distances in it too")
      ->type_name("H")
      ->needs(lines);
  command
      ->add_flag("--kinds", arguments->kinds,
                 "Count the points of each kind: attribute kind against truth_kind, of all files together")
      ->excludes(lines);
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "One JSON object on stdout instead of the table");
  command->add_flag("--quiet", arguments->quiet, "No progress");
  command->callback(
      [&action, command, arguments] { action = [command, arguments] { evaluate(*command, *arguments); }; });
}

}  // namespace keenline::cli
