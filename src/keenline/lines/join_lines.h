#pragma once

#include "keenline/feature_graph.h"

namespace keenline {

/// Lines of one kind whose loose ends lie on one straight line and face each other become one line: the gap
/// is at most 6 spacings wide (or the ends overlap by at most one), both ends point along it to 10 degrees,
/// and neither is more than 0.35 spacings off the straight continuation of the other. Made for lines that
/// have been moved onto the design line, where the two halves of an edge agree to that; before, they need
/// not. The nearest ends are joined first, then the lower numbered. Nothing is known of the surface in the
/// gap: support is that of the parts. Ends of one line may meet as well; it is closed then. A joined line
/// stands where the first of its parts stood; curves that were fitted to parts are dropped. Cost: O(vertices
/// + ends log ends). \pre spacing > 0 \throw InvalidArgument for an invalid graph.
[[nodiscard]] FeatureGraph join_lines(const FeatureGraph& graph, double spacing);

}  // namespace keenline
