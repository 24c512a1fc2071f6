#pragma once

#include <span>
#include <vector>

#include "keenline/synth/curve.h"
#include "keenline/synth/synth.h"

namespace keenline::synth {

/// The ends of all curves, each once, in the order of the curves. Whole circles have none.
[[nodiscard]] std::vector<Vec3> ends_of(std::span<const Curve> curves);

/// Ends where three or more edges meet, or two meet at an angle.
[[nodiscard]] std::vector<Vec3> corners_of(std::span<const Curve> edges);

/// Strings the curves together into polylines that end only at `stops` and where other than two curves meet.
/// Straight pieces stay whole; arcs get vertices at most `step` and 5 degrees apart.
[[nodiscard]] std::vector<TruthCurve> polylines_of(std::span<const Curve> curves, std::span<const Vec3> stops,
                                                   double step);

}  // namespace keenline::synth
