#pragma once

#include <string>
#include <vector>

#include "keenline/evaluate/compare_graphs.h"

namespace keenline::cli {

/// `keenline evaluate FOUND… --lines TRUTH`: measures each drawing and prints the measures.
void evaluate_lines(const std::vector<std::string>& found, const std::string& truth,
                    const GraphComparisonOptions& options, bool json, bool quiet);

}  // namespace keenline::cli
