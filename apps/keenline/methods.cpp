#include <memory>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/detect/registry.h"
#include "keenline/lines/tracers.h"

#include "commands.h"
#include "terminal.h"

namespace keenline::cli {
namespace {

std::string_view word_for(MethodInput input) { return input == MethodInput::Points ? "points" : "mesh"; }

std::string_view word_for(OptionInfo::Type type) {
  switch (type) {
    case OptionInfo::Type::Integer: return "integer";
    case OptionInfo::Type::Flag: return "flag";
    case OptionInfo::Type::Real: break;
  }
  return "real";
}

nlohmann::json json_option(const OptionInfo& option) {
  nlohmann::json object{{"name", option.name},
                        {"summary", option.summary},
                        {"type", word_for(option.type)},
                        {"minimum", option.minimum},
                        {"minimum_excluded", option.minimum_excluded},
                        {"maximum", option.maximum},
                        {"unit", option.unit},
                        {"automatic", option.automatic}};
  if (!option.word_for_minimum.empty()) object["word_for_minimum"] = option.word_for_minimum;
  object["default"] =
      option.default_value ? nlohmann::json(*option.default_value) : nlohmann::json(option.automatic);
  return object;
}

void list_as_json() {
  nlohmann::json list = nlohmann::json::array();
  for (const Method& method : methods()) {
    nlohmann::json options = nlohmann::json::array();
    for (const OptionInfo& option : method.options) options.push_back(json_option(option));
    list.push_back({{"name", method.name},
                    {"summary", method.summary},
                    {"paper", method.paper},
                    {"input", word_for(method.input)},
                    {"options", options}});
  }
  nlohmann::json tracers = nlohmann::json::array();
  for (const LineTracer& tracer : line_tracers())
    tracers.push_back({{"name", tracer.name}, {"summary", tracer.summary}, {"paper", tracer.paper}});
  print_json({{"methods", std::move(list)}, {"tracers", std::move(tracers)}});
}

void list_as_text() {
  std::string text;
  for (const Method& method : methods()) {
    text += fmt::format("{}  {}\n    paper: {}\n    input: {}\n", method.name, method.summary, method.paper,
                        word_for(method.input));
    for (const OptionInfo& option : method.options) {
      text += fmt::format("    --{:<13} {}", option.name, option.summary);
      if (option.type != OptionInfo::Type::Flag)
        text += fmt::format(
            "\n    {:<15} {}; default {}", "", range_of(option),
            option.default_value ? fmt::format("{}", *option.default_value) : std::string(option.automatic));
      else if (option.default_value == 1.0)
        text += fmt::format("; default on, --no-{} turns it off", option.name);
      text += '\n';
    }
  }
  text += "\nlines, by --trace:\n";
  for (const LineTracer& tracer : line_tracers()) {
    text += fmt::format("{}  {}\n", tracer.name, tracer.summary);
    if (!tracer.paper.empty()) text += fmt::format("    paper: {}\n", tracer.paper);
  }
  print(text);
}

}  // namespace

void add_methods(CLI::App& app, Action& action) {
  CLI::App* const command =
      app.add_subcommand("methods", "List the methods and their options, and the ways to trace lines");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "As one JSON object");
  command->callback([&action, json] { action = [json] { *json ? list_as_json() : list_as_text(); }; });
}

}  // namespace keenline::cli
