#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keenline/pipeline.h"

namespace CLI {
class App;
}

namespace keenline::cli {

/// --report, --report-points and --picture.
void add_view_options(CLI::App& command, Views& views);

/// Adds "report" and "picture" to what --json prints; null where there is none.
void add_views(nlohmann::json& object, const Views& views);

/// All files that a run writes, in order: what a summary names.
[[nodiscard]] std::vector<std::string> all_outputs(std::vector<std::string> outputs, const Views& views);

}  // namespace keenline::cli
