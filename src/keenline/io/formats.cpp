#include "keenline/io/formats.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/io/las.h"
#include "keenline/io/obj.h"
#include "keenline/io/off.h"
#include "keenline/io/pcd.h"
#include "keenline/io/ply.h"
#include "keenline/io/source.h"
#include "keenline/io/stl.h"
#include "keenline/io/xyz.h"

namespace keenline {
namespace {

using Match = Format::Match;

constexpr std::array<std::string_view, 1> ply_extensions{"ply"};
constexpr std::array<std::string_view, 1> pcd_extensions{"pcd"};
constexpr std::array<std::string_view, 1> las_extensions{"las"};
constexpr std::array<std::string_view, 5> off_extensions{"off", "coff", "noff", "cnoff", "stoff"};
constexpr std::array<std::string_view, 1> stl_extensions{"stl"};
constexpr std::array<std::string_view, 1> obj_extensions{"obj"};
constexpr std::array<std::string_view, 6> xyz_extensions{"xyz", "txt", "csv", "asc", "pts", "pwn"};

// A binary STL is known by its size; its title may begin with any word, "OFF" and "VERSION" too. So it comes
// first.
constexpr std::array table{
    Format{"stl", "Stereolithography: ascii and binary", stl_extensions, match_stl, read_stl},
    Format{"ply", "Polygon file format: ascii, binary little and big endian", ply_extensions, match_ply,
           read_ply},
    Format{"pcd", "Point Cloud Library: ascii, binary, binary_compressed", pcd_extensions, match_pcd,
           read_pcd},
    Format{"las", "LAS 1.0 to 1.4, uncompressed, point formats 0 to 10", las_extensions, match_las, read_las},
    Format{"off", "Object file format (OFF, NOFF, COFF, …)", off_extensions, match_off, read_off},
    Format{"obj", "Wavefront OBJ", obj_extensions, match_obj, read_obj},
    Format{"xyz", "Delimited text: XYZ, TXT, CSV", xyz_extensions, match_xyz, read_xyz},
};

std::string extension_of(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  const std::string_view name = slash == std::string_view::npos ? path : path.substr(slash + 1);
  const std::size_t dot = name.rfind('.');
  std::string extension(dot == std::string_view::npos ? std::string_view() : name.substr(dot + 1));
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return extension;
}

}  // namespace

std::span<const Format> formats() { return table; }

const Format& find_format(const Source& source) {
  const auto with_match = [&](Match wanted) {
    return std::find_if(table.begin(), table.end(),
                        [&](const Format& f) { return f.match(source) == wanted; });
  };
  if (const auto found = with_match(Match::Strong); found != table.end()) return *found;
  const std::string extension = extension_of(source.name);
  for (const Format& format : table)
    if (std::find(format.extensions.begin(), format.extensions.end(), extension) != format.extensions.end())
      return format;
  if (const auto found = with_match(Match::Weak); found != table.end()) return *found;

  std::vector<std::string_view> names;
  names.reserve(table.size());
  for (const Format& format : table) names.push_back(format.name);
  throw InputError(source.name, Place::byte(0),
                   source.bytes.empty() ? "an empty file" : quoted(source.bytes.substr(0, 16)),
                   fmt::format("one of the formats {}", fmt::join(names, ", ")));
}

}  // namespace keenline
