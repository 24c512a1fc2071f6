#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

struct Source;

/// One field of a PCD record: `count` numbers of one type.
struct PcdField {
  std::string name;
  ScalarType type = ScalarType::Float32;
  std::size_t count = 1;

  [[nodiscard]] std::size_t size() const { return count * size_of(type); }
  [[nodiscard]] bool is_padding() const { return name == "_"; }
};

enum class PcdEncoding : std::uint8_t { Ascii, Binary, BinaryCompressed };

/// What the header of a PCD file says, checked for consistency but not against the data.
struct PcdHeader {
  std::string version;           ///< "0.7"; empty when the file does not say
  std::vector<PcdField> fields;  ///< names other than "_" are unique; x, y and z are there with count 1
  std::size_t record_bytes = 0;  ///< of one point, at most 1 MiB
  std::size_t record_values = 0;
  std::uint64_t points = 0;
  std::uint64_t points_line = 0;  ///< that says how many points there are
  std::uint64_t width = 0;
  std::uint64_t height = 1;
  PcdEncoding encoding = PcdEncoding::Ascii;
  std::vector<std::string> comments;  ///< and the viewpoint, unless it is the default
  std::size_t body_offset = 0;        ///< byte in the file
  std::uint64_t body_line = 0;
};

/// \throw InputError
[[nodiscard]] PcdHeader read_pcd_header(const Source& source);

}  // namespace keenline
