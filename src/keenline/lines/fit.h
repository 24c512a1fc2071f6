#pragma once

#include "keenline/feature_graph.h"
#include "keenline/progress.h"

namespace keenline {

/// Every line as one curve: the simplest that comes within `tolerance` of all its vertices. A straight line;
/// else an arc, or where the line is closed and ends in no corner a circle; else the cubic B-spline of the
/// fewest control points (see fit_spline()). Ends stay where they are, so that lines still meet in their
/// corners, and a line is never split. Vertices move to the curve, by no more than the tolerance: each to
/// its nearest point, of a spline to the point of its parameter. So formats without curves draw them too.
/// Values of vertices stay as they are. Where not even a spline of as many control points as there are
/// vertices (of a closed line 400 at most) will do, as where a line turns back upon itself, it stays as it
/// is, without a curve. Threads: any number, same bits. Cost: O(vertices controls) for a spline, of a closed
/// line O(vertices controls^2). \param tolerance 0 or more, in the unit of the graph \throw InvalidArgument
/// for an invalid graph or a tolerance out of range; Cancelled.
[[nodiscard]] FeatureGraph fit_lines(const FeatureGraph& graph, double tolerance,
                                     Progress& progress = no_progress());

}  // namespace keenline
