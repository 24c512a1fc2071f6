#pragma once

namespace keenline {

class Progress;
class Sink;
struct FeatureGraph;

/// GeoJSON: corners as Point, lines as LineString, closed ones ending with their first position; attributes
/// as properties, numbered from 0. The coordinates are those of the cloud, whatever RFC 7946 expects; the
/// member "keenline" says so and gives the CRS.
/// \pre the graph is valid
/// \throw OutputError from the sink; Cancelled.
void write_graph_geojson(const FeatureGraph& graph, Sink& sink, Progress& progress);

}  // namespace keenline
