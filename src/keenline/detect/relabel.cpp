#include "keenline/detect/relabel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/kernels/line_angles.h"

namespace keenline {

std::uint16_t sensitivity_of(double sigma_deg) {
  if (!(sigma_deg > 0 && sigma_deg <= 90))
    throw InvalidArgument(
        fmt::format("--sigma: found {}, expected more than 0, up to 90 degrees", sigma_deg));
  return static_cast<std::uint16_t>(std::floor(sigma_deg * kernels::angle_units_per_degree));
}

std::size_t step_at(const LabelSpectrum& spectrum, std::size_t point, std::uint16_t sensitivity) {
  std::size_t step = spectrum.offsets[point];
  while (step + 1 < spectrum.offsets[point + 1] && spectrum.from[step + 1] <= sensitivity) ++step;
  return step;
}

FeatureLabels relabel(const LabelSpectrum& spectrum, double sigma_deg) {
  const std::uint16_t sensitivity = sensitivity_of(sigma_deg);
  FeatureLabels labels;
  labels.sigma_deg = sigma_deg;
  labels.kind.resize(spectrum.size());
  labels.clusters.resize(spectrum.size());
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const std::size_t step = step_at(spectrum, i, sensitivity);
    labels.kind[i] = spectrum.kind[step];
    labels.clusters[i] = spectrum.clusters[step];
  }
  return labels;
}

double choose_sigma(const LabelSpectrum& spectrum) {
  constexpr int candidates = 64;
  constexpr double candidate_step_deg = 90.0 / candidates;
  constexpr double tolerated_change = 0.02;
  const auto window_of = [](int candidate) {
    return std::array{sensitivity_of(candidate * candidate_step_deg / 1.25),
                      sensitivity_of(std::min(90.0, candidate * candidate_step_deg * 1.25))};
  };
  // Labels that change between sensitivities a quarter below and a quarter above, against those that are
  // features. The share of the whole keeps a sensitivity that sees nothing at all from looking perfectly
  // stable.
  constexpr int first = 7;  // 9.8 degrees: below, sampling alone scatters the lines of a curved surface
  constexpr int last = 32;  // 45 degrees: above, edges of 90 degrees begin to vanish
  std::array<double, last + 1> change{};
  bool sees_features = false;
  for (int c = first; c <= last; ++c) {
    const auto [low, high] = window_of(c);
    std::size_t changing = 0;
    std::size_t features = 0;
    for (std::size_t i = 0; i < spectrum.size(); ++i) {
      const std::size_t from = step_at(spectrum, i, low);
      const std::size_t to = step_at(spectrum, i, high);
      const bool is_feature_there = is_feature(spectrum.kind[from]);
      features += is_feature_there ? 1U : 0U;
      for (std::size_t s = from + 1; s <= to; ++s) {
        if (is_feature(spectrum.kind[s]) == is_feature_there) continue;
        ++changing;
        break;
      }
    }
    sees_features = sees_features || features > 0;
    change[static_cast<std::size_t>(c)] =
        static_cast<double>(changing + 1) /
        (static_cast<double>(features) + 0.01 * static_cast<double>(spectrum.size()) + 1);
  }
  if (!sees_features) return default_sigma_deg;
  // The largest of those that are about as stable as the best: it asks most of an edge for the same result.
  const double best = *std::min_element(change.begin() + first, change.end());
  int chosen = last;
  while (change[static_cast<std::size_t>(chosen)] > best + tolerated_change) --chosen;
  return chosen * candidate_step_deg;
}

}  // namespace keenline
