#include "keenline/io/pcd.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/coordinates.h"
#include "keenline/io/lzf.h"
#include "keenline/io/pcd_header.h"
#include "keenline/io/records.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_lines.h"
#include "keenline/io/text_rows.h"
#include "keenline/io/text_split.h"
#include "keenline/memory.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};

bool is_axis(std::string_view name) { return std::find(axes.begin(), axes.end(), name) != axes.end(); }

/// Lets work be cancelled that has nothing to tell: its bytes are not those of the file.
class Silent : public Progress {
 public:
  explicit Silent(const Progress& progress) : progress_(progress) {}
  [[nodiscard]] bool cancelled() const override { return progress_.cancelled(); }

 private:
  const Progress& progress_;
};

/// Room for the values of a field: zeros; lists of one length where it has a count.
Column empty_column(const PcdField& field, std::size_t points) {
  if (field.count == 1) return {field.name, field.type, points};
  const ScalarType count_type = field.count <= 0xFF     ? ScalarType::UInt8
                                : field.count <= 0xFFFF ? ScalarType::UInt16
                                                        : ScalarType::UInt32;
  std::vector<std::uint64_t> offsets(points + 1);
  for (std::size_t i = 0; i <= points; ++i) offsets[i] = i * field.count;
  return {field.name, field.type, count_type, std::move(offsets),
          std::vector<std::byte>(points * field.size())};
}

class Body {
 public:
  Body(const Source& source, const PcdHeader& header, Progress& progress)
      : source_(source),
        header_(header),
        progress_(progress),
        bytes_(source.bytes.substr(header.body_offset)) {}

  /// One column per field that is no padding.
  std::vector<Column> read() {
    if (header_.encoding == PcdEncoding::Ascii) return read_ascii();
    if (header_.encoding == PcdEncoding::Binary) return read_binary();
    return read_compressed();
  }

 private:
  [[nodiscard]] Place place(std::size_t offset) const { return Place::byte(header_.body_offset + offset); }

  [[noreturn]] void refuse_short(std::uint64_t room) const {
    throw InputError(source_.name, Place::byte(source_.bytes.size()),
                     fmt::format("the end of the file, with room for at most {} points", room),
                     fmt::format("{} points, as line {} declares", header_.points, header_.points_line));
  }

  /// After the data nothing may follow but some padding: what a writer leaves of a page of memory.
  void expect_end(std::size_t offset) const {
    constexpr std::size_t longest_padding = 64 * std::size_t{1024};
    const std::string_view rest = bytes_.substr(offset);
    const std::string_view padding(" \t\r\n\0", 5);
    if (rest.size() <= longest_padding && rest.find_first_not_of(padding) == std::string_view::npos) return;
    throw InputError(source_.name, place(offset), fmt::format("{} more bytes", rest.size()),
                     fmt::format("the end of the file after {} points", header_.points));
  }

  std::vector<Column> empty_columns() const {
    require_memory(header_.points * (header_.record_bytes + sizeof(Point)), "reading points");
    std::vector<Column> columns;
    for (const PcdField& field : header_.fields)
      if (!field.is_padding()) columns.push_back(empty_column(field, header_.points));
    return columns;
  }

  std::vector<Column> read_ascii() {
    // The smallest number is one digit and what separates it from the next; the last line may lack its end.
    const std::size_t room = (bytes_.size() + 1) / (2 * header_.record_values);
    if (header_.points > room) refuse_short(room);
    if (header_.points == 0) {
      expect_end_of_rows(0, header_.body_line);
      return empty_columns();
    }
    RowFormat format;
    for (const PcdField& field : header_.fields) {
      // For messages only; a long name, as often as the longest list has numbers, would take much memory.
      format.names.insert(format.names.end(), field.count, field.name.substr(0, 64));
      format.types.insert(format.types.end(), field.count,
                          is_axis(field.name) ? parsed_coordinate_type(field.type) : field.type);
    }
    Rows rows = read_rows(source_, bytes_, header_.body_line, format, header_.points, progress_);
    expect_end_of_rows(rows.consumed, rows.next_line);
    return gather(rows.columns);
  }

  void expect_end_of_rows(std::size_t consumed, std::uint64_t next_line) const {
    TextLines lines(source_, bytes_.substr(consumed), next_line, progress_);
    for (std::string_view line; lines.next(line);) {
      if (!trimmed(line).empty()) {
        throw InputError(source_.name, Place::line(lines.number()), quoted(line),
                         fmt::format("the end of the file after {} points", header_.points));
      }
    }
  }

  /// From one column per number to one per field.
  std::vector<Column> gather(std::vector<Column>& numbers) const {
    std::vector<Column> columns;
    std::size_t first = 0;
    for (const PcdField& field : header_.fields) {
      if (!field.is_padding() && field.count == 1) {
        columns.push_back(std::move(numbers[first]));
      } else if (!field.is_padding()) {
        Column& list = columns.emplace_back(empty_column(field, header_.points));
        const std::size_t size = size_of(field.type);
        for (std::size_t k = 0; k < field.count; ++k) {
          progress_.check();
          const std::byte* from = numbers[first + k].bytes().data();
          std::byte* to = list.bytes().data() + k * size;
          for (std::size_t i = 0; i < header_.points; ++i)
            std::memcpy(to + i * field.size(), from + i * size, size);
        }
      }
      first += field.count;
    }
    return columns;
  }

