#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// PLY (binary little endian): vertices with `corner` (its number, else -1), and the element edge: vertex1,
/// vertex2, line (number of the polyline) and kind (0 crease, 1 border).
/// \pre the graph is valid
/// \throw InvalidArgument for more than max_points vertices; OutputError from the sink; Cancelled.
void write_graph_ply(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
