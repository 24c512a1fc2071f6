#include "keenline/io/ply_body.h"

#include <algorithm>
#include <bit>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "keenline/io/records.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_lines.h"
#include "keenline/io/text_rows.h"
#include "keenline/memory.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

/// Bytes of a row whose lists are all empty; what a list's length takes counts, its values do not.
std::size_t fixed_size(const PlyElement& element) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties)
    size += size_of(property.count_type.value_or(property.type));
  return size;
}

/// What the columns take, without the values of lists.
std::size_t memory_per_row(const PlyElement& element) {
  std::size_t size = element.name == "vertex" ? sizeof(Point) : 0;
  for (const PlyProperty& property : element.properties)
    size += property.count_type ? sizeof(std::uint64_t) : size_of(property.type);
  return size;
}

std::endian order_of(PlyEncoding encoding) {
  return encoding == PlyEncoding::BigEndian ? std::endian::big : std::endian::little;
}

/// Gathers one property's values while rows are walked.
class ColumnBuilder {
 public:
  explicit ColumnBuilder(const PlyProperty& property) : property_(&property) {
    if (property.count_type) offsets_.push_back(0);
  }

  [[nodiscard]] const PlyProperty& property() const { return *property_; }

  template <typename T>
  void add(T value) {
    const auto bytes = std::as_bytes(std::span(&value, 1));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  template <typename T>
  void add_all(const char* from, std::uint64_t count, std::endian order) {
    if (order != std::endian::native) {
      for (std::uint64_t i = 0; i < count; ++i) add(load<T>(from + i * sizeof(T), order));
      return;
    }
    const auto* const begin = reinterpret_cast<const std::byte*>(from);
    bytes_.insert(bytes_.end(), begin, begin + count * sizeof(T));
  }

  void end_list() { offsets_.push_back(bytes_.size() / size_of(property_->type)); }

  [[nodiscard]] Column finish() {
    if (property_->count_type) {
      return {property_->name, property_->type, *property_->count_type, std::move(offsets_),
              std::move(bytes_)};
    }
    Column column(property_->name, property_->type, bytes_.size() / size_of(property_->type));
    std::copy(bytes_.begin(), bytes_.end(), column.bytes().begin());
    bytes_ = {};
    return column;
  }

 private:
  const PlyProperty* property_;
  std::vector<std::uint64_t> offsets_;  // lists only
  std::vector<std::byte> bytes_;
};

std::vector<ColumnBuilder> builders_for(const PlyElement& element) {
  return {element.properties.begin(), element.properties.end()};
}

Table finished(const PlyElement& element, std::vector<ColumnBuilder>& builders) {
  Table table{element.name, element.count, {}};
  for (ColumnBuilder& builder : builders) table.columns.push_back(builder.finish());
  return table;
}

/// Takes the numbers of one row off its line, for every property in turn.
class AsciiRow {
 public:
  AsciiRow(const Source& source, const PlyElement& element, std::string_view line, std::uint64_t number)
      : element_(&element), words_(source, line, number) {}

  void read_into(std::vector<ColumnBuilder>& builders) {
    for (ColumnBuilder& builder : builders) {
      const PlyProperty& property = builder.property();
      if (!property.count_type) {
        add_values(builder, 1);
        continue;
      }
      const std::uint64_t count = take_count(property);
      // Every value needs a blank and a digit.
      if (count > words_.rest().size() / 2)
        words_.refuse({}, fmt::format("{} values of {}", count, name(property)));
      add_values(builder, count);
      builder.end_list();
    }
    words_.expect_end();
  }

 private:
  [[nodiscard]] std::string name(const PlyProperty& property) const {
    return fmt::format("property {} of element {}", quoted(property.name), quoted(element_->name));
  }

  std::uint64_t take_count(const PlyProperty& property) {
    return visit_type(*property.count_type, [&](auto zero) -> std::uint64_t {
      using T = decltype(zero);
      const std::string_view word = words_.next();
      T count{};
      if (parse_number(word, count) != Parsed::Ok || count < 0) {
        words_.refuse(word, fmt::format("the number of values of {} (type {})", name(property),
                                        name_of(*property.count_type)));
      }
      return static_cast<std::uint64_t>(count);
    });
  }

  void add_values(ColumnBuilder& builder, std::uint64_t count) {
    visit_type(builder.property().type, [&](auto zero) {
      using T = decltype(zero);
      for (std::uint64_t i = 0; i < count; ++i) {
        const std::string_view word = words_.next();
        T value{};
        if (parse_number(word, value) != Parsed::Ok)
          words_.refuse(word, fmt::format("{} for {}", description_of_number<T>(), name(builder.property())));
        builder.add(value);
      }
    });
  }

