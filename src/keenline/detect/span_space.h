#pragma once

#include "keenline/kernels/symmetric3.h"

namespace keenline {

/// Whether the normals of faces, unit vectors whose squares n nᵀ add up to this, make a corner: those along
/// an edge between curved faces all lie in one plane. Two normals that are 28 degrees apart leave that plane
/// just enough if a third is across them.
[[nodiscard]] bool normals_span_space(const kernels::Symmetric3& squares);

}  // namespace keenline