  std::vector<Column> read_binary() {
    const std::size_t room = bytes_.size() / header_.record_bytes;
    if (header_.points > room) refuse_short(room);
    const std::size_t size = header_.points * header_.record_bytes;
    expect_end(size);
    std::vector<Column> columns = empty_columns();
    std::vector<RecordField> fields;
    std::size_t offset = 0;
    for (const PcdField& field : header_.fields) {
      if (!field.is_padding())
        fields.push_back({offset, field.type, field.count, columns[fields.size()].bytes().data()});
      offset += field.size();
    }
    unpack_records({bytes_.data(), header_.points, header_.record_bytes, std::endian::little}, fields,
                   progress_);
    return columns;
  }

  std::vector<Column> read_compressed() {
    constexpr std::size_t sizes_bytes = 8;
    if (header_.points == 0 && bytes_.size() < sizes_bytes) {
      expect_end(0);
      return empty_columns();
    }
    const std::vector<char> data = decompressed();
    std::vector<Column> columns = empty_columns();
    // One field after another, each with the values of all points.
    Silent silent(progress_);
    const char* values = data.data();
    std::size_t column = 0;
    for (const PcdField& field : header_.fields) {
      if (!field.is_padding()) {
        const RecordField all{0, field.type, field.count, columns[column++].bytes().data()};
        unpack_records({values, header_.points, field.size(), std::endian::little}, {&all, 1}, silent);
      }
      values += header_.points * field.size();
    }
    return columns;
  }

  std::vector<char> decompressed() const {
    if (bytes_.size() < 8) {
      throw InputError(source_.name, Place::byte(source_.bytes.size()), "the end of the file",
                       "the sizes of the compressed data");
    }
    const std::size_t compressed_size = load<std::uint32_t>(bytes_.data());
    const std::size_t size = load<std::uint32_t>(bytes_.data() + 4);
    const std::string_view compressed = bytes_.substr(8, compressed_size);
    if (compressed.size() < compressed_size) {
      throw InputError(
          source_.name, Place::byte(source_.bytes.size()),
          fmt::format("the end of the file after {} bytes of compressed data", compressed.size()),
          fmt::format("{} bytes", compressed_size));
    }
    // Neither number can be so large that the product overflows.
    if (size != header_.points * header_.record_bytes) {
      throw InputError(source_.name, place(4), fmt::format("{} bytes of uncompressed data", size),
                       fmt::format("{} ({} points of {} bytes)", header_.points * header_.record_bytes,
                                   header_.points, header_.record_bytes));
    }
    if (size / lzf_largest_ratio > compressed_size) {
      throw InputError(source_.name, place(0), fmt::format("{} bytes of compressed data", compressed_size),
                       fmt::format("enough for {} bytes", size));
    }
    expect_end(8 + compressed_size);
    std::vector<char> data(size);
    if (const auto error = decompress_lzf(compressed, data, progress_)) {
      throw InputError(source_.name, place(8 + error->position), error->found,
                       fmt::format("{} bytes of LZF-compressed data", size));
    }
    progress_.advance(8 + compressed_size);
    return data;
  }

  const Source& source_;
  const PcdHeader& header_;
  Progress& progress_;
  std::string_view bytes_;
};

std::string encoding_of(const PcdHeader& header) {
  const std::string_view encoding = header.encoding == PcdEncoding::Ascii    ? "ascii"
                                    : header.encoding == PcdEncoding::Binary ? "binary"
                                                                             : "binary compressed";
  return fmt::format("{}{}{}", encoding, header.version.empty() ? "" : " ", header.version);
}

}  // namespace

Reading read_pcd(const Source& source, Progress& progress) {
  PcdHeader header = read_pcd_header(source);
  progress.advance(header.body_offset);
  std::vector<Column> columns = Body(source, header, progress).read();

  Reading reading;
  reading.encoding = encoding_of(header);
  if (header.height > 1 && header.points > 0) {
    reading.notes.push_back(
        fmt::format("the grid of {} x {} points is read as a list of points", header.width, header.height));
  }
  PointCloud& cloud = reading.cloud;
  cloud.comments = std::move(header.comments);
  cloud.positions.resize(header.points);
  std::array<ScalarType, 3> declared{};
  for (const PcdField& field : header.fields)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (field.name == axes[axis]) declared[axis] = field.type;
  for (Column& column : columns) {
    const auto axis = std::find(axes.begin(), axes.end(), column.name());
    if (axis == axes.end()) {
      cloud.attributes.push_back(std::move(column));
    } else {
      const auto number = static_cast<std::size_t>(axis - axes.begin());
      if (const auto inexact = set_axis(cloud, number, column, declared[number], progress)) {
        throw InputError(
            source.name, Place::file(),
            fmt::format("{} = {} at point {}", column.name(), number_text(column, *inexact), *inexact),
            "a number that a double holds exactly");
      }
    }
  }
  if (cloud.position_types != declared) reading.notes.emplace_back(wide_coordinates_note);
  return reading;
}

Format::Match match_pcd(const Source& source) {
  constexpr std::size_t longest_look = 64 * std::size_t{1024};
  std::string_view text = without_bom(source.bytes.substr(0, longest_look));
  const char line_end = line_end_of(text);
  while (!text.empty()) {
    std::string_view line = trimmed(take_line(text, line_end));
    const bool comment = line.starts_with('#');
    if (comment && trimmed(line.substr(1)).starts_with(".PCD")) return Format::Match::Strong;
    if (comment || line.empty()) continue;
    const std::string_view keyword = take_word(line);
    const bool known = keyword == "VERSION" || keyword == "FIELDS" || keyword == "COLUMNS";
    return known ? Format::Match::Strong : Format::Match::No;
  }
  return Format::Match::No;
}

}  // namespace keenline
