#pragma once

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct Neighborhoods;

/// The paper's filter of isolated candidates: a sharp point with fewer than `min_support` sharp points among
/// its 16 nearest neighbours becomes curved, unless it is a peak; a border with fewer border points among
/// them becomes flat. For every sensitivity at once, so that the labels of the result at one of them are
/// those that filtering at that sensitivity would give. Neighbours count as they were before the filter.
/// Threads: any number, same result. Cost: O(sharp points). \pre neighborhoods.size() == spectrum.size()
/// \throw Cancelled
[[nodiscard]] LabelSpectrum without_isolated(const LabelSpectrum& spectrum,
                                             const Neighborhoods& neighborhoods, int min_support,
                                             Progress& progress = no_progress());

}  // namespace keenline
