#include "keenline/detect/relabel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include "keenline/errors.h"
#include "keenline/kernels/line_angles.h"

namespace keenline {
namespace {

// Multiples of 90/64 degrees. Below 9.8 degrees sampling alone scatters the lines of a curved surface, above
// 45 edges of 90 degrees begin to vanish.
constexpr std::size_t first_candidate = 7;
constexpr std::size_t candidates = 26;

double candidate_deg(std::size_t candidate) {
  return static_cast<double>(first_candidate + candidate) * (90.0 / 64);
}

/// Sensitivities a fifth below a candidate and a quarter above.
struct Window {
  std::uint16_t low;
  std::uint16_t high;
};

std::array<Window, candidates> candidate_windows() {
  std::array<Window, candidates> windows;
  for (std::size_t c = 0; c < candidates; ++c)
    windows[c] = {sensitivity_of(candidate_deg(c) / 1.25), sensitivity_of(candidate_deg(c) * 1.25)};
  return windows;
}

struct Changes {
  std::array<std::size_t, candidates> features{};  // points that are features where the window begins
  std::array<std::size_t, candidates> changing{};  // points that do not stay what they are there
};

void add_changes(const LabelSpectrum& spectrum, std::size_t point,
                 const std::array<Window, candidates>& windows, Changes& changes) {
  const std::size_t first = spectrum.offsets[point];
  const std::size_t last = spectrum.offsets[point + 1];
  const bool always_one = last - first == 1;
  if (always_one && !is_feature(spectrum.kind[first])) return;
  for (std::size_t c = 0; c < candidates; ++c) {
    const std::size_t from = step_at(spectrum, point, windows[c].low);
    const std::size_t to = step_at(spectrum, point, windows[c].high);
    const bool is_feature_there = is_feature(spectrum.kind[from]);
    bool stays = true;
    for (std::size_t s = from + 1; s <= to; ++s) stays &= is_feature(spectrum.kind[s]) == is_feature_there;
    changes.features[c] += is_feature_there ? 1U : 0U;
    changes.changing[c] += stays ? 0U : 1U;
  }
}

}  // namespace

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

std::uint16_t local_sensitivity(const LabelSpectrum& spectrum, std::size_t point) {
  static const std::uint16_t lowest = sensitivity_of(8);
  static const std::uint16_t highest = sensitivity_of(45);
  const std::size_t last = step_at(spectrum, point, highest);
  double widest = 0;
  double range_begin = lowest;
  double step_begin = lowest;
  double sensitivity = highest;
  for (std::size_t s = step_at(spectrum, point, lowest); s <= last; ++s) {
    const double end = s == last ? highest : spectrum.from[s + 1];
    if (s == last || spectrum.kind[s + 1] != spectrum.kind[s]) {
      if (end / range_begin >= widest) {
        widest = end / range_begin;
        sensitivity = (step_begin + end) / 2;
      }
      range_begin = end;
    }
    step_begin = end;
  }
  return static_cast<std::uint16_t>(sensitivity);
}

FeatureLabels relabel_locally(const LabelSpectrum& spectrum) {
  FeatureLabels labels;
  labels.kind.resize(spectrum.size());
  labels.clusters.resize(spectrum.size());
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const std::size_t step = step_at(spectrum, i, local_sensitivity(spectrum, i));
    labels.kind[i] = spectrum.kind[step];
    labels.clusters[i] = spectrum.clusters[step];
  }
  return labels;
}

double choose_sigma(const LabelSpectrum& spectrum, Progress& progress) {
  constexpr double tolerated_change = 0.02;
  constexpr std::size_t block_size = 1 << 14;
  const std::array<Window, candidates> windows = candidate_windows();
  const Changes changes = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, spectrum.size(), block_size), Changes{},
      [&](const tbb::blocked_range<std::size_t>& range, Changes sum) {
        progress.check();
        for (std::size_t i = range.begin(); i < range.end(); ++i) add_changes(spectrum, i, windows, sum);
        return sum;
      },
      [](Changes a, const Changes& b) {
        for (std::size_t c = 0; c < candidates; ++c) {
          a.changing[c] += b.changing[c];
          a.features[c] += b.features[c];
        }
        return a;
      });
  const bool sees_features = std::any_of(changes.features.begin(), changes.features.end(),
                                         [](std::size_t features) { return features > 0; });
  if (!sees_features) return default_sigma_deg;

  // The share of the whole keeps a sensitivity that sees nothing at all from looking perfectly stable.
  std::array<double, candidates> change;
  for (std::size_t c = 0; c < candidates; ++c)
    change[c] = static_cast<double>(changes.changing[c] + 1) /
                (static_cast<double>(changes.features[c]) + 0.01 * static_cast<double>(spectrum.size()) + 1);
  // One that sees next to nothing may be stable because of that. Where others see something that stays, it is
  // out of the question.
  std::size_t most_that_stay = 0;
  for (std::size_t c = 0; c < candidates; ++c)
    if (5 * changes.changing[c] <= changes.features[c])
      most_that_stay = std::max(most_that_stay, changes.features[c]);
  const auto sees_enough = [&](std::size_t c) { return 4 * changes.features[c] >= most_that_stay; };
  // The largest of those that are about as stable as the best: it asks most of an edge for the same result.
  double best = 1;
  for (std::size_t c = 0; c < candidates; ++c)
    if (sees_enough(c)) best = std::min(best, change[c]);
  std::size_t chosen = candidates - 1;
  while (!sees_enough(chosen) || change[chosen] > best + tolerated_change) --chosen;
  return candidate_deg(chosen);
}

FeatureLabels relabel(const LabelSpectrum& spectrum, SigmaRule rule, double sigma_deg, Progress& progress) {
  switch (rule) {
    case SigmaRule::Given: return relabel(spectrum, sigma_deg);
    case SigmaRule::Auto: return relabel(spectrum, choose_sigma(spectrum, progress));
    case SigmaRule::Local: return relabel_locally(spectrum);
  }
  return {};
}

}  // namespace keenline
