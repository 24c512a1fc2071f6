#pragma once

#include "keenline/feature_graph.h"
#include "keenline/synth/synth.h"

namespace keenline {

/// The exact sharp features and borders of a shape as a drawing: its curves from corner to corner, its
/// corners and, as corners without lines, its peaks. Straight edges have two vertices. The chords of an arc
/// of radius r miss it by at most the smaller of h^2 / 8r and r / 1000, which is never more than 0.012 h.
[[nodiscard]] FeatureGraph true_lines(const SynthCloud& synth);

}  // namespace keenline
