#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// Delimited text: XYZ, TXT, CSV, ASC, PTS. Blanks, commas or semicolons between numbers; comments after '#'
/// or "//". A header line, or a comment line before the data, may name the columns; x, y and z are then found
/// by name (also easting, northing and elevation, height or altitude), else they are columns 1 to 3. A lone
/// integer before the data is the number of rows. Coordinates become Float64; other columns integers where
/// all values are written so.
[[nodiscard]] Reading read_xyz(const Source& source, Progress& progress);
[[nodiscard]] Format::Match match_xyz(const Source& source);

}  // namespace keenline
