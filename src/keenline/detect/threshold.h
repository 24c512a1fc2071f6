#pragma once

#include <span>

namespace keenline {

/// The threshold that matters least: of 26 from `low` to `high`, in equal ratios, the largest for which the
/// share of the scores above four fifths of it that are not above five quarters of it is within 0.02 of the
/// smallest. Scores just above or below a threshold are those that a slightly different one would judge
/// differently. Threads: one. Cost: O(n). \pre 0 < low < high, finite scores
[[nodiscard]] double choose_threshold(std::span<const float> scores, double low, double high);

}  // namespace keenline
