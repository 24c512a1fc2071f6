#include "keenline/io/csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <unordered_set>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/io/sink.h"
#include "keenline/io/text.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

/// A column of the text: an attribute, or one place in its lists.
struct Field {
  const Column* column = nullptr;
  std::size_t stride = 1;  // values per row of the attribute
  std::size_t place = 0;
  std::string name;
};

template <typename T>
void append_number(std::string& text, T value) {
  if constexpr (std::is_floating_point_v<T>) {
    if (std::isnan(value)) {  // to_chars would give "-nan" for some
      text += "nan";
      return;
    }
  }
  std::array<char, 32> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

/// In the shortest form of the type that it had, unless it has become something else since.
void append_coordinate(std::string& text, double value, ScalarType type) {
  constexpr double two_to_53 = 9007199254740992.0;
  if (type == ScalarType::Float32 && !std::isnan(value) &&
      static_cast<double>(static_cast<float>(value)) == value) {
    append_number(text, static_cast<float>(value));
  } else if (type < ScalarType::Float32 && std::abs(value) < two_to_53 && value == std::floor(value)) {
    append_number(text, static_cast<std::int64_t>(value));  // 100000 rather than 1e+05
  } else {
    append_number(text, value);
  }
}

/// Names that a reader would take for those of the coordinates, which stand before them.
bool is_axis(std::string_view name) {
  return name.size() == 1 && std::string_view("xyzXYZ").find(name[0]) != std::string_view::npos;
}

using NameSet = std::unordered_set<std::string>;

/// A name that a line can hold and that no other column has.
std::string usable_name(const std::string& wanted, NameSet& taken, std::vector<std::string>& notes) {
  std::string name(trimmed(wanted));
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '_';
  if (name.empty()) name = "column";
  const std::string base = name;
  for (int number = 2; is_axis(name) || taken.count(name) > 0; ++number)
    name = fmt::format("{}_{}", base, number);
  taken.insert(name);
  if (name != wanted)
    notes.push_back(fmt::format("attribute {} is named {} in CSV", quoted(wanted), quoted(name)));
  return name;
}

/// Values per row; nothing when the rows differ.
std::optional<std::size_t> constant_length(const Column& column) {
  if (!column.is_list()) return 1;
  const auto offsets = column.offsets();
  const std::uint64_t length = offsets.size() > 1 ? offsets[1] : 0;
  for (std::size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] - offsets[i - 1] != length) return std::nullopt;
  return length;
}

std::vector<Field> fields_of(const PointCloud& cloud, std::vector<std::string>& notes) {
  std::vector<Field> fields;
  NameSet taken;
  for (const Column& column : cloud.attributes) {
    const std::optional<std::size_t> length = constant_length(column);
    if (!length || *length == 0) {
      notes.push_back(fmt::format("attribute {} ({}) is not in CSV", quoted(column.name()),
                                  length ? "empty lists" : "lists of varying length"));
      continue;
    }
    for (std::size_t place = 0; place < *length; ++place) {
      const std::string name = column.is_list() ? fmt::format("{}_{}", column.name(), place) : column.name();
      fields.push_back({&column, *length, place, usable_name(name, taken, notes)});
    }
  }
  return fields;
}

void note_left_out(const PointCloud& cloud, std::vector<std::string>& notes) {
  for (const Table& table : cloud.tables)
    notes.push_back(fmt::format("table {} ({} rows) is not in CSV", quoted(table.name), table.rows));
  if (!cloud.comments.empty())
    notes.push_back(fmt::format("the comments ({} lines) are not in CSV", cloud.comments.size()));
}

/// RFC 4180; also quotes what this library's own reader would take for a delimiter or a comment.
std::string in_quotes_if_needed(const std::string& name) {
  if (name.find_first_of("\",;#/") == std::string::npos) return name;
  std::string result = "\"";
  for (const char c : name) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string header_line(const std::vector<Field>& fields) {
  std::string line = "x,y,z";
  for (const Field& field : fields) line += ',' + in_quotes_if_needed(field.name);
  return line + '\n';
}

/// Puts the rows [begin, end) into `text`.
void format_rows(const PointCloud& cloud, const std::vector<Field>& fields, std::size_t begin,
                 std::size_t end, std::string& text) {
  text.clear();
  for (std::size_t row = begin; row < end; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ',';
      append_coordinate(text, cloud.positions[row][axis], cloud.position_types[axis]);
    }
    for (const Field& field : fields) {
      text += ',';
      visit_type(field.column->type(), [&](auto zero) {
        append_number(text, field.column->values<decltype(zero)>()[row * field.stride + field.place]);
      });
    }
    text += '\n';
  }
}

}  // namespace

std::vector<std::string> write_csv(const PointCloud& cloud, Sink& sink, Progress& progress) {
  std::vector<std::string> notes;
  const std::vector<Field> fields = fields_of(cloud, notes);
  note_left_out(cloud, notes);
  sink.write(header_line(fields));

  constexpr std::size_t values_per_block = 32768;
  constexpr std::size_t blocks_at_once = 32;
  const std::size_t rows_per_block = std::max<std::size_t>(1, values_per_block / (3 + fields.size()));
  std::vector<std::string> blocks(blocks_at_once);
  for (std::size_t first = 0; first < cloud.size(); first += blocks.size() * rows_per_block) {
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      progress.check();
      const std::size_t begin = std::min(first + i * rows_per_block, cloud.size());
      const std::size_t end = std::min(begin + rows_per_block, cloud.size());
      format_rows(cloud, fields, begin, end, blocks[i]);
      progress.advance(end - begin);
    });
    for (const std::string& block : blocks)
      if (!block.empty()) sink.write(block);
  }
  return notes;
}

}  // namespace keenline
