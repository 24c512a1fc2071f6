#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "keenline/detect/registry.h"
#include "keenline/pipeline.h"

namespace CLI {
class App;
}

namespace keenline::cli {

/// What a user typed for the options of methods.
struct MethodArguments {
  std::map<std::string, std::string> options;
  std::map<std::string, bool> flags;
};

/// One flag for every option of these methods: methods share a name only for the same thing. `without` says
/// what has no meaning for the command.
void add_method_options(CLI::App& command, std::span<const Method> methods, MethodArguments& arguments,
                        std::string_view without = {});

/// What was given, for `method`. \throw InvalidArgument with the allowed range.
[[nodiscard]] OptionValues parsed_options(const CLI::App& command, const Method& method,
                                          const MethodArguments& arguments);

void add_smoothing_option(CLI::App& command, Smoothing& smoothing);

/// Every option of the method with its value, as detect and lines report them.
[[nodiscard]] nlohmann::json json_options(const Method& method, const OptionValues& values);
/// ", neighbors 16, sigma 14.2, …"
[[nodiscard]] std::string option_words(const Method& method, const OptionValues& values);

}  // namespace keenline::cli
