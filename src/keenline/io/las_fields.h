#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

struct LasHeader;
struct Source;

/// value = stored * scale + offset, with one of each per value of a tuple.
struct LasTransform {
  std::array<double, 3> scale{1, 1, 1};
  std::array<double, 3> offset{};
};

/// One attribute of a LAS point: where it stands in the record and how its value is made.
struct LasField {
  std::string name;
  std::size_t position = 0;  ///< of its first byte in the record
  ScalarType type = ScalarType::UInt8;
  std::size_t values = 1;  ///< more than one, or `is_list`: a list column of constant length
  bool is_list = false;
  std::uint8_t shift = 0;  ///< of its bits within the byte
  std::uint8_t bits = 0;   ///< 0 = the whole value
  std::optional<LasTransform> transform;
};

/// All attributes of the points of a file, in the order of the record; the coordinates are not among them.
/// Bytes behind the standard record follow the Extra Bytes description; what it leaves over is the list
/// "extra_bytes". Tells in `notes` which names had to be changed. \throw InputError when the description
/// contradicts itself or the length of the record.
[[nodiscard]] std::vector<LasField> las_fields(const Source& source, const LasHeader& header,
                                               std::vector<std::string>& notes);

}  // namespace keenline
