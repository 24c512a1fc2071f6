#pragma once

#include "keenline/io/formats.h"

namespace keenline {

/// OBJ: Wavefront. Vertices are the points; "v x y z w" keeps w, "v x y z red green blue" the colours, as
/// attributes. Faces are the table "face", polylines the table "line". Texture coordinates, normals,
/// materials and curves are skipped, which is noted; what follows the keyword in such lines is not examined.
[[nodiscard]] Reading read_obj(const Source& source, Progress& progress);
/// Weak when the first line outside comments begins with an OBJ keyword.
[[nodiscard]] Format::Match match_obj(const Source& source);

}  // namespace keenline
