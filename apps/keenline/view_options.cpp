#include "view_options.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/cloud.h"

namespace keenline::cli {
namespace {

nlohmann::json path_or_null(const std::string& path) {
  return path.empty() ? nlohmann::json() : nlohmann::json(path);
}

}  // namespace

void add_view_options(CLI::App& command, Views& views) {
  command
      .add_option("--report", views.report,
                  "A page to look at in any browser, offline: cloud, result and what if sigma were different")
      ->type_name("FILE.html")
      ->group("Views");
  command
      .add_option("--report-points", views.report_points,
                  fmt::format("Points in the report; of more only the sharp ones and borders are all kept "
                              "(default {})",
                              views.report_points))
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, max_points))
      ->group("Views");
  command.add_option("--picture", views.picture, "The result as a picture")
      ->type_name("FILE.png")
      ->group("Views");
}

void add_views(nlohmann::json& object, const Views& views) {
  object["report"] = path_or_null(views.report);
  object["picture"] = path_or_null(views.picture);
}

std::vector<std::string> all_outputs(std::vector<std::string> outputs, const Views& views) {
  for (const std::string& view : {views.report, views.picture}) outputs.push_back(view);
  std::erase(outputs, "");
  return outputs;
}

}  // namespace keenline::cli