  const PlyElement* element_;
  Words words_;
};

/// Takes the numbers of one row off the bytes of the file, for every property in turn.
class BinaryRows {
 public:
  BinaryRows(const Source& source, const PlyElement& element, std::size_t position, std::endian order)
      : source_(source), element_(element), position_(position), order_(order) {}

  [[nodiscard]] std::size_t position() const { return position_; }

  void read_into(std::vector<ColumnBuilder>& builders) {
    for (ColumnBuilder& builder : builders) {
      const PlyProperty& property = builder.property();
      const std::uint64_t count = property.count_type ? take_count(property) : 1;
      const std::size_t room = (source_.bytes.size() - position_) / size_of(property.type);
      if (count > room) {
        refuse_end(fmt::format("{} values of property {} of element {}, where {} fit", count,
                               quoted(property.name), quoted(element_.name), room));
      }
      visit_type(property.type, [&](auto zero) {
        builder.add_all<decltype(zero)>(source_.bytes.data() + position_, count, order_);
      });
      position_ += count * size_of(property.type);
      if (property.count_type) builder.end_list();
    }
  }

 private:
  [[noreturn]] void refuse_end(std::string_view expected) const {
    throw InputError(source_.name, Place::byte(position_), "the end of the file too soon", expected);
  }

  std::uint64_t take_count(const PlyProperty& property) {
    return visit_type(*property.count_type, [&](auto zero) -> std::uint64_t {
      using T = decltype(zero);
      if (source_.bytes.size() - position_ < sizeof(T)) {
        refuse_end(fmt::format("the number of values of property {} of element {}", quoted(property.name),
                               quoted(element_.name)));
      }
      const T count = load<T>(source_.bytes.data() + position_, order_);
      if (count < 0) {
        throw InputError(source_.name, Place::byte(position_),
                         fmt::format("{} values of property {} of element {}", count, quoted(property.name),
                                     quoted(element_.name)),
                         "a number from 0");
      }
      position_ += sizeof(T);
      return static_cast<std::uint64_t>(count);
    });
  }

  const Source& source_;
  const PlyElement& element_;
  std::size_t position_;
  std::endian order_;
};

}  // namespace

PlyBody::PlyBody(const Source& source, const PlyHeader& header, Progress& progress)
    : source_(source), header_(header), progress_(progress), position_(header.size), line_(header.lines + 1) {
  progress_.advance(header.size);
}

std::string_view PlyBody::rest() const { return source_.bytes.substr(position_); }

PlyRows PlyBody::read(const PlyElement& element) {
  require_room(element, position_);
  PlyRows rows{{}, position_, line_};
  const bool ascii = header_.encoding == PlyEncoding::Ascii;
  // What a text holds is known only when it has been looked through.
  if (!ascii) {
    require_memory(element.count * memory_per_row(element),
                   fmt::format("reading element {}", quoted(element.name)));
  }
  if (element.count == 0) {
    std::vector<ColumnBuilder> empty = builders_for(element);
    rows.table = finished(element, empty);
  } else if (element.has_lists()) {
    rows.table = ascii ? read_ascii_lists(element) : read_binary_lists(element);
  } else {
    rows.table = ascii ? read_ascii_scalars(element) : read_binary_scalars(element);
  }
  return rows;
}

void PlyBody::require_sizes() const {
  if (header_.encoding == PlyEncoding::Ascii) return;
  std::size_t end = position_;
  bool lists = false;
  for (const PlyElement& element : header_.elements) {
    require_room(element, end);
    end += element.count * fixed_size(element);
    lists = lists || (element.count > 0 && element.has_lists());
  }
  if (!lists) expect_end_at(end);
}

void PlyBody::require_room(const PlyElement& element, std::size_t position) const {
  if (element.count == 0) return;
  if (element.properties.empty()) {
    throw InputError(
        source_.name, Place::line(element.line),
        fmt::format("element {} with {} rows but no properties", quoted(element.name), element.count),
        "a property");
  }
  const bool ascii = header_.encoding == PlyEncoding::Ascii;
  // In a text the smallest number is one digit and what separates it from the next; the last line may lack
  // its end.
  const std::size_t smallest =
      std::max<std::size_t>(1, ascii ? 2 * element.properties.size() : fixed_size(element));
  const std::size_t room = (source_.bytes.size() - position + (ascii ? 1 : 0)) / smallest;
  if (element.count <= room) return;
  throw InputError(source_.name, Place::byte(source_.bytes.size()),
                   fmt::format("the end of the file, with room for at most {} rows of element {}", room,
                               quoted(element.name)),
                   fmt::format("{} rows, as line {} declares", element.count, element.line));
}

