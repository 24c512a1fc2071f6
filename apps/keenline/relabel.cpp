#include <algorithm>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/detect/registry.h"
#include "keenline/errors.h"
#include "keenline/io/text.h"
#include "keenline/memory.h"
#include "keenline/pipeline.h"

#include "commands.h"
#include "label_counts.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct RelabelArguments {
  RelabelJob job;
  std::string sigma;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

/// The option of the method that a spectrum answers for.
const OptionInfo& sigma_option() {
  const auto options = find_method("gauss").options;
  return *std::find_if(options.begin(), options.end(), [](const OptionInfo& o) { return o.name == "sigma"; });
}

nlohmann::json json_sigma(const FeatureLabels& labels) {
  if (labels.sigma_deg > 0) return labels.sigma_deg;
  return text_of(sigma_option(), labels.sigma_deg);
}

void print_json_report(const RelabelArguments& arguments, const RelabelReport& report) {
  const RelabelTimes& times = report.times;
  print_json({{"input", arguments.job.input},
              {"output", arguments.job.output},
              {"format", report.format},
              {"encoding", report.encoding},
              {"points", report.points},
              {"finite_points", report.finite_points},
              {"sigma", json_sigma(report.labels)},
              {"counts", counts_per_kind(report.labels)},
              {"feature_points", count_features(report.labels)},
              {"notes", report.notes},
              {"timings_s",
               {{"read", times.read_s},
                {"relabel", times.relabel_s},
                {"write", times.write_s},
                {"total", times.total_s}}},
              {"peak_memory_bytes", peak_memory()}});
}

void print_summary(const RelabelArguments& arguments, const RelabelReport& report) {
  print(fmt::format("{}: {} points ({}, {}), {:.2f} s\nsigma {}\n{}", escaped(arguments.job.input, 4096),
                    grouped(report.points), report.format, escaped(report.encoding), report.times.total_s,
                    text_of(sigma_option(), report.labels.sigma_deg),
                    label_lines(report.labels, {arguments.job.output})));
}

void relabel(RelabelArguments& arguments) {
  limit_threads(arguments.threads);
  const std::optional<double> sigma_deg = parse_option(sigma_option(), arguments.sigma);
  arguments.job.sigma_deg = sigma_deg.value_or(0);
  if (sigma_deg) arguments.job.sigma_rule = *sigma_deg > 0 ? SigmaRule::Given : SigmaRule::Local;
  TerminalProgress progress(arguments.quiet);
  // Told before the result appears, as in detect.
  (void)run_relabel(arguments.job, progress, [&](const RelabelReport& report) {
    progress.clear();
    if (!arguments.quiet) print_notes(arguments.job.input, report.notes);
    if (arguments.json) print_json_report(arguments, report);
    else if (!arguments.quiet) print_summary(arguments, report);
  });
}

}  // namespace

void add_relabel(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("relabel", "Label a cloud anew for another sigma, at once and exactly");
  const auto arguments = std::make_shared<RelabelArguments>();
  command->add_option("INPUT", arguments->job.input, "What keenline detect --spectrum wrote")->required();
  command->add_option("-o,--output", arguments->job.output, "Result: .ply (binary) or .csv")
      ->required()
      ->type_name("OUT");
  command->add_option("--sigma", arguments->sigma, fmt::format("Sensitivity ({})", range_of(sigma_option())))
      ->required()
      ->type_name("");
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "One JSON object on stdout instead of the summary");
  command->add_flag("--quiet", arguments->quiet, "No summary, no notes, no progress");
  command->callback([&action, arguments] { action = [arguments] { relabel(*arguments); }; });
}

}  // namespace keenline::cli
