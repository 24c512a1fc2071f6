#pragma once

#include <cstdint>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

/// Who chooses the sensitivity.
enum class SigmaRule : std::uint8_t {
  Given,  ///< the caller
  Auto,   ///< one for the whole cloud: choose_sigma()
  Local,  ///< one for every point: relabel_locally()
};

/// A sensitivity in whole units of 1/728 degree, rounded down: what labels depend on.
/// \throw InvalidArgument unless 0 < sigma_deg <= 90
[[nodiscard]] std::uint16_t sensitivity_of(double sigma_deg);

/// The labels of a spectrum at one sensitivity: exactly those of a fresh run with it. The scores, which
/// depend on no sensitivity, are left empty. Cost: O(steps).
/// \throw InvalidArgument unless 0 < sigma_deg <= 90
[[nodiscard]] FeatureLabels relabel(const LabelSpectrum& spectrum, double sigma_deg);

/// The sensitivity of one point by persistence: its kind stays the same over the widest range there, as a
/// ratio, between 8 and 45 degrees; of equally wide ranges the higher one.
[[nodiscard]] std::uint16_t local_sensitivity(const LabelSpectrum& spectrum, std::size_t point);

/// The labels of a spectrum, every point at its local_sensitivity(). For clouds in which sharp and blunt
/// edges lie side by side. The scores are left empty, sigma_deg is 0. Cost: O(steps).
[[nodiscard]] FeatureLabels relabel_locally(const LabelSpectrum& spectrum);

/// Index of the step that holds for `point` at `sensitivity`.
[[nodiscard]] std::size_t step_at(const LabelSpectrum& spectrum, std::size_t point,
                                  std::uint16_t sensitivity);

/// The paper's sensitivity, in degrees.
inline constexpr double default_sigma_deg = 20;

/// One sensitivity for the whole cloud, in degrees, among multiples of 90/64 from 9.8 to 45: the largest of
/// those around which few labels depend on its exact value. For each, points that are sharp somewhere and not
/// sharp elsewhere between four fifths and five quarters of it are counted, in proportion to the sharp
/// points; those within 0.02 of the smallest share are alike. Where a fifth of the sharp points or less are
/// such, at least a quarter of them must still be sharp. default_sigma_deg where nothing is sharp at any of
/// them. Stable, because it is chosen where the labels are. Threads: any number, same result. Cost: 26
/// looks at the steps of every point. \throw Cancelled
[[nodiscard]] double choose_sigma(const LabelSpectrum& spectrum, Progress& progress = no_progress());

/// The labels by one of the three rules; sigma_deg is used with SigmaRule::Given. \throw as the three
[[nodiscard]] FeatureLabels relabel(const LabelSpectrum& spectrum, SigmaRule rule, double sigma_deg,
                                    Progress& progress = no_progress());

}  // namespace keenline