Table PlyBody::read_ascii_scalars(const PlyElement& element) {
  RowFormat format;
  for (const PlyProperty& property : element.properties) {
    format.names.push_back(property.name);
    format.types.push_back(property.type);
  }
  Rows rows = read_rows(source_, rest(), line_, format, element.count, progress_);
  position_ += rows.consumed;
  line_ = rows.next_line;
  return {element.name, element.count, std::move(rows.columns)};
}

Table PlyBody::read_ascii_lists(const PlyElement& element) {
  std::vector<ColumnBuilder> builders = builders_for(element);
  TextLines lines(source_, rest(), line_, progress_);
  std::string_view line;
  for (std::uint64_t row = 0; row < element.count;) {
    if (!lines.next(line)) {
      lines.refuse_end(
          fmt::format("row {} of {} of element {}", row + 1, element.count, quoted(element.name)));
    }
    if (trimmed(line).empty()) continue;
    AsciiRow(source_, element, line, lines.number()).read_into(builders);
    ++row;
  }
  lines.report();
  position_ = source_.bytes.size() - lines.rest().size();
  line_ = lines.number() + 1;
  return finished(element, builders);
}

Table PlyBody::read_binary_scalars(const PlyElement& element) {
  const Records records{rest().data(), element.count, fixed_size(element), order_of(header_.encoding)};
  Table table{element.name, element.count, {}};
  std::vector<RecordField> fields;
  std::size_t offset = 0;
  for (const PlyProperty& property : element.properties) {
    Column& column = table.columns.emplace_back(property.name, property.type, element.count);
    fields.push_back({offset, property.type, 1, column.bytes().data()});
    offset += size_of(property.type);
  }
  unpack_records(records, fields, progress_);
  position_ += records.count * records.stride;
  return table;
}

Table PlyBody::read_binary_lists(const PlyElement& element) {
  std::vector<ColumnBuilder> builders = builders_for(element);
  BinaryRows rows(source_, element, position_, order_of(header_.encoding));
  std::size_t reported = position_;
  constexpr std::uint64_t rows_per_check = 1024;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    if (row % rows_per_check == 0) {
      progress_.check();
      progress_.advance(rows.position() - reported);
      reported = rows.position();
    }
    rows.read_into(builders);
  }
  progress_.advance(rows.position() - reported);
  position_ = rows.position();
  return finished(element, builders);
}

void PlyBody::expect_end() const { expect_end_at(position_); }

void PlyBody::expect_end_at(std::size_t end) const {
  // Writers may fill up to a multiple of eight bytes; any point more would take more.
  constexpr std::size_t longest_padding = 7;
  constexpr std::size_t bytes_per_check = std::size_t{1} << 20;
  std::size_t zeros = 0;
  for (std::size_t i = end; i < source_.bytes.size(); ++i) {
    if ((i - end) % bytes_per_check == 0) progress_.check();
    const char c = source_.bytes[i];
    if (c == '\0' ? ++zeros <= longest_padding : (c == ' ' || (c >= '\t' && c <= '\r'))) continue;
    throw InputError(source_.name, place_after_rows(end, i),
                     fmt::format("{} more bytes than the header declares", source_.bytes.size() - end),
                     "the end of the file");
  }
}

Place PlyBody::place_after_rows(std::size_t end, std::size_t byte) const {
  if (header_.encoding != PlyEncoding::Ascii) return Place::byte(end);
  LineReader lines(source_.bytes.substr(end, byte + 1 - end), line_);
  std::string_view line;
  while (lines.next(line)) continue;
  return Place::line(lines.number());
}

Place PlyBody::place_of(const PlyRows& rows, std::uint64_t row) const {
  if (header_.encoding == PlyEncoding::Ascii) {
    LineReader lines(source_.bytes.substr(rows.start_byte), rows.start_line);
    std::string_view line;
    for (std::uint64_t left = row + 1; left > 0 && lines.next(line);)
      if (!trimmed(line).empty()) --left;
    return Place::line(lines.number());
  }
  std::uint64_t byte = rows.start_byte;
  for (const Column& column : rows.table.columns) {
    byte += row * size_of(column.is_list() ? column.count_type() : column.type());
    if (column.is_list()) byte += column.offsets()[row] * size_of(column.type());
  }
  return Place::byte(byte);
}

}  // namespace keenline
