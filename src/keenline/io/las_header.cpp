#include "keenline/io/las_header.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/io/records.h"
#include "keenline/io/source.h"

namespace keenline {
namespace {

// Offsets in the public header block; LAS 1.4 specification R15, table 3.
constexpr std::size_t global_encoding_at = 6;
constexpr std::size_t version_at = 24;
constexpr std::size_t header_size_at = 94;
constexpr std::size_t points_start_at = 96;
constexpr std::size_t record_count_at = 100;
constexpr std::size_t point_format_at = 104;
constexpr std::size_t record_length_at = 105;
constexpr std::size_t legacy_count_at = 107;
constexpr std::size_t scale_at = 131;
constexpr std::size_t offset_at = 155;
constexpr std::size_t waveform_start_at = 227;
constexpr std::size_t extended_start_at = 235;
constexpr std::size_t extended_count_at = 243;
constexpr std::size_t point_count_at = 247;

constexpr std::array<std::size_t, 5> header_sizes{227, 227, 227, 235, 375};  // by minor version

/// How the two kinds of variable length records store their length; before it stand 2 + 16 + 2 bytes.
struct RecordLayout {
  std::size_t header_size;
  bool long_length;
};
constexpr RecordLayout ordinary{54, false};
constexpr RecordLayout extended{60, true};

constexpr std::string_view compressed = "LAZ-compressed points";
constexpr std::string_view expected_uncompressed =
    "uncompressed LAS (decompress it first, e.g. with laszip or PDAL)";

class HeaderParser {
 public:
  explicit HeaderParser(const Source& source) : source_(source), size_(source.bytes.size()) {}

  LasHeader parse() {
    parse_version();
    parse_layout();
    parse_transform();
    read_records(ordinary, header_size_, at<std::uint32_t>(record_count_at), header_.points_start);
    for (const LasRecord& record : header_.records)
      if (record.user_id == "laszip encoded") refuse(record.data_start, compressed, expected_uncompressed);
    parse_count();
    parse_behind_points();
    return std::move(header_);
  }

 private:
  template <typename T>
  [[nodiscard]] T at(std::size_t offset) const {
    return load<T>(source_.bytes.data() + offset);
  }

  [[noreturn]] void refuse(std::size_t byte, std::string_view found, std::string_view expected) const {
    throw InputError(source_.name, Place::byte(byte), found, expected);
  }

  void require_header(std::size_t size) const {
    if (size_ < size) {
      refuse(size_, size_ == 0 ? "an empty file" : "the end of the file",
             fmt::format("a LAS header of {} bytes", size));
    }
  }

  void parse_version() {
    if (!source_.bytes.starts_with(std::string_view("LASF").substr(0, std::min<std::size_t>(4, size_))))
      refuse(0, quoted(source_.bytes.substr(0, 4)), "'LASF'");
    require_header(header_sizes[0]);
    const unsigned major = at<std::uint8_t>(version_at);
    header_.minor_version = at<std::uint8_t>(version_at + 1);
    if (major != 1 || header_.minor_version > 4)
      refuse(version_at, fmt::format("LAS version {}.{}", major, header_.minor_version), "1.0 to 1.4");
    const std::size_t smallest = header_sizes[header_.minor_version];
    require_header(smallest);
    header_size_ = at<std::uint16_t>(header_size_at);
    if (header_size_ < smallest) {
      refuse(header_size_at, fmt::format("a header size of {} bytes", header_size_),
             fmt::format("at least {} for LAS 1.{}", smallest, header_.minor_version));
    }
    require_header(header_size_);
  }

  void parse_layout() {
    const unsigned format = at<std::uint8_t>(point_format_at);
    // LASzip marks its files in the highest bits, which no point format reaches.
    if (format >= 64) refuse(point_format_at, compressed, expected_uncompressed);
    if (format > 10) refuse(point_format_at, fmt::format("point format {}", format), "0 to 10");
    header_.point_format = format;
    header_.record_length = at<std::uint16_t>(record_length_at);
    if (header_.record_length < las_point_size(format)) {
      refuse(record_length_at, fmt::format("points of {} bytes", header_.record_length),
             fmt::format("at least {} for point format {}", las_point_size(format), format));
    }
    header_.points_start = at<std::uint32_t>(points_start_at);
    if (header_.points_start < header_size_) {
      refuse(points_start_at, fmt::format("points that start at byte {}", header_.points_start),
             fmt::format("a place behind the header of {} bytes", header_size_));
    }
    if (header_.points_start > size_) {
      refuse(points_start_at, fmt::format("points that start at byte {}", header_.points_start),
             fmt::format("a place within the file of {} bytes", size_));
    }
  }

  void parse_transform() {
    for (std::size_t d = 0; d < 3; ++d) {
      const double scale = header_.scale[d] = at<double>(scale_at + d * sizeof(double));
      const double offset = header_.offset[d] = at<double>(offset_at + d * sizeof(double));
      if (!std::isfinite(scale) || scale == 0) {
        refuse(scale_at + d * sizeof(double), fmt::format("a coordinate scale of {}", scale),
               "a finite number other than 0");
      }
      if (!std::isfinite(offset)) {
        refuse(offset_at + d * sizeof(double), fmt::format("a coordinate offset of {}", offset),
               "a finite number");
      }
      constexpr double largest_integer = 2147483648.0;
      if (!std::isfinite(std::abs(scale) * largest_integer + std::abs(offset))) {
        refuse(scale_at + d * sizeof(double),
               fmt::format("a coordinate scale of {} with offset {}", scale, offset),
               "coordinates that a double can hold");
      }
    }
  }

