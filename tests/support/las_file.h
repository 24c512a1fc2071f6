#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "support/bytes.h"

namespace keenline::test {

/// Sizes from the tables of the LAS 1.4 specification, by point format and by minor version.
inline constexpr std::array<std::uint16_t, 11> las_point_sizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
inline constexpr std::array<std::uint16_t, 5> las_header_sizes{227, 227, 227, 235, 375};

/// Puts a LAS file together: header, variable length records, points, and whatever else is added behind them.
class LasFile {
 public:
  LasFile(unsigned minor, unsigned format, std::uint16_t extra_bytes = 0) : minor_(minor) {
    const std::uint16_t header_size = las_header_sizes[minor];
    record_length_ = static_cast<std::uint16_t>(las_point_sizes[format] + extra_bytes);
    bytes_ = Bytes(std::string(header_size, '\0'));
    bytes_.put(0, std::string_view("LASF"))
        .put(24, std::uint8_t{1})
        .put(25, static_cast<std::uint8_t>(minor));
    bytes_.put(94, header_size).put(96, std::uint32_t{header_size});
    bytes_.put(104, static_cast<std::uint8_t>(format)).put(105, record_length_);
    for (std::size_t d = 0; d < 3; ++d)
      bytes_.put(131 + 8 * d, 0.01).put(155 + 8 * d, 1000.0 * static_cast<double>(d));
  }

  /// Before the first point.
  LasFile& add_record(std::string_view user_id, std::uint16_t id, std::string_view data) {
    const std::size_t start = bytes_.size();
    bytes_.text(std::string(54, '\0')).put(start + 2, user_id).put(start + 18, id);
    bytes_.put(start + 20, static_cast<std::uint16_t>(data.size())).text(data);
    bytes_.put(96, static_cast<std::uint32_t>(bytes_.size())).put(100, ++records_);
    return *this;
  }

  /// All bytes of one point.
  LasFile& add_point(std::string_view point) {
    bytes_.text(point).put(107, ++points_);
    return *this;
  }
  /// A point whose coordinates are stored as x, y, z and whose other bytes are 0.
  LasFile& add_point(std::int32_t x, std::int32_t y, std::int32_t z) {
    return add_point(Bytes(std::string(record_length_, '\0')).put(0, x).put(4, y).put(8, z).str());
  }

  /// Behind the last point; LAS 1.4.
  LasFile& add_extended_record(std::string_view user_id, std::uint16_t id, std::string_view data) {
    const std::size_t start = bytes_.size();
    if (extended_records_ == 0) bytes_.put(235, std::uint64_t{start});
    bytes_.text(std::string(60, '\0')).put(start + 2, user_id).put(start + 18, id);
    bytes_.put(start + 20, std::uint64_t{data.size()}).text(data);
    bytes_.put(243, ++extended_records_);
    return *this;
  }

  /// To spoil it.
  [[nodiscard]] Bytes& bytes() { return bytes_; }
  [[nodiscard]] const std::string& str() const { return bytes_.str(); }
  [[nodiscard]] unsigned minor_version() const { return minor_; }

 private:
  Bytes bytes_;
  unsigned minor_;
  std::uint16_t record_length_ = 0;
  std::uint32_t records_ = 0;
  std::uint32_t points_ = 0;
  std::uint32_t extended_records_ = 0;
};

/// One description in an Extra Bytes record; scale and offset are marked as used when they are not 1 and 0.
inline std::string las_extra_dimension(std::string_view name, std::uint8_t type, double scale = 1,
                                       double offset = 0) {
  Bytes bytes(std::string(192, '\0'));
  bytes.put(2, type).put(4, name);
  bytes.put(3, static_cast<std::uint8_t>((scale != 1 ? 8 : 0) + (offset != 0 ? 16 : 0)));
  for (std::size_t k = 0; k < 3; ++k) bytes.put(112 + 8 * k, scale).put(136 + 8 * k, offset);
  return bytes.str();
}

}  // namespace keenline::test
