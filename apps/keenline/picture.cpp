#include "keenline/report/picture.h"

#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/output_file.h"
#include "keenline/io/read.h"
#include "keenline/report/png.h"

#include "commands.h"
#include "sheet_options.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct PictureArguments {
  std::vector<std::string> inputs;
  std::string color;
  std::vector<std::string> lines;
  SheetArguments sheet;
};

void picture(const PictureArguments& arguments) {
  limit_threads(arguments.sheet.threads);
  const std::string& output = arguments.sheet.output;
  require_png_extension(output);
  PictureOptions options;
  options.camera = parsed_view(arguments.sheet, options.camera);
  const Size size = parsed_size(arguments.sheet, {options.width, options.height});
  options.width = size.width;
  options.height = size.height;
  options.color = arguments.color;

  if (arguments.lines.size() > arguments.inputs.size()) {
    throw InvalidArgument(fmt::format("--lines: found {}, expected at most one for each of {} clouds",
                                      arguments.lines.size(), arguments.inputs.size()));
  }
  for (const std::string& lines : arguments.lines) require_different_files(lines, output);

  TerminalProgress progress(arguments.sheet.quiet);
  std::vector<Image> pictures;
  for (const std::string& input : arguments.inputs) {
    require_different_files(input, output);
    options.caption = caption_of(arguments.sheet, pictures.size(), arguments.inputs.size()).value_or("");
    const Reading reading = read_cloud(input, progress);
    progress.clear();
    if (!arguments.sheet.quiet) print_notes(input, reading.notes);
    FeatureGraph graph;
    options.lines = nullptr;
    if (pictures.size() < arguments.lines.size()) {
      graph = read_graph(arguments.lines[pictures.size()]);
      options.lines = &graph;
    }
    pictures.push_back(draw_cloud(reading.cloud, options, progress));
    progress.clear();
  }
  write_sheet(arguments.sheet, pictures, arguments.inputs, progress);
}

}  // namespace

void add_picture(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("picture", "Draw point clouds, labelled or not, as a PNG");
  const auto arguments = std::make_shared<PictureArguments>();
  command->add_option("CLOUD", arguments->inputs, "Point clouds or meshes; several stand on one sheet")
      ->required();
  command
      ->add_option("--color", arguments->color,
                   "kind, score, or any numeric attribute (default: kind, where the cloud has it)")
      ->type_name("NAME");
  command
      ->add_option(
          "--lines", arguments->lines,
          "Draw these lines (.json, see keenline lines) over the cloud; repeat it for each cloud in order")
      ->type_name("FILE")
      ->allow_extra_args(false);
  const PictureOptions standard;
  add_sheet_options(*command, arguments->sheet, standard.camera, {standard.width, standard.height});
  command->callback([&action, arguments] { action = [arguments] { picture(*arguments); }; });
}

}  // namespace keenline::cli
