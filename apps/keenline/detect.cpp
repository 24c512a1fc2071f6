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
#include "method_options.h"
#include "terminal.h"
#include "view_options.h"

namespace keenline::cli {
namespace {

struct DetectArguments {
  DetectJob job;
  MethodArguments method;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

void print_json_report(const DetectArguments& arguments, const DetectReport& report) {
  const StageTimes& times = report.times;
  nlohmann::json object{{"input", arguments.job.input},
                        {"output", nullptr},
                        {"format", report.format},
                        {"encoding", report.encoding},
                        {"points", report.points},
                        {"finite_points", report.finite_points},
                        {"spacing", report.spacing},
                        {"noise", report.noise},
                        {"smoothed", report.smoothed},
                        {"method", arguments.job.method},
                        {"options", json_options(find_method(arguments.job.method), report.options)},
                        {"counts", counts_per_kind(report.labels)},
                        {"feature_points", count_features(report.labels)},
                        {"notes", report.notes},
                        {"timings_s",
                         {{"read", times.read_s},
                          {"neighborhoods", times.neighborhoods_s},
                          {"smooth", times.smooth_s},
                          {"detect", times.detect_s},
                          {"write", times.write_s},
                          {"total", times.total_s}}},
                        {"peak_memory_bytes", peak_memory()}};
  if (!arguments.job.output.empty()) object["output"] = arguments.job.output;
  add_views(object, arguments.job.views);
  print_json(std::move(object));
}

void print_summary(const DetectArguments& arguments, const DetectReport& report) {
  const Method& method = find_method(arguments.job.method);
  std::string text =
      fmt::format("{}: {} points ({}, {}), {:.2f} s\n", escaped(arguments.job.input, 4096),
                  grouped(report.points), report.format, escaped(report.encoding), report.times.total_s);
  text += fmt::format("spacing {:.4g}, noise {:.2f} spacings{}\n", report.spacing, report.noise,
                      report.smoothed ? ": smoothed before looking" : "");
  text += fmt::format("method {}{}\n", method.name, option_words(method, report.options));
  text += label_lines(report.labels, all_outputs({arguments.job.output}, arguments.job.views));
  print(text);
}

void detect(const CLI::App& command, DetectArguments& arguments) {
  limit_threads(arguments.threads);
  arguments.job.options = parsed_options(command, find_method(arguments.job.method), arguments.method);
  TerminalProgress progress(arguments.quiet);
  // Told before the result appears: when nobody can be told, that is a failure, and then nothing is left.
  (void)run_detect(arguments.job, progress, [&](const DetectReport& report) {
    progress.clear();
    if (!arguments.quiet) print_notes(arguments.job.input, report.notes);
    if (arguments.json) print_json_report(arguments, report);
    else if (!arguments.quiet) print_summary(arguments, report);
  });
}

}  // namespace

void add_detect(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("detect", "Label the points of a cloud that lie on sharp edges and corners");
  const auto arguments = std::make_shared<DetectArguments>();
  command
      ->add_option("INPUT", arguments->job.input,
                   "Point cloud or mesh: PLY, PCD, LAS, OFF, OBJ, STL, XYZ, TXT, CSV")
      ->required();
  command->add_option("-o,--output", arguments->job.output, "Result: .ply (binary) or .csv")
      ->type_name("OUT");
  command->add_option("--method", arguments->job.method, "One of: keenline methods")
      ->capture_default_str()
      ->type_name("NAME");
  add_method_options(*command, methods(), arguments->method);
  add_smoothing_option(*command, arguments->job.smoothing);
  add_view_options(*command, arguments->job.views);
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "One JSON object on stdout instead of the summary");
  command->add_flag("--quiet", arguments->quiet, "No summary, no notes, no progress");
  command->callback(
      [&action, command, arguments] { action = [command, arguments] { detect(*command, *arguments); }; });
}

}  // namespace keenline::cli
