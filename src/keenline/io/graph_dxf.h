#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// DXF R2000 (AC1015), ascii: 3D polylines on the layers CREASES and BORDERS, points on CORNERS. Where a
/// curve was fitted: LINE, CIRCLE, ARC or SPLINE instead.
/// \pre the graph is valid
/// \throw OutputError from the sink; Cancelled.
void write_graph_dxf(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
