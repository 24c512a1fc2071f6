#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

struct Source;

enum class PlyEncoding : std::uint8_t { Ascii, LittleEndian, BigEndian };

/// "ascii 1.0", "binary little endian 1.0", "binary big endian 1.0".
[[nodiscard]] std::string_view name_of(PlyEncoding encoding);

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::Float32;
  std::optional<ScalarType> count_type;  ///< how the length is stored, when the property is a list
  std::uint64_t line = 0;                ///< that declares it
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;  ///< as declared: not yet held against the file's size
  std::vector<PlyProperty> properties;
  std::uint64_t line = 0;  ///< that declares it

  [[nodiscard]] bool has_lists() const;
  /// nullptr when there is none of that name.
  [[nodiscard]] const PlyProperty* property(std::string_view wanted) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;   ///< names are unique; so are those of the properties of each
  std::vector<std::string> comments;  ///< text of comment lines; "obj_info " and text of obj_info lines
  std::size_t size = 0;               ///< bytes up to the first row
  std::uint64_t lines = 0;            ///< lines up to the first row
};

/// \throw InputError for anything that is not exactly understood, or when the header is longer than
/// longest_ply_header.
[[nodiscard]] PlyHeader read_ply_header(const Source& source);

/// The word that PLY headers have for a type: "uchar", "float", … \pre not a 64-bit integer
[[nodiscard]] std::string_view ply_type_name(ScalarType type);

/// Longest header that is read.
inline constexpr std::size_t longest_ply_header = std::size_t{32} << 20;

}  // namespace keenline
