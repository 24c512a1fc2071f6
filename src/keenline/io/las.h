#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// LAS 1.0 to 1.4, uncompressed, point formats 0 to 10.
[[nodiscard]] Reading read_las(const Source& source, Progress& progress);
[[nodiscard]] Format::Match match_las(const Source& source);

}  // namespace keenline
