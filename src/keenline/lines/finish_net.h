#pragma once

#include <cstdint>
#include <span>

#include "keenline/feature_graph.h"
#include "keenline/lines/candidates.h"
#include "keenline/lines/line_net.h"
#include "keenline/progress.h"

namespace keenline {

/// Connects open ends to what is within `reach` of them but `ratio` times as far along the net, or not at
/// all: first with each other, the nearest first, for as long as there are any; then the others each to the
/// nearest node, if the loop that closes is 12 spacings or longer. Demarsin et al. 2007 reconnect open ends;
/// a tree has one for every loop. \throw Cancelled
void close_ends(LineNet& net, double reach, double ratio, const Progress& progress);

/// Moves what lies between ends and junctions towards the middle of its neighbours, and every other time back
/// by a little more: Taubin 1995, "A signal processing approach to fair surface design". Waves flatten, arcs
/// keep their radius. \throw Cancelled
void smooth(LineNet& net, int rounds, const Progress& progress);

/// The net as a drawing in the cloud's coordinates, corners where three or more lines meet. `support` says of
/// every node how many points back it.
[[nodiscard]] FeatureGraph graph_of(const LineNet& net, const Candidates& candidates,
                                    std::span<const std::uint32_t> support);

}  // namespace keenline
