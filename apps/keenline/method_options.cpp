#include "method_options.h"

#include <algorithm>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

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

}  // namespace keenline::cli
