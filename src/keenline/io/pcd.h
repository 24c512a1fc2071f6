#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// PCD: Point Cloud Library, ascii, binary and binary_compressed.
[[nodiscard]] Reading read_pcd(const Source& source, Progress& progress);
[[nodiscard]] Format::Match match_pcd(const Source& source);

}  // namespace keenline
