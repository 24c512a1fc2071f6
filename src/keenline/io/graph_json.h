#pragma once

#include "keenline/feature_graph.h"

namespace keenline {

class Progress;
class Sink;
struct Source;

/// The whole graph, and back without the loss of a bit:
///
///     {"crs": null or text,
///      "corners": [{"position": [x, y, z], "residual": r}, …],
///      "polylines": [{"vertices": [[x, y, z], …], "closed": false, "kind": "crease" or "border",
///                     "corners": [i or null, j or null], "length": l, "support": n,
///                     "dihedral_deg": [a, …], "normals": [[[x, y, z], [x, y, z]], …], "residual": [r, …],
///                     "curve": {"type": "line", "start": [x, y, z], "end": [x, y, z]}
///                           or {"type": "arc", "center": …, "normal": …, "x_axis": …, "radius": r,
///                               "sweep_deg": a}
///                           or {"type": "spline", "control_points": […], "knots": […]}}, …]}
///
/// What is not known is left out. \pre the graph is valid
/// \throw OutputError from the sink; Cancelled.
void write_graph_json(const FeatureGraph& graph, Sink& sink, Progress& progress);

/// Of a corner only the position is needed, of a polyline only the vertices; lengths are not read but follow
/// from the vertices, and members of other names are passed over.
/// \throw InputError naming the member, as in polylines[3].vertices[7], or the byte where it is not JSON;
/// OutOfMemory.
[[nodiscard]] FeatureGraph read_graph_json(const Source& source);

}  // namespace keenline
