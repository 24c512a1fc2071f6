#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// STL: ascii and binary. Equal corners of triangles become one point, in the order of first appearance; the
/// triangles are the table "face". A file is binary when its size says so, whatever it begins with. A binary
/// file's attribute words are the column "attribute" of that table unless all of them are 0.
[[nodiscard]] Reading read_stl(const Source& source, Progress& progress);
/// Strong when the size is that of a binary STL with at least one triangle, or "solid" is followed by a line
/// with "facet" or "endsolid".
[[nodiscard]] Format::Match match_stl(const Source& source);

}  // namespace keenline
