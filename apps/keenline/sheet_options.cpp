#include "sheet_options.h"

#include <array>
#include <cmath>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/text.h"
#include "keenline/report/png.h"

#include "terminal.h"

namespace keenline::cli {
namespace {

/// "A,B" as two numbers. \throw InvalidArgument
template <typename T>
std::array<T, 2> parse_pair(std::string_view option, const std::string& text, std::string_view expected) {
  const std::size_t comma = text.find(',');
  std::array<T, 2> pair{};
  const std::string_view whole = text;
  if (comma == std::string::npos || parse_number(whole.substr(0, comma), pair[0]) != Parsed::Ok ||
      parse_number(whole.substr(comma + 1), pair[1]) != Parsed::Ok)
    throw InvalidArgument(
        fmt::format("--{}: found {}, expected {}", option, keenline::quoted(text), expected));
  return pair;
}

}  // namespace

void add_sheet_options(CLI::App& command, SheetArguments& arguments, const Camera& camera, Size size) {
  command.add_option("-o,--output", arguments.output, "Result: .png")->required()->type_name("OUT");
  command
      .add_option(
          "--view", arguments.view,
          fmt::format("From where: degrees from the x axis, degrees above the xy plane (default {},{})",
                      camera.azimuth_deg, camera.elevation_deg))
      ->type_name("AZ,EL");
  command
      .add_option("--size", arguments.size,
                  fmt::format("Pixels of a picture (default {},{})", size.width, size.height))
      ->type_name("W,H");
  command
      .add_option("--columns", arguments.columns,
                  "Several pictures stand in so many columns (default: as square as it gets)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command.add_option("--caption", arguments.captions, "A line above a picture; repeat it for each in order")
      ->type_name("TEXT")
      ->allow_extra_args(false);
  command.add_option("--threads", arguments.threads, "Threads to use (default: all)")->type_name("N");
  command.add_flag("--json", arguments.json, "One JSON object on stdout instead of the summary");
  command.add_flag("--quiet", arguments.quiet, "No summary, no notes, no progress");
}

Camera parsed_view(const SheetArguments& arguments, const Camera& standard) {
  if (arguments.view.empty()) return standard;
  constexpr std::string_view expected = "AZ,EL: two numbers of degrees, EL from -90 to 90";
  const auto [azimuth, elevation] = parse_pair<double>("view", arguments.view, expected);
  if (!std::isfinite(azimuth) || !(std::abs(elevation) <= 90))
    throw InvalidArgument(
        fmt::format("--view: found {}, expected {}", keenline::quoted(arguments.view), expected));
  return {azimuth, elevation};
}

Size parsed_size(const SheetArguments& arguments, Size standard) {
  if (arguments.size.empty()) return standard;
  const auto [width, height] =
      parse_pair<std::int32_t>("size", arguments.size, "W,H: two numbers of pixels from 64 to 8192");
  return {width, height};
}

std::optional<std::string> caption_of(const SheetArguments& arguments, std::size_t i, std::size_t pictures) {
  if (arguments.captions.size() > pictures) {
    throw InvalidArgument(
        fmt::format("--caption: found {} captions, expected at most {}, one for each picture",
                    arguments.captions.size(), pictures));
  }
  return i < arguments.captions.size() ? std::optional(arguments.captions[i]) : std::nullopt;
}

void write_sheet(const SheetArguments& arguments, const std::vector<Image>& pictures,
                 const std::vector<std::string>& inputs, TerminalProgress& progress) {
  const int square = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(pictures.size()))));
  const Image sheet = sheet_of(pictures, arguments.columns > 0 ? arguments.columns : square);
  write_png(arguments.output, sheet, progress, [&] {
    progress.clear();
    if (arguments.json) {
      print_json({{"inputs", inputs},
                  {"output", arguments.output},
                  {"pictures", pictures.size()},
                  {"width", sheet.width()},
                  {"height", sheet.height()}});
    } else if (!arguments.quiet) {
      print(fmt::format("{} picture{}, {} x {} pixels; in {}\n", pictures.size(),
                        pictures.size() == 1 ? "" : "s", sheet.width(), sheet.height(),
                        escaped(arguments.output, 4096)));
    }
  });
}

}  // namespace keenline::cli
