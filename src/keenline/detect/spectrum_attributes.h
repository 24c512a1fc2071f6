#pragma once

#include <string>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"

namespace keenline {

/// How a cloud, and with it a file, holds the labels of all sensitivities: three list attributes with one
/// value per step. spectrum_from (uint16, units of 1/728 degree), spectrum_kind (uint8) and
/// spectrum_clusters (uint8). One comment, "keenline sigma DEG", says which of them the labels beside hold.
/// \throw InvalidArgument when the vectors of the spectrum do not match.
[[nodiscard]] std::vector<Column> spectrum_columns(const LabelSpectrum& spectrum);

/// The spectrum that the cloud holds, whoever wrote it: attributes may have any integer type.
/// \throw InvalidArgument naming the attribute, and the point from 0, unless every list has the same length
/// >= 1 in all three, sensitivities rise from 0 to 65520 at most, and kinds are known.
[[nodiscard]] LabelSpectrum spectrum_of(const PointCloud& cloud);

/// Takes the spectrum and its comment out of the cloud; returns the names of the attributes that were there.
std::vector<std::string> remove_spectrum(PointCloud& cloud);

/// 0 degrees: "local", a choice per point. Replaces the comment about the sensitivity where there is one,
/// adds it elsewhere.
void set_sigma_comment(PointCloud& cloud, double sigma_deg);

}  // namespace keenline
