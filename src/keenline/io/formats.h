#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

class Progress;
struct Source;

/// What a reader made of a file.
struct Reading {
  PointCloud cloud;
  std::string format;              ///< name in the table of formats: "ply"
  std::string encoding;            ///< which variant: "binary little endian 1.0"
  std::vector<std::string> notes;  ///< what a user should know: what was skipped or merged, one line each
};

/// One row of the table of formats.
struct Format {
  std::string_view name;                         ///< "ply"
  std::string_view summary;                      ///< "Polygon file format, ascii and binary"
  std::span<const std::string_view> extensions;  ///< lower case, without dot
  /// How sure the first bytes of a file make one that it is of this format.
  enum class Match { No, Weak, Strong };
  Match (*match)(const Source& source);
  /// \throw InputError on anything that is not exactly understood; Cancelled.
  Reading (*read)(const Source& source, Progress& progress);
};

/// All formats that can be read, in the order in which their signatures are tried.
[[nodiscard]] std::span<const Format> formats();

/// Strong signature, else extension, else weak signature. \throw InputError when none fits.
[[nodiscard]] const Format& find_format(const Source& source);

}  // namespace keenline
