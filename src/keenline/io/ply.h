#pragma once

#include <string>
#include <vector>

#include "keenline/io/formats.h"

namespace keenline {

class Sink;

/// PLY: polygon file format (Stanford), ascii, little and big endian. The scalars x, y, z of element "vertex"
/// are the points; its other properties are attributes; every other element is a table.
[[nodiscard]] Reading read_ply(const Source& source, Progress& progress);
[[nodiscard]] Format::Match match_ply(const Source& source);

/// Binary little endian PLY: x, y, z in their original types, all attributes, tables and comments.
/// Returns notes: what PLY could not hold as it was (64-bit integers, names with blanks).
/// \throw InvalidArgument when columns are not as long as their table; OutputError; Cancelled.
std::vector<std::string> write_ply(const PointCloud& cloud, Sink& sink, Progress& progress);

}  // namespace keenline
