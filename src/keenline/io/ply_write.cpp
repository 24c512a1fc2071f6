#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/io/ply.h"
#include "keenline/io/ply_header.h"
#include "keenline/io/records.h"
#include "keenline/io/sink.h"
#include "keenline/io/unique_names.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

/// Numbers of one type in memory, at equal distances.
struct Values {
  const std::byte* data = nullptr;
  std::size_t stride = 0;
  std::size_t count = 0;
  ScalarType type = ScalarType::Float64;

  template <typename T>
  [[nodiscard]] T get(std::size_t i) const {
    return load<T>(reinterpret_cast<const char*>(data) + i * stride, std::endian::native);
  }
};

/// One property of an element: where its values come from and how they are stored.
struct Property {
  std::string name;
  Values values;
  ScalarType type = ScalarType::Float64;
  ScalarType count_type = ScalarType::UInt8;
  std::span<const std::uint64_t> offsets;  // empty unless a list

  [[nodiscard]] bool is_list() const { return !offsets.empty(); }
};

struct Element {
  std::string name;
  std::size_t rows = 0;
  std::vector<Property> properties;
};

Values values_of(const Column& column) {
  return {column.bytes().data(), size_of(column.type()), column.value_count(), column.type()};
}

Values coordinate(const PointCloud& cloud, std::size_t d) {
  if (cloud.positions.empty()) return {};
  const auto* const first = reinterpret_cast<const std::byte*>(&cloud.positions[0][d]);
  return {first, sizeof(Point), cloud.size(), ScalarType::Float64};
}

/// Whether `value` is an integer that a To can hold, or rounds to a finite float.
template <typename To, typename From>
bool fits(From value) {
  if constexpr (std::is_integral_v<From>) {
    return std::in_range<To>(value);
    // Beyond 32 bits the limits themselves are no doubles; nobody asks.
  } else if constexpr (std::is_integral_v<To>) {
    return value >= static_cast<double>(std::numeric_limits<To>::min()) &&
           value <= static_cast<double>(std::numeric_limits<To>::max()) && value == std::trunc(value);
  } else {
    return !std::isfinite(value) || std::abs(value) <= static_cast<double>(std::numeric_limits<To>::max());
  }
}

/// Counts the values for which `test` fails.
template <typename T, typename Test>
std::size_t count_failing(const Values& values, Progress& progress, Test test) {
  constexpr std::size_t values_per_check = 65536;
  std::size_t failing = 0;
  for (std::size_t i = 0; i < values.count; ++i) {
    if (i % values_per_check == 0) progress.check();
    failing += test(values.get<T>(i)) ? 0 : 1;
  }
  return failing;
}

/// The first of int and uint that holds all values.
template <typename From>
std::optional<ScalarType> integer_type_for(const Values& values, Progress& progress) {
  if (count_failing<From>(values, progress, fits<std::int32_t, From>) == 0) return ScalarType::Int32;
  if (count_failing<From>(values, progress, fits<std::uint32_t, From>) == 0) return ScalarType::UInt32;
  return std::nullopt;
}

ScalarType coordinate_type(const Values& values, ScalarType wanted, Progress& progress) {
  return visit_type(wanted, [&](auto zero) {
    using T = decltype(zero);
    if constexpr (std::is_same_v<T, double>) return wanted;
    else if constexpr (sizeof(T) == 8) {
      return integer_type_for<double>(values, progress).value_or(ScalarType::Float64);
    } else {
      return count_failing<double>(values, progress, fits<T, double>) == 0 ? wanted : ScalarType::Float64;
    }
  });
}

/// Comments may take half of the longest header that is read; the other half is left to the properties.
constexpr std::size_t most_comment_bytes = longest_ply_header / 2;

/// Works out what PLY can hold of a cloud, and writes it.
class Writer {
 public:
  Writer(const PointCloud& cloud, Sink& sink, Progress& progress) : sink_(sink), progress_(progress) {
    Element vertex{"vertex", cloud.size(), {}};
    UniqueNames names({"x", "y", "z"});
    for (std::size_t d = 0; d < 3; ++d) add_coordinate(cloud, d, vertex);
    for (const Column& column : cloud.attributes) add_column(column, names, vertex);
    elements_.push_back(std::move(vertex));

    UniqueNames element_names({"vertex"});
    for (const Table& table : cloud.tables) add_table(table, element_names);
    make_header(cloud.comments);
  }

