#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace keenline {

struct Source;

/// A variable length record of a LAS file.
struct LasRecord {
  std::string_view user_id;  ///< "LASF_Projection"
  std::uint16_t id = 0;
  std::string_view data;
  std::size_t data_start = 0;  ///< in the file
};

/// What stands around the points of a LAS file; all of it lies within the file.
struct LasHeader {
  unsigned minor_version = 0;  ///< 0 to 4: LAS 1.0 to 1.4
  unsigned point_format = 0;   ///< 0 to 10
  std::size_t record_length = 0;
  std::size_t points_start = 0;
  std::uint64_t point_count = 0;
  std::array<double, 3> scale{};   ///< finite, not 0
  std::array<double, 3> offset{};  ///< finite
  std::vector<LasRecord> records;  ///< before the points, then behind them
};

/// Bytes of a point of this format, without extra bytes. \pre format <= 10
[[nodiscard]] std::size_t las_point_size(unsigned format);

/// \throw InputError for what is not LAS 1.0 to 1.4, compressed, or contradicts itself or the size of the
/// file.
[[nodiscard]] LasHeader read_las_header(const Source& source);

}  // namespace keenline
