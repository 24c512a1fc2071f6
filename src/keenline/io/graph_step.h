#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// Whether this build can: it needs OpenCASCADE, which is looked for when the build is configured.
[[nodiscard]] bool has_step();

/// STEP AP214: three products of curves and points, CREASES, BORDERS and CORNERS. Fitted curves are lines,
/// arcs, circles and B-splines, all other lines chains of straight edges. Every STEP file has a unit: metres
/// where the coordinate reference system is known, else millimetres; the numbers are the graph's. Vertices
/// nearer than 1e-7 to the one before are left out: OpenCASCADE takes them for one. The same graph gives the
/// same bytes. Threads: one at a time, others wait.
/// \pre the graph is valid
/// \throw OutputError unless has_step(), for a line that is shorter than 1e-7 in all, when OpenCASCADE fails,
/// or from the sink; Cancelled.
void write_graph_step(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