  std::vector<std::string> write() {
    sink_.write(header_);
    for (const Element& element : elements_) write_rows(element);
    return std::move(notes_);
  }

 private:
  void add_coordinate(const PointCloud& cloud, std::size_t d, Element& vertex) {
    constexpr std::string_view axes = "xyz";
    const Values values = coordinate(cloud, d);
    const ScalarType wanted = cloud.position_types[d];
    const ScalarType type = coordinate_type(values, wanted, progress_);
    if (type != wanted && size_of(wanted) < 8) {
      notes_.push_back(
          fmt::format("{} is written as double: {} cannot hold every value", axes[d], name_of(wanted)));
    }
    vertex.properties.push_back({std::string(axes.substr(d, 1)), values, type, ScalarType::UInt8, {}});
  }

  void add_column(const Column& column, UniqueNames& names, Element& element) {
    if (column.rows() != element.rows) {
      throw InvalidArgument(fmt::format("column {} has {} rows, its table {} has {}", quoted(column.name()),
                                        column.rows(), quoted(element.name), element.rows));
    }
    element.properties.push_back({names.claim(clean_name(column.name(), "column")), values_of(column),
                                  stored_type(column), stored_count_type(column), column.offsets()});
    tell_renamed(column.name(), element.properties.back().name);
  }

  void add_table(const Table& table, UniqueNames& element_names) {
    if (table.columns.empty() && table.rows > 0) {
      notes_.push_back(
          fmt::format("the {} rows of {} have no columns and are left out", table.rows, quoted(table.name)));
      return;
    }
    Element element{element_names.claim(clean_name(table.name, "table")), table.rows, {}};
    tell_renamed(table.name, element.name);
    UniqueNames names;
    for (const Column& column : table.columns) add_column(column, names, element);
    elements_.push_back(std::move(element));
  }

  /// What ends a word or a line of the header becomes '_'; any other name stays as it is.
  static std::string clean_name(std::string_view name, std::string_view if_empty) {
    constexpr std::string_view ends(" \t\r\n\0", 5);
    std::string clean(name.empty() ? if_empty : name);
    for (char& c : clean)
      if (ends.find(c) != std::string_view::npos) c = '_';
    return clean;
  }

  void tell_renamed(std::string_view from, std::string_view to) {
    if (from != to) notes_.push_back(fmt::format("{} is written as {}", quoted(from), quoted(to)));
  }

