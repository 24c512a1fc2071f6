#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// Wavefront OBJ: v, l and p elements in the groups creases, borders and corners; `l` of a closed line ends
/// with its first vertex.
/// \pre the graph is valid
/// \throw InvalidArgument for more than max_points vertices; OutputError from the sink; Cancelled.
void write_graph_obj(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
