#include "method_options.h"

#include <algorithm>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace keenline::cli {

void add_method_options(CLI::App& command, std::span<const Method> methods, MethodArguments& arguments,
                        std::string_view without) {
  std::set<std::string, std::less<>> known;
  for (const Method& method : methods) {
    for (const OptionInfo& option : method.options) {
      const std::string name(option.name);
      if (name == without || !known.insert(name).second) continue;
      if (option.type == OptionInfo::Type::Flag) {
        const bool is_on = option.default_value == 1.0;
        command
            .add_flag(is_on ? fmt::format("--{0},!--no-{0}", name) : "--" + name, arguments.flags[name],
                      fmt::format("{}{}", option.summary, is_on ? " (default on)" : ""))
            ->group("Method");
        continue;
      }
      const std::string value =
          option.default_value ? fmt::format("{}", *option.default_value) : std::string(option.automatic);
      command
          .add_option("--" + name, arguments.options[name],
                      fmt::format("{} ({}; default {})", option.summary, range_of(option), value))
          ->type_name("")
          ->group("Method");
    }
  }
}

OptionValues parsed_options(const CLI::App& command, const Method& method, const MethodArguments& arguments) {
  OptionValues values;
  for (const auto& [name, text] : arguments.options) {
    if (command.count("--" + name) == 0) continue;
    const auto option = std::find_if(method.options.begin(), method.options.end(),
                                     [&name = name](const OptionInfo& o) { return o.name == name; });
    // An option of another method: resolve_options says so.
    values[name] = option == method.options.end() ? std::nullopt : parse_option(*option, text);
  }
  for (const auto& [name, set] : arguments.flags)
    if (command.count("--" + name) > 0) values[name] = set ? 1 : 0;
  return values;
}

void add_smoothing_option(CLI::App& command, Smoothing& smoothing) {
  command
      .add_option("--smooth", smoothing,
                  fmt::format("Look at smoothed positions: yes, no, or auto = where the noise is above {} "
                              "spacings (default auto; never with --plain)",
                              noise_worth_smoothing))
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Smoothing>{
              {"auto", Smoothing::Auto}, {"yes", Smoothing::Yes}, {"no", Smoothing::No}},
          CLI::ignore_case))
      ->type_name("auto|yes|no");
}

nlohmann::json json_options(const Method& method, const OptionValues& values) {
  nlohmann::json object = nlohmann::json::object();
  for (const OptionInfo& option : method.options) {
    const std::string name(option.name);
    std::visit([&](const auto& value) { object[name] = value; }, told_value(option, values.at(name)));
  }
  return object;
}

std::string option_words(const Method& method, const OptionValues& values) {
  std::string words;
  for (const OptionInfo& option : method.options) {
    const std::optional<double>& value = values.at(std::string(option.name));
    if (option.type == OptionInfo::Type::Flag) {
      if (value != option.default_value)
        words += fmt::format(", {}{}", value == 1.0 ? "" : "no-", option.name);
      continue;
    }
    words += fmt::format(", {} {}", option.name, text_of(option, value));
  }
  return words;
}

}  // namespace keenline::cli
