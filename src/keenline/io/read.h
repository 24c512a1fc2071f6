#pragma once

#include <string>

#include "keenline/io/formats.h"
#include "keenline/progress.h"

namespace keenline {

/// Reads a point cloud; the format is chosen by content, then by extension.
/// Coordinates are doubles; every attribute keeps its type; the order of points is the file's.
/// Memory: bounded by a multiple of the file's size, whatever its header claims.
/// \throw InputError when the file cannot be opened or is not exactly understood; OutOfMemory; Cancelled.
[[nodiscard]] Reading read_cloud(const std::string& path, Progress& progress = no_progress());

}  // namespace keenline
