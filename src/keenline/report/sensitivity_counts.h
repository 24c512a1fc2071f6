#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "keenline/labels.h"

namespace keenline {

/// Points of each of all_kinds, in their order.
using KindCounts = std::array<std::uint32_t, all_kinds.size()>;

/// For every sensitivity from 0 to 65520 (see LabelSpectrum) how many points are of each kind: those of
/// relabel(). Cost: O(steps).
[[nodiscard]] std::vector<KindCounts> counts_per_sensitivity(const LabelSpectrum& spectrum);

[[nodiscard]] KindCounts count_kinds(const std::vector<Kind>& kinds);

}  // namespace keenline
