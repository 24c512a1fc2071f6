#include "keenline/detect/threshold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "keenline/kernels/portable_math.h"

namespace keenline {

double choose_threshold(std::span<const float> scores, double low, double high) {
  constexpr std::size_t candidates = 26;
  constexpr double margin = 1.25;
  constexpr double tolerance = 0.02;
  const double ratio = kernels::natural_log(high / low) / (candidates - 1);
  std::array<double, candidates> thresholds{};
  std::array<double, candidates> shares{};
  for (std::size_t i = 0; i < candidates; ++i) {
    thresholds[i] = high * kernels::exp_of_negative(-ratio * static_cast<double>(candidates - 1 - i));
    const auto above = [&](double threshold) {
      return std::count_if(scores.begin(), scores.end(), [&](double score) { return score > threshold; });
    };
    const auto generous = static_cast<double>(above(thresholds[i] / margin));
    const auto strict = static_cast<double>(above(thresholds[i] * margin));
    shares[i] = generous > 0 ? (generous - strict) / generous : 1;
  }
  const double smallest = *std::min_element(shares.begin(), shares.end());
  std::size_t chosen = candidates - 1;
  while (shares[chosen] > smallest + tolerance) --chosen;
  return thresholds[chosen];
}

}  // namespace keenline
