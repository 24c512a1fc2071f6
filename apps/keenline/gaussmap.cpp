#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "keenline/detect/gauss.h"
#include "keenline/detect/registry.h"
#include "keenline/errors.h"
#include "keenline/io/output_file.h"
#include "keenline/io/read.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/report/gauss_sphere.h"
#include "keenline/report/png.h"

#include "commands.h"
#include "method_options.h"
#include "sheet_options.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct GaussmapArguments {
  std::string input;
  std::vector<std::uint64_t> points;
  MethodArguments method;
  SheetArguments sheet;
};

void gaussmap(const CLI::App& command, const GaussmapArguments& arguments) {
  limit_threads(arguments.sheet.threads);
  require_png_extension(arguments.sheet.output);
  require_different_files(arguments.input, arguments.sheet.output);
  const Method& method = find_method("gauss");
  const OptionValues values = resolve_options(method, parsed_options(command, method, arguments.method));
  GaussOptions options = gauss_options_from(values);
  GaussSphereOptions sphere;
  sphere.camera = parsed_view(arguments.sheet, sphere.camera);
  const Size size = parsed_size(arguments.sheet, {sphere.width, sphere.height});
  sphere.width = size.width;
  sphere.height = size.height;

  TerminalProgress progress(arguments.sheet.quiet);
  const Reading reading = read_cloud(arguments.input, progress);
  const PointCloud& cloud = reading.cloud;
  for (const std::uint64_t point : arguments.points) {
    if (point < cloud.size()) continue;
    throw InvalidArgument(fmt::format("--point: found {}, {}", point,
                                      cloud.size() == 0 ? "but the cloud has no points"
                                                        : fmt::format("expected 0 to {}", cloud.size() - 1)));
  }
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, method.reach(values), progress);
  if (options.sigma_rule == SigmaRule::Auto && !arguments.points.empty()) {
    // Once, not for every point.
    options.sigma_deg = detect_gauss(cloud, neighborhoods, options, progress).sigma_deg;
    options.sigma_rule = SigmaRule::Given;
  }
  progress.clear();
  if (!arguments.sheet.quiet) print_notes(arguments.input, reading.notes);

  std::vector<Image> pictures;
  for (const std::uint64_t point : arguments.points) {
    const PointGaussMap map = gauss_map(cloud, neighborhoods, point, options, progress);
    const std::string told =
        fmt::format("point {}: {}, {} lines, {} cluster{}", point, name_of(map.kind), map.lines.size(),
                    map.sizes.size(), map.sizes.size() == 1 ? "" : "s");
    sphere.caption = caption_of(arguments.sheet, pictures.size(), arguments.points.size()).value_or(told);
    pictures.push_back(draw_gauss_sphere(map, sphere));
  }
  write_sheet(arguments.sheet, pictures, {arguments.input}, progress);
}

}  // namespace

void add_gaussmap(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("gaussmap", "Draw the Gauss map of points, coloured by cluster, as a PNG");
  const auto arguments = std::make_shared<GaussmapArguments>();
  command->add_option("INPUT", arguments->input, "Point cloud or mesh")->required();
  command->add_option("--point", arguments->points, "Number of the point, from 0; repeat it for several")
      ->required()
      ->type_name("I")
      ->allow_extra_args(false);
  const GaussSphereOptions standard;
  add_sheet_options(*command, arguments->sheet, standard.camera, {standard.width, standard.height});
  add_method_options(*command, {&find_method("gauss"), 1}, arguments->method, "spectrum");
  command->callback(
      [&action, command, arguments] { action = [command, arguments] { gaussmap(*command, *arguments); }; });
}

}  // namespace keenline::cli
