#include <algorithm>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/read.h"
#include "keenline/io/text.h"

#include "commands.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

struct InfoArguments {
  std::string file;
  int threads = 0;
  bool json = false;
  bool quiet = false;
};

struct Box {
  Point low{};
  Point high{};
};

/// Of the finite points; there must be one.
Box bounding_box(const PointCloud& cloud) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const Point& p : cloud.positions) {
    if (!is_finite(p)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], p[axis]);
      box.high[axis] = std::max(box.high[axis], p[axis]);
    }
  }
  return box;
}

std::string type_words(const Column& column) {
  return column.is_list() ? fmt::format("list of {}", name_of(column.type()))
                          : std::string(name_of(column.type()));
}

nlohmann::json json_columns(const std::vector<Column>& columns) {
  nlohmann::json list = nlohmann::json::array();
  for (const Column& column : columns)
    list.push_back({{"name", column.name()}, {"type", name_of(column.type())}, {"list", column.is_list()}});
  return list;
}

void print_json_info(const InfoArguments& arguments, const Reading& reading) {
  const PointCloud& cloud = reading.cloud;
  nlohmann::json tables = nlohmann::json::array();
  for (const Table& table : cloud.tables)
    tables.push_back({{"name", table.name}, {"rows", table.rows}, {"columns", json_columns(table.columns)}});
  const std::size_t finite = count_finite(cloud);
  nlohmann::json object{{"input", arguments.file},
                        {"format", reading.format},
                        {"encoding", reading.encoding},
                        {"points", cloud.size()},
                        {"finite_points", finite},
                        {"coordinate_types",
                         {name_of(cloud.position_types[0]), name_of(cloud.position_types[1]),
                          name_of(cloud.position_types[2])}},
                        {"attributes", json_columns(cloud.attributes)},
                        {"tables", std::move(tables)},
                        {"comments", cloud.comments},
                        {"notes", reading.notes}};
  if (finite > 0) {
    const Box box = bounding_box(cloud);
    object["bounding_box"] = {{"min", box.low}, {"max", box.high}};
  }
  print_json(std::move(object));
}

void print_info(const InfoArguments& arguments, const Reading& reading) {
  const PointCloud& cloud = reading.cloud;
  const std::size_t finite = count_finite(cloud);
  std::string text =
      fmt::format("{}: {}, {}\n", escaped(arguments.file, 4096), reading.format, escaped(reading.encoding));
  text += fmt::format("  {} points", grouped(cloud.size()));
  if (finite != cloud.size()) text += fmt::format(", {} of them finite", grouped(finite));
  text += fmt::format("; coordinates {}, {}, {}\n", name_of(cloud.position_types[0]),
                      name_of(cloud.position_types[1]), name_of(cloud.position_types[2]));
  if (finite > 0) {
    const Box box = bounding_box(cloud);
    text += fmt::format("  from ({}, {}, {})\n    to ({}, {}, {})\n", box.low[0], box.low[1], box.low[2],
                        box.high[0], box.high[1], box.high[2]);
  }
  for (const Column& column : cloud.attributes)
    text += fmt::format("  attribute {} ({})\n", escaped(column.name(), 100), type_words(column));
  for (const Table& table : cloud.tables) {
    text += fmt::format("  table {}: {} rows\n", escaped(table.name, 100), grouped(table.rows));
    for (const Column& column : table.columns)
      text += fmt::format("    {} ({})\n", escaped(column.name(), 100), type_words(column));
  }
  for (const std::string& comment : cloud.comments)
    text += fmt::format("  comment {}\n", escaped(comment, 200));
  print(text);
}

void info(const InfoArguments& arguments) {
  limit_threads(arguments.threads);
  const Reading reading = [&] {
    TerminalProgress progress(arguments.quiet);
    return read_cloud(arguments.file, progress);
  }();
  if (!arguments.quiet) print_notes(arguments.file, reading.notes);
  arguments.json ? print_json_info(arguments, reading) : print_info(arguments, reading);
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  CLI::App* const command = app.add_subcommand("info", "Show what was understood of a file");
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("FILE", arguments->file, "Point cloud or mesh")->required();
  command->add_option("--threads", arguments->threads, "Threads to use (default: all)")->type_name("N");
  command->add_flag("--json", arguments->json, "As one JSON object");
  command->add_flag("--quiet", arguments->quiet, "No notes, no progress");
  command->callback([&action, arguments] { action = [arguments] { info(*arguments); }; });
}

}  // namespace keenline::cli
