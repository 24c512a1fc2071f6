#pragma once

#include <cstdint>

#include "keenline/labels.h"

namespace keenline {

/// A sensitivity in whole units of 1/728 degree, rounded down: what labels depend on.
/// \throw InvalidArgument unless 0 < sigma_deg <= 90
[[nodiscard]] std::uint16_t sensitivity_of(double sigma_deg);

/// The labels of a spectrum at one sensitivity: exactly those of a fresh run with it. The scores, which
/// depend on no sensitivity, are left empty. Cost: O(steps).
/// \throw InvalidArgument unless 0 < sigma_deg <= 90
[[nodiscard]] FeatureLabels relabel(const LabelSpectrum& spectrum, double sigma_deg);

/// Index of the step that holds for `point` at `sensitivity`.
[[nodiscard]] std::size_t step_at(const LabelSpectrum& spectrum, std::size_t point,
                                  std::uint16_t sensitivity);

/// The paper's sensitivity, in degrees.
inline constexpr double default_sigma_deg = 20;

/// One sensitivity for the whole cloud, in degrees, among multiples of 90/64 from 9.8 to 45: the largest of
/// those around which few labels depend on its exact value. For each, points that are sharp somewhere and not
/// sharp elsewhere between four fifths and five quarters of it are counted, in proportion to the sharp
/// points; those within 0.02 of the smallest share are alike. default_sigma_deg where nothing is sharp at any
/// of them. Stable, because it is chosen where the labels are. Cost: 26 passes over the steps.
[[nodiscard]] double choose_sigma(const LabelSpectrum& spectrum);

}  // namespace keenline
