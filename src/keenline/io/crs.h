#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "keenline/cloud.h"

namespace keenline {

// What a file says of its coordinate reference system goes along as a comment of the cloud: "crs_epsg CODE"
// or "crs_wkt TEXT", on one line.

/// The EPSG code in a GeoTIFF key directory, as LAS files hold it (record 34735, little endian): that of the
/// projected system, else of the geographic one. Nothing when there is no such code, or it is not understood.
[[nodiscard]] std::optional<int> epsg_of_geotiff_keys(std::string_view directory);

/// The EPSG code that a well-known text gives itself as a whole (AUTHORITY or ID of its outermost brackets);
/// of a compound system without one, that of nothing: its parts are not it.
[[nodiscard]] std::optional<int> epsg_of_wkt(std::string_view wkt);

/// "EPSG:25832" where the code is known, else the well-known text, else empty: FeatureGraph::crs.
[[nodiscard]] std::string crs_of(const PointCloud& cloud);

}  // namespace keenline
