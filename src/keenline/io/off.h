#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// OFF: object file format (Geomview), ascii, with optional normals (nx ny nz), colours (red green blue
/// [alpha]), texture coordinates (s t) and homogeneous coordinate (w) per vertex. One vertex, one face per
/// line. Colours are uint8 when all of them are integers from 0 to 255, else float64. More columns of a plain
/// OFF are column_4, column_5, …; faces are the table "face", without their colours. \throw InputError also
/// for binary OFF and for OFF with other than 3 dimensions.
[[nodiscard]] Reading read_off(const Source& source, Progress& progress);
/// Strong when the first word outside comments is a header word such as OFF or COFF.
[[nodiscard]] Format::Match match_off(const Source& source);

}  // namespace keenline