  /// Appends `count` records that begin at `start`; all must end by `end`. Returns where the last one ends.
  std::size_t read_records(const RecordLayout& layout, std::size_t start, std::uint64_t count,
                           std::size_t end) {
    constexpr std::size_t user_id_at = 2;
    constexpr std::size_t id_at = 18;
    constexpr std::size_t length_at = 20;
    // Real files have a handful; a sparse one holds a billion empty ones.
    constexpr std::size_t most_records = std::size_t{1} << 20U;
    const std::size_t room = std::min((end - start) / layout.header_size, most_records);
    if (count > room) {
      refuse(layout.long_length ? extended_count_at : record_count_at,
             fmt::format("{} variable length records", count),
             fmt::format("at most {} between bytes {} and {}", room, start, end));
    }
    for (std::uint64_t i = 0; i < count; ++i) {
      if (end - start < layout.header_size) {
        refuse(start, fmt::format("the end of the records at byte {}", end),
               fmt::format("variable length record {} of {}", i + 1, count));
      }
      const std::uint64_t length =
          layout.long_length ? at<std::uint64_t>(start + length_at) : at<std::uint16_t>(start + length_at);
      const std::size_t data_start = start + layout.header_size;
      if (length > end - data_start) {
        refuse(start + length_at, fmt::format("a variable length record of {} bytes", length),
               fmt::format("at most {}", end - data_start));
      }
      const std::string_view user_id = source_.bytes.substr(start + user_id_at, id_at - user_id_at);
      header_.records.push_back({user_id.substr(0, user_id.find('\0')), at<std::uint16_t>(start + id_at),
                                 source_.bytes.substr(data_start, length), data_start});
      start = data_start + length;
    }
    return start;
  }

  void parse_count() {
    header_.point_count = at<std::uint32_t>(legacy_count_at);
    std::size_t count_at = legacy_count_at;
    if (header_.minor_version >= 4) {
      const std::uint64_t count = at<std::uint64_t>(point_count_at);
      if (count != 0 && header_.point_count != 0 && count != header_.point_count) {
        refuse(point_count_at,
               fmt::format("{} points, while the count at byte {} is {}", count, legacy_count_at,
                           header_.point_count),
               "the same number");
      }
      // Many writers of 1.4 fill in the older count only.
      if (count != 0) {
        header_.point_count = count;
        count_at = point_count_at;
      }
    }
    const std::size_t room = (size_ - header_.points_start) / header_.record_length;
    if (header_.point_count > room) {
      refuse(size_, fmt::format("the end of the file after {} points", room),
             fmt::format("{} points of {} bytes", header_.point_count, header_.record_length));
    }
    if (header_.point_count > max_points)
      refuse(count_at, fmt::format("{} points", header_.point_count), fmt::format("at most {}", max_points));
  }

  /// Behind the points may stand waveforms (from 1.3) and extended records (1.4). Anything else that is long
  /// enough to be a point means that the count is wrong.
  void parse_behind_points() {
    const std::size_t points_end = header_.points_start + header_.point_count * header_.record_length;
    const std::size_t waveforms = header_.minor_version >= 3 ? waveforms_start(points_end) : size_;
    std::size_t first_other = waveforms;
    const std::uint64_t count = header_.minor_version >= 4 ? at<std::uint32_t>(extended_count_at) : 0;
    if (count > 0) {
      const std::uint64_t start = at<std::uint64_t>(extended_start_at);
      require_behind_points(extended_start_at, start, points_end);
      first_other = std::min<std::size_t>(first_other, start);
      const std::size_t end = read_records(extended, start, count, size_);
      require_no_more_points(end, waveforms > end ? waveforms : size_);
    }
    require_no_more_points(points_end, first_other);
  }

  /// Where waveforms begin behind the points; the end of the file when there are none.
  [[nodiscard]] std::size_t waveforms_start(std::size_t points_end) const {
    constexpr unsigned waveforms_inside = 2;
    const std::uint64_t start = at<std::uint64_t>(waveform_start_at);
    // Without the flag the number may be left over from anything.
    if (start != 0 && (at<std::uint16_t>(global_encoding_at) & waveforms_inside) != 0)
      require_behind_points(waveform_start_at, start, points_end);
    return start >= points_end && start < size_ ? static_cast<std::size_t>(start) : size_;
  }

  void require_behind_points(std::size_t field, std::uint64_t start, std::size_t points_end) const {
    if (start < points_end || start > size_) {
      refuse(field, fmt::format("data behind the points that start at byte {}", start),
             fmt::format("a place between bytes {} and {}", points_end, size_));
    }
  }

  void require_no_more_points(std::size_t begin, std::size_t end) const {
    const std::size_t more = (end - begin) / header_.record_length;
    if (more > 0) {
      refuse(begin, fmt::format("{} bytes more, room for {} more points", end - begin, more),
             fmt::format("{} points, as the header says", header_.point_count));
    }
  }

  const Source& source_;
  std::size_t size_;
  std::size_t header_size_ = 0;
  LasHeader header_;
};

}  // namespace

LasHeader read_las_header(const Source& source) { return HeaderParser(source).parse(); }

}  // namespace keenline
