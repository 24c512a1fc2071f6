#pragma once

#include <span>
#include <string_view>

#include "keenline/synth/shape.h"
#include "keenline/synth/synth.h"

namespace keenline::synth {

/// A row of the table of shapes: what the world knows of it, and how it is built.
struct ShapeRow {
  SynthShape shape;
  Shape (*build)(double angle_deg);  ///< the angle is within shape.angle, or ignored where that is empty
};

[[nodiscard]] std::span<const ShapeRow> shape_rows();
/// nullptr when there is none of that name.
[[nodiscard]] const ShapeRow* find_shape(std::string_view name);

}  // namespace keenline::synth
