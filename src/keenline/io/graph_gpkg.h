#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// GeoPackage 1.3: tables feature_lines (LINESTRING Z) and feature_corners (POINT Z), numbered from 1. The
/// same graph gives the same bytes: the time of the last change is always the epoch.
/// \pre the graph is valid
/// \throw OutputError when SQLite fails, or from the sink; Cancelled.
void write_graph_gpkg(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
