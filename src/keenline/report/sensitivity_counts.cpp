#include "keenline/report/sensitivity_counts.h"

#include <algorithm>
#include <cstddef>

#include "keenline/kernels/line_angles.h"

namespace keenline {
namespace {

std::size_t place_of(Kind kind) {
  return kind == Kind::Undecided ? all_kinds.size() - 1 : static_cast<std::size_t>(kind);
}

}  // namespace

std::vector<KindCounts> counts_per_sensitivity(const LabelSpectrum& spectrum) {
  // First the changes; that they go below 0 and come back does no harm to unsigned numbers.
  std::vector<KindCounts> counts(kernels::right_angle + 1);
  for (std::size_t point = 0; point < spectrum.size(); ++point) {
    const std::size_t first = spectrum.offsets[point];
    for (std::size_t step = first; step < spectrum.offsets[point + 1]; ++step) {
      KindCounts& here = counts[spectrum.from[step]];
      ++here[place_of(spectrum.kind[step])];
      if (step > first) --here[place_of(spectrum.kind[step - 1])];
    }
  }
  for (std::size_t s = 1; s < counts.size(); ++s)
    for (std::size_t kind = 0; kind < all_kinds.size(); ++kind) counts[s][kind] += counts[s - 1][kind];
  return counts;
}

KindCounts count_kinds(const std::vector<Kind>& kinds) {
  KindCounts counts{};
  for (const Kind kind : kinds) ++counts[place_of(kind)];
  return counts;
}

}  // namespace keenline