  ScalarType stored_type(const Column& column) {
    return visit_type(column.type(), [&](auto zero) {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
        const Values values = values_of(column);
        if (const auto type = integer_type_for<T>(values, progress_)) return *type;
        const std::size_t rounded = count_failing<T>(values, progress_, is_exact_in_double<T>);
        if (rounded > 0) {
          notes_.push_back(
              fmt::format("column {}: {} of {} integers were rounded to doubles, for PLY has no 64-bit "
                          "integers; CSV keeps them",
                          quoted(column.name()), rounded, values.count));
        }
        return ScalarType::Float64;
      }
      return column.type();
    });
  }

  static ScalarType stored_count_type(const Column& column) {
    std::uint64_t longest = 0;
    for (std::size_t i = 1; i < column.offsets().size(); ++i)
      longest = std::max(longest, column.offsets()[i] - column.offsets()[i - 1]);
    if (longest > std::numeric_limits<std::uint32_t>::max()) {
      throw InvalidArgument(
          fmt::format("column {}: a list of {} values is too long for PLY", quoted(column.name()), longest));
    }
    return visit_type(column.count_type(), [&](auto zero) {
      using T = decltype(zero);
      if constexpr (std::is_integral_v<T> && sizeof(T) < 8)
        if (std::in_range<T>(longest)) return column.count_type();
      return ScalarType::UInt32;
    });
  }

  void make_header(const std::vector<std::string>& comments) {
    header_ = "ply\nformat binary_little_endian 1.0\n";
    std::size_t kept = 0;
    while (kept < comments.size() && header_.size() + comments[kept].size() <= most_comment_bytes)
      add_comment(comments[kept++]);
    if (kept < comments.size()) {
      notes_.push_back(
          fmt::format("{} comments are left out: the header would be too long", comments.size() - kept));
    }
    for (const Element& element : elements_) {
      fmt::format_to(std::back_inserter(header_), "element {} {}\n", element.name, element.rows);
      for (const Property& property : element.properties) {
        header_ += "property ";
        if (property.is_list())
          fmt::format_to(std::back_inserter(header_), "list {} ", ply_type_name(property.count_type));
        fmt::format_to(std::back_inserter(header_), "{} {}\n", ply_type_name(property.type), property.name);
      }
    }
    header_ += "end_header\n";
  }

  void add_comment(std::string_view comment) {
    // The reader hands these on as comments with their keyword.
    const std::size_t begin = header_.size();
    if (!comment.starts_with("obj_info ")) header_ += "comment ";
    header_ += comment;
    for (std::size_t i = begin; i < header_.size(); ++i)
      if (static_cast<unsigned char>(header_[i]) < ' ' && header_[i] != '\t') header_[i] = ' ';
    header_ += '\n';
  }

  /// Blocks of rows are put together in parallel and written in order.
  void write_rows(const Element& element) {
    constexpr std::size_t block_bytes = std::size_t{1} << 20;
    constexpr std::size_t most_blocks = 32;
    if (element.rows == 0) return;
    const std::size_t block_rows =
        std::max<std::size_t>(1, block_bytes / std::max<std::size_t>(1, average_size(element)));
    std::vector<std::string> blocks;
    for (std::size_t begin = 0; begin < element.rows; begin += most_blocks * block_rows) {
      const std::size_t left = element.rows - begin;
      blocks.assign(std::min(most_blocks, (left - 1) / block_rows + 1), {});
      tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
        progress_.check();
        const std::size_t first = begin + b * block_rows;
        blocks[b] = packed_rows(element, first, std::min(first + block_rows, element.rows));
      });
      for (const std::string& block : blocks) {
        progress_.check();
        sink_.write(block);
      }
      // The caller counts points; other elements are the smaller part.
      if (element.name == "vertex") progress_.advance(std::min(left, most_blocks * block_rows));
    }
  }

  static std::size_t fixed_size(const Element& element) {
    std::size_t size = 0;
    for (const Property& property : element.properties)
      size += size_of(property.is_list() ? property.count_type : property.type);
    return size;
  }

  /// \pre element.rows > 0
  static std::size_t average_size(const Element& element) {
    std::size_t list_bytes = 0;
    for (const Property& property : element.properties)
      if (property.is_list()) list_bytes += property.values.count * size_of(property.type);
    return fixed_size(element) + list_bytes / element.rows;
  }

  static std::string packed_rows(const Element& element, std::size_t first, std::size_t last) {
    // Where in the block the next value of each row goes.
    std::vector<std::size_t> next(last - first);
    std::size_t size = 0;
    const std::size_t fixed = fixed_size(element);
    for (std::size_t row = first; row < last; ++row) {
      next[row - first] = size;
      size += fixed;
      for (const Property& property : element.properties) {
        if (property.is_list())
          size += (property.offsets[row + 1] - property.offsets[row]) * size_of(property.type);
      }
    }
    std::string block(size, '\0');
    for (const Property& property : element.properties) {
      visit_type(property.values.type, [&](auto from) {
        visit_type(property.type, [&](auto to) {
          using From = decltype(from);
          using To = decltype(to);
          // Other conversions are never planned.
          if constexpr (std::is_same_v<From, To> || sizeof(From) == 8)
            pack_property<From, To>(property, first, next, block.data());
        });
      });
    }
    return block;
  }

  template <typename From, typename To>
  static void pack_property(const Property& property, std::size_t first, std::vector<std::size_t>& next,
                            char* block) {
    for (std::size_t i = 0; i < next.size(); ++i) {
      const std::size_t row = first + i;
      std::size_t begin = row;
      std::size_t end = row + 1;
      if (property.is_list()) {
        begin = property.offsets[row];
        end = property.offsets[row + 1];
        next[i] += store_count(property.count_type, end - begin, block + next[i]);
      }
      for (std::size_t k = begin; k < end; ++k, next[i] += sizeof(To))
        store(static_cast<To>(property.values.get<From>(k)), block + next[i]);
    }
  }

  static std::size_t store_count(ScalarType type, std::uint64_t count, char* to) {
    return visit_type(type, [&](auto zero) {
      store(static_cast<decltype(zero)>(count), to);
      return sizeof(zero);
    });
  }

  Sink& sink_;
  Progress& progress_;
  std::vector<Element> elements_;
  std::vector<std::string> notes_;
  std::string header_;
};

}  // namespace

std::vector<std::string> write_ply(const PointCloud& cloud, Sink& sink, Progress& progress) {
  return Writer(cloud, sink, progress).write();
}

}  // namespace keenline
