#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/detect/registry.h"
#include "keenline/errors.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/text.h"
#include "keenline/lines/tracers.h"
#include "keenline/memory.h"
#include "keenline/pipeline.h"

#include "commands.h"
#include "method_options.h"
#include "terminal.h"
#include "view_options.h"

namespace keenline::cli {
namespace {

struct LinesArguments {
  LinesJob job;
  MethodArguments method;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

void print_json_report(const LinesArguments& arguments, const LinesReport& report) {
  const DetectReport& detection = report.detection;
  const StageTimes& times = detection.times;
  const GraphCounts counts = counts_of(report.graph);
  nlohmann::json object{{"input", arguments.job.input},
                        {"outputs", arguments.job.outputs},
                        {"format", detection.format},
                        {"encoding", detection.encoding},
                        {"points", detection.points},
                        {"finite_points", detection.finite_points},
                        {"spacing", detection.spacing},
                        {"method", nullptr},
                        {"trace", arguments.job.trace},
                        {"corners", counts.corners},
                        {"polylines", counts.polylines},
                        {"loops", counts.loops},
                        {"loose_ends", counts.loose_ends},
                        {"length", counts.length},
                        {"notes", detection.notes},
                        {"timings_s",
                         {{"read", times.read_s},
                          {"neighborhoods", times.neighborhoods_s},
                          {"smooth", times.smooth_s},
                          {"detect", times.detect_s},
                          {"lines", times.lines_s},
                          {"write", times.write_s},
                          {"total", times.total_s}}},
                        {"peak_memory_bytes", peak_memory()}};
  if (!report.method.empty()) {
    object["method"] = report.method;
    object["options"] = json_options(find_method(report.method), detection.options);
    object["noise"] = detection.noise;
    object["smoothed"] = detection.smoothed;
  }
  add_views(object, arguments.job.views);
  print_json(std::move(object));
}

void print_summary(const LinesArguments& arguments, const LinesReport& report) {
  const DetectReport& detection = report.detection;
  std::string text = fmt::format("{}: {} points ({}, {}), {:.2f} s\n", escaped(arguments.job.input, 4096),
                                 grouped(detection.points), detection.format, escaped(detection.encoding),
                                 detection.times.total_s);
  text += fmt::format("spacing {:.4g}", detection.spacing);
  if (report.method.empty()) {
    text += "; labels of the input\n";
  } else {
    text += fmt::format(", noise {:.2f} spacings{}\nmethod {}{}\n", detection.noise,
                        detection.smoothed ? ": smoothed before looking" : "", report.method,
                        option_words(find_method(report.method), detection.options));
  }
  const GraphCounts counts = counts_of(report.graph);
  text += fmt::format("{} corners, {} lines, {} of them closed, {} loose ends, length {:.6g}\n",
                      counts.corners, counts.polylines, counts.loops, counts.loose_ends, counts.length);
  for (const std::string& output : all_outputs(arguments.job.outputs, arguments.job.views))
    text += fmt::format("  {}\n", escaped(output, 4096));
  print(text);
}

void lines(const CLI::App& command, LinesArguments& arguments) {
  limit_threads(arguments.threads);
  const Method& method = arguments.job.method.empty() ? methods().front() : find_method(arguments.job.method);
  arguments.job.options = parsed_options(command, method, arguments.method);
  TerminalProgress progress(arguments.quiet);
  // Told before the drawings appear, as in detect.
  (void)run_lines(arguments.job, progress, [&](const LinesReport& report) {
    progress.clear();
    if (!arguments.quiet) print_notes(arguments.job.input, report.detection.notes);
    if (arguments.json) print_json_report(arguments, report);
    else if (!arguments.quiet) print_summary(arguments, report);
  });
}

}  // namespace

void add_lines(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("lines", "Draw the sharp features of a cloud: corners, and the lines between them");
  const auto arguments = std::make_shared<LinesArguments>();
  LinesJob& job = arguments->job;
  command
      ->add_option("INPUT", job.input,
                   "Point cloud or mesh, as for detect; one that detect labelled is not looked at again")
      ->required();
  command
      ->add_option("-o,--output", job.outputs,
                   fmt::format("Drawing: {}; repeat it for several", graph_extensions()))
      ->type_name("OUT")
      ->allow_extra_args(false);
  command->add_option("--method", job.method, "Label the points by this method: one of keenline methods")
      ->type_name("NAME");
  add_method_options(*command, methods(), arguments->method, "spectrum");
  add_smoothing_option(*command, job.smoothing);
  add_view_options(*command, job.views);
  std::string tracers = "How lines are drawn from the labels:";
  for (const LineTracer& tracer : line_tracers())
    tracers += fmt::format("{} {}", &tracer == &line_tracers().front() ? "" : ",", tracer.name);
  command->add_option("--trace", job.trace, tracers)
      ->capture_default_str()
      ->type_name("NAME")
      ->group("Lines");
  command
      ->add_flag("--snap,!--no-snap", job.snap,
                 "Move lines and corners onto the intersection of the surfaces that meet there (default on)")
      ->group("Lines");
  command
      ->add_flag("--smooth-lines,!--no-smooth-lines", job.smooth_lines,
                 "Smooth lines that are not snapped (default on)")
      ->group("Lines");
  command
      ->add_option("--resample", job.resample_spacings,
                   "Distance of the vertices along a line, in point spacings (default: as they are found)")
      ->type_name("F")
      ->group("Lines");
  command
      ->add_option(
          "--fit", job.fit_spacings,
          "Replace lines by straight lines, arcs, circles and cubic B-splines that miss no vertex by "
          "more, in point spacings (default: no curves)")
      ->type_name("F")
      ->group("Lines");
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "One JSON object on stdout instead of the summary");
  command->add_flag("--quiet", arguments->quiet, "No summary, no notes, no progress");
  command->callback(
      [&action, command, arguments] { action = [command, arguments] { lines(*command, *arguments); }; });
}

}  // namespace keenline::cli
