#include "keenline/synth/synth.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/output_file.h"
#include "keenline/io/text.h"
#include "keenline/io/write.h"
#include "keenline/synth/true_lines.h"

#include "commands.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct SynthArguments {
  SynthOptions options;
  std::string output;
  std::vector<std::string> lines;
  std::string sampling = "random";
  std::string noise = "0h";
  double angle_deg = 0;  // used when the user gave it
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

struct SamplingName {
  std::string_view name;
  Sampling sampling;
};
constexpr std::array sampling_names{
    SamplingName{"random", Sampling::Random}, SamplingName{"grid", Sampling::Grid},
    SamplingName{"mesh", Sampling::Mesh}, SamplingName{"scan", Sampling::Scan}};

Sampling parse_sampling(std::string_view text) {
  for (const SamplingName& entry : sampling_names)
    if (entry.name == text) return entry.sampling;
  throw InvalidArgument(
      fmt::format("--sampling: found {}, expected random, grid, mesh or scan", quoted(text)));
}

/// "0.05", "0.05h" (of the point spacing), "0.05bbox" (of the bounding box's diagonal).
Noise parse_noise(std::string_view text) {
  Noise noise;
  std::string_view number = text;
  if (number.ends_with("bbox")) {
    noise.unit = Noise::Unit::BoundingBoxDiagonal;
    number.remove_suffix(4);
  } else if (number.ends_with("h")) {
    number.remove_suffix(1);
  }
  if (parse_number(number, noise.amount) != Parsed::Ok || !(noise.amount >= 0) || noise.amount > 1e6)
    throw InvalidArgument(
        fmt::format("--noise: found {}, expected a number >= 0 with unit h (point spacings) or bbox "
                    "(bounding-box diagonals)",
                    quoted(text)));
  return noise;
}

void print_result(const SynthArguments& arguments, const SynthCloud& result) {
  const SynthOptions& options = arguments.options;
  if (arguments.json) {
    print_json({{"shape", options.shape},
                {"output", arguments.output},
                {"lines", arguments.lines},
                {"points", result.cloud.size()},
                {"spacing", result.spacing},
                {"sampling", arguments.sampling},
                {"noise", arguments.noise},
                {"seed", options.seed},
                {"curves", result.curves.size()},
                {"corners", result.corners.size()},
                {"peaks", result.peaks.size()}});
  } else if (!arguments.quiet) {
    print(fmt::format("{}: {} points, spacing {:.6g}, {} true lines, {} corners, {} peaks; in {}\n",
                      options.shape, grouped(result.cloud.size()), result.spacing, result.curves.size(),
                      result.corners.size(), result.peaks.size(), escaped(arguments.output, 4096)));
  }
}

void synth(const CLI::App& command, SynthArguments& arguments) {
  limit_threads(arguments.threads);
  require_writable_extension(arguments.output);
  std::vector<std::string> outputs = arguments.lines;
  for (const std::string& path : outputs) (void)find_graph_format(path);
  outputs.push_back(arguments.output);
  require_distinct_outputs(outputs);
  SynthOptions& options = arguments.options;
  options.sampling = parse_sampling(arguments.sampling);
  options.noise = parse_noise(arguments.noise);
  if (command.count("--angle") > 0) options.angle_deg = arguments.angle_deg;

  TerminalProgress progress(arguments.quiet);
  const SynthCloud result = synthesize(options, progress);
  // The cloud is renamed last: it appears when all is there.
  write_cloud(arguments.output, result.cloud, progress, [&](const std::vector<std::string>& notes) {
    write_graph(arguments.lines, true_lines(result), progress, [&] {
      progress.clear();
      if (!arguments.quiet) print_notes(arguments.output, notes);
      print_result(arguments, result);
    });
  });
}

std::string shape_list() {
  std::string text = "Shapes:\n";
  for (const SynthShape& shape : synth_shapes())
    text += fmt::format("  {:<14} {}\n", shape.name, shape.summary);
  return text;
}

}  // namespace

void add_synth(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("synth", "Make a point cloud of a shape whose sharp features are known exactly");
  const auto arguments = std::make_shared<SynthArguments>();
  command->add_option("SHAPE", arguments->options.shape, "One of the shapes below")->required();
  command->add_option("-o,--output", arguments->output, "Result: .ply (binary) or .csv")
      ->required()
      ->type_name("OUT");
  command
      ->add_option("--lines", arguments->lines,
                   fmt::format("Write the true lines too: {}; repeat it for several", graph_extensions()))
      ->type_name("FILE")
      ->allow_extra_args(false);
  command->add_option("--points", arguments->options.points, "Points wanted")
      ->capture_default_str()
      ->type_name("N");
  command
      ->add_option("--sampling", arguments->sampling,
                   "random (uniform by area), grid, mesh (also exactly on edges) or scan")
      ->capture_default_str()
      ->type_name("NAME");
  command
      ->add_option("--noise", arguments->noise,
                   "Standard deviation in point spacings (h) or bounding-box diagonals (bbox)")
      ->capture_default_str()
      ->type_name("F[h|bbox]");
  command->add_option("--seed", arguments->options.seed, "Same seed, same points")
      ->capture_default_str()
      ->type_name("S");
  command
      ->add_option("--angle", arguments->angle_deg,
                   "Dihedral angle of the crease, opening of the cone, in degrees")
      ->type_name("DEG");
  command
      ->add_option("--band", arguments->options.feature_band,
                   "truth_feature reaches so many spacings from a sharp feature")
      ->capture_default_str()
      ->type_name("F");
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "One JSON object on stdout instead of the summary");
  command->add_flag("--quiet", arguments->quiet, "No summary, no notes, no progress");
  command->footer(shape_list());
  command->callback(
      [&action, command, arguments] { action = [command, arguments] { synth(*command, *arguments); }; });
}

}  // namespace keenline::cli
