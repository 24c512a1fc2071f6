#include "keenline/lines/tracers.h"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/lines/trace.h"
#include "keenline/lines/trace_demarsin.h"
#include "keenline/lines/trace_gumhold.h"
#include "keenline/lines/trace_pauly.h"
#include "keenline/lines/trace_tensor_voting.h"

namespace keenline {
namespace {

/// A stage with its default options.
template <auto stage, typename Options>
FeatureGraph by_default(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                        double spacing, Progress& progress) {
  return stage(cloud, search, labels, spacing, Options{}, progress);
}

constexpr std::array table{
    LineTracer{"walk", "Along the surfaces that meet in a line, from foot to foot", "",
               by_default<trace_lines, TraceOptions>},
    LineTracer{"gumhold", "Minimum spanning pattern of the sharp points", "Gumhold, Wang, MacLeod 2001",
               by_default<trace_gumhold, TraceGumholdOptions>},
    LineTracer{"pauly", "Spanning graph of the sharp points, drawn tight by snakes",
               "Pauly, Keiser, Gross 2003", by_default<trace_pauly, TracePaulyOptions>},
    LineTracer{"demarsin", "Graph of clusters of sharp points, its open ends closed",
               "Demarsin, Vanderstraeten, Volodine, Roose 2007",
               by_default<trace_demarsin, TraceDemarsinOptions>},
    LineTracer{"tensor_voting", "Extremal curves of curve saliency", "Guy, Medioni 1997",
               by_default<trace_tensor_voting, TraceTensorVotingOptions>},
};

}  // namespace

std::span<const LineTracer> line_tracers() { return table; }

const LineTracer& find_tracer(std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const LineTracer& tracer) { return tracer.name == name; });
  if (found != table.end()) return *found;
  std::vector<std::string_view> names;
  names.reserve(table.size());
  for (const LineTracer& tracer : table) names.push_back(tracer.name);
  throw InvalidArgument(
      fmt::format("--trace: found {}, expected one of {}", quoted(name), fmt::join(names, ", ")));
}

}  // namespace keenline
