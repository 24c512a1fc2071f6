#include "keenline/io/text_rows.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <charconv>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <type_traits>

#include <fast_float/fast_float.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_split.h"
#include "keenline/memory.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::size_t largest_chunk = 256 * std::size_t{1024};
constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();

/// Some whole lines of the text.
struct Chunk {
  std::string_view text;
  std::uint64_t first_line = 0;
  std::uint64_t lines = 0;
  std::uint64_t first_row = 0;
  std::uint64_t rows = 0;    // those that are wanted, where the text holds more
  std::size_t reported = 0;  // bytes that progress already knows of
  bool zero_byte = false;    // the line after the last one holds a zero byte
};

/// Where the rows are.
struct Scan {
  std::vector<Chunk> chunks;
  std::uint64_t rows = 0;
  std::uint64_t lines = 0;
  std::optional<std::uint64_t> zero_byte_line;  // the text was looked at only up to there
};

/// What of a line is a row; empty when nothing is.
std::string_view row_in(std::string_view line, const RowFormat& format) {
  return trimmed(format.comments ? without_comment(line) : line);
}

void count_rows(Chunk& chunk, const RowFormat& format, char line_end) {
  const std::size_t zero = chunk.text.find('\0');
  chunk.zero_byte = zero != npos;
  // What stands before the zero byte's line is still read: a mistake there comes first.
  if (chunk.zero_byte) chunk.text = chunk.text.substr(0, chunk.text.substr(0, zero).rfind(line_end) + 1);
  for (std::string_view rest = chunk.text; !rest.empty();) {
    std::string_view line = take_line(rest, line_end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
    const bool comment = format.comments && (line.starts_with('#') || line.starts_with("//"));
    if (!line.empty() && !comment) ++chunk.rows;
    ++chunk.lines;
  }
}

/// The end of the line that holds byte `from`, or of the first zero byte after it: nobody reads a sparse file
/// to its end.
std::size_t chunk_end(std::string_view text, std::size_t from, char line_end, const Progress& progress) {
  constexpr std::size_t window = 64 * std::size_t{1024};
  for (; from < text.size(); from += std::min(window, text.size() - from)) {
    progress.check();
    const std::string_view part = text.substr(from, window);
    if (const std::size_t end = std::min(part.find(line_end), part.find('\0')); end != npos)
      return from + end + 1;
  }
  return text.size();
}

/// Puts what was found in the chunks from number `begin` on in order. False when no more need be looked at.
bool number_rows(Scan& scan, std::size_t begin, std::uint64_t first_line, std::uint64_t wanted,
                 Progress& progress) {
  for (std::size_t i = begin; i < scan.chunks.size(); ++i) {
    Chunk& chunk = scan.chunks[i];
    chunk.first_line = first_line + scan.lines;
    chunk.first_row = scan.rows;
    const bool last = chunk.zero_byte || chunk.rows >= wanted - scan.rows;
    chunk.rows = std::min(chunk.rows, wanted - scan.rows);
    scan.rows += chunk.rows;
    scan.lines += chunk.lines;
    if (chunk.zero_byte) scan.zero_byte_line = first_line + scan.lines;
    if (last) {
      scan.chunks.resize(i + 1);
      return false;
    }
    chunk.reported = chunk.text.size() / 2;  // finding rows is half of the way, parsing them the other
    progress.advance(chunk.reported);
  }
  return true;
}

/// Counts rows in batches that grow, so that a few rows at the start of a large text cost little.
Scan find_rows(std::string_view text, std::uint64_t first_line, const RowFormat& format, char line_end,
               std::uint64_t wanted, Progress& progress) {
  constexpr std::size_t smallest_batch = 4096;
  constexpr std::size_t largest_batch = 256 * largest_chunk;
  Scan scan;
  std::size_t batch = wanted == no_limit ? largest_batch : smallest_batch;
  bool more = wanted > 0;
  for (std::size_t position = 0; more && position < text.size(); batch = std::min(2 * batch, largest_batch)) {
    const std::size_t begin = scan.chunks.size();
    const std::size_t batch_begin = position;
    while (position < text.size() && position - batch_begin < batch) {
      const std::size_t end = chunk_end(
          text, position + std::min({largest_chunk, batch, text.size() - position}) - 1, line_end, progress);
      scan.chunks.emplace_back().text = text.substr(position, end - position);
      position = end;
    }
    tbb::parallel_for(begin, scan.chunks.size(), [&](std::size_t i) {
      progress.check();
      count_rows(scan.chunks[i], format, line_end);
    });
    more = number_rows(scan, begin, first_line, wanted, progress);
  }
  return scan;
}

std::string described_names(const RowFormat& format) {
  std::string text;
  for (std::size_t c = 0; c < format.names.size() && c < 3; ++c)
    text += (c == 0 ? "" : ", ") + escaped(format.names[c]);
  return text + (format.names.size() > 3 ? ", …" : "");
}

/// One column to be filled.
struct Target {
  ScalarType type;
  std::byte* values;
};

/// Parses a plainly written number off the front of [p, end). False when it takes a closer look (or is none).
template <typename T>
bool parse_plain(const char*& p, const char* end, T& value) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto result = fast_float::from_chars(p, end, value);
    p = result.ptr;
    return result.ec == std::errc() && !std::isinf(value);
  } else {
    const auto result = std::from_chars(p, end, value);
    p = result.ptr;
    return result.ec == std::errc();
  }
}

/// Turns the rows of chunks into values of columns.
class RowParser {
 public:
  RowParser(const Source& source, const RowFormat& format, char line_end, std::vector<Column>& columns)
      : source_(source), format_(format), line_end_(line_end) {
    for (Column& column : columns) targets_.push_back({column.type(), column.bytes().data()});
  }

  struct End {
    std::size_t bytes = 0;
    std::uint64_t lines = 0;
  };

  /// Returns where in the chunk its last row ends. \throw InputError for the first row that is not
  /// understood.
  End parse(const Chunk& chunk) const {
    std::string_view rest = chunk.text;
    std::uint64_t lines = 0;
    for (std::uint64_t rows = 0; rows < chunk.rows; ++lines) {
      const std::string_view row = row_in(take_line(rest, line_end_), format_);
      if (row.empty()) continue;
      const std::size_t index = chunk.first_row + rows;
      if (!parse_quickly(row, index)) parse_carefully(row, index, Place::line(chunk.first_line + lines));
      ++rows;
    }
    return {chunk.text.size() - rest.size(), lines};
  }

 private:
  /// Most rows of most files. False when the row takes a closer look.
  bool parse_quickly(std::string_view row, std::size_t index) const {
    const char* p = row.data();
    const char* const end = p + row.size();
    const auto skip_blanks = [&] {
      while (p != end && (*p == ' ' || *p == '\t')) ++p;
    };
    const auto skip_delimiter = [&] {
      skip_blanks();
      return format_.delimiter == ' ' || (p != end && *p++ == format_.delimiter);
    };
    if (format_.delimiter == '\t') return false;  // it is no blank there
    for (std::size_t c = 0; c < targets_.size(); ++c) {
      if (c > 0 && !skip_delimiter()) return false;
      skip_blanks();
      const bool plain = visit_type(targets_[c].type, [&](auto zero) {
        return parse_plain(p, end, reinterpret_cast<decltype(zero)*>(targets_[c].values)[index]);
      });
      if (!plain || (p != end && *p != ' ' && *p != '\t' && *p != format_.delimiter)) return false;
    }
    if (format_.trailing_delimiter && !skip_delimiter()) return false;
    skip_blanks();
    return p == end;
  }

  void parse_carefully(std::string_view row, std::size_t index, Place place) const {
    check_width(row, place);
    FieldReader fields(row, format_.delimiter);
    std::string_view field;
    for (std::size_t c = 0; c < targets_.size() && fields.next(field); ++c) {
      if (format_.quotes) field = unquoted(field);
      visit_type(targets_[c].type, [&](auto number) {
        const Parsed parsed = parse_number(field, number);
        if (parsed != Parsed::Ok) refuse<decltype(number)>(field, c, parsed, place);
        reinterpret_cast<decltype(number)*>(targets_[c].values)[index] = number;
      });
    }
  }

  void check_width(std::string_view row, Place place) const {
    const std::size_t expected = targets_.size();
    std::size_t found = count_fields(row, format_.delimiter);
    if (format_.trailing_delimiter) {
      const bool trailing = row.back() == format_.delimiter;
      if (!trailing && found == expected) {
        throw InputError(source_.name, place, fmt::format("no '{}' at the end", format_.delimiter),
                         "one, as in the first row");
      }
      if (trailing) --found;
    }
    if (found != expected) {
      throw InputError(source_.name, place, fmt::format("{} value{}", found, found == 1 ? "" : "s"),
                       fmt::format("{} ({})", expected, described_names(format_)));
    }
  }

  template <typename T>
  [[noreturn]] void refuse(std::string_view field, std::size_t column, Parsed parsed, Place place) const {
    std::string_view expected = description_of_number<T>();
    if (std::is_same_v<T, double> && parsed == Parsed::OutOfRange)
      expected = "a number that a 64-bit float can hold";
    if (is_number_with_comma(field)) expected = "a number with a decimal point";
    throw InputError(source_.name, place,
                     fmt::format("{} in column {}", field.empty() ? "an empty field" : quoted(field),
                                 quoted(format_.names[column])),
                     expected);
  }

  const Source& source_;
  const RowFormat& format_;
  char line_end_;
  std::vector<Target> targets_;
};

/// Keeps the failure of the first chunk (in the order of the file) that fails.
class FirstFailure {
 public:
  /// False for chunks after one that failed: they need no work.
  [[nodiscard]] bool matters(std::size_t chunk) const {
    return chunk < chunk_.load(std::memory_order_relaxed);
  }
  void report(std::size_t chunk, std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    if (!matters(chunk)) return;
    chunk_ = chunk;
    failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::atomic<std::size_t> chunk_ = std::numeric_limits<std::size_t>::max();
  std::mutex mutex_;
  std::exception_ptr failure_;
};

/// Which integers the values of a column are.
struct IntegerRange {
  bool only_integers = true;
  bool beyond_64_bits = false;
  std::int64_t lowest = 0;
  std::uint64_t highest = 0;
  std::uint64_t not_exact = 0;  // integers that a double cannot hold

  void add(std::string_view word) {
    const std::string_view digits = word.substr(!word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0);
    const bool integer = !digits.empty() && digits.find_first_not_of("0123456789") == npos;
    const bool negative = word.starts_with('-');
    // "-0" is no integer: it would lose its sign.
    if (!integer || (negative && digits.find_first_not_of('0') == npos)) {
      only_integers = false;
      return;
    }
    if (!is_exact_double(digits)) ++not_exact;
    std::int64_t low = 0;
    std::uint64_t high = 0;
    const Parsed parsed = negative ? parse_number(word, low) : parse_number(word, high);
    beyond_64_bits |= parsed != Parsed::Ok;
    lowest = std::min(lowest, low);
    highest = std::max(highest, high);
  }

  void add(const IntegerRange& other) {
    only_integers &= other.only_integers;
    beyond_64_bits |= other.beyond_64_bits;
    lowest = std::min(lowest, other.lowest);
    highest = std::max(highest, other.highest);
    not_exact += other.not_exact;
  }

  [[nodiscard]] ScalarType type() const {
    using Limits32 = std::numeric_limits<std::int32_t>;
    if (!only_integers || beyond_64_bits) return ScalarType::Float64;
    if (lowest >= Limits32::min() && highest <= std::uint64_t{Limits32::max()}) return ScalarType::Int32;
    if (highest <= std::uint64_t{std::numeric_limits<std::int64_t>::max()}) return ScalarType::Int64;
    return lowest == 0 ? ScalarType::UInt64 : ScalarType::Float64;
  }

 private:
  static bool is_exact_double(std::string_view digits) {
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size() - 1));
    if (digits.size() <= 15) return true;
    double number = 0;
    if (parse_number(digits, number) != Parsed::Ok) return false;
    return fmt::format("{:.0f}", number) == digits;
  }
};

/// Settles the types of the inferred columns.
std::vector<ScalarType> column_types(const Scan& scan, const RowFormat& format, char line_end,
                                     Progress& progress, std::vector<std::string>& notes) {
  std::vector<ScalarType> types = format.types;
  if (format.inferred.empty()) return types;
  using Ranges = std::vector<IntegerRange>;
  std::vector<std::size_t> place_of(types.size(), npos);  // of a column in Ranges
  for (std::size_t i = 0; i < format.inferred.size(); ++i) place_of[format.inferred[i]] = i;

  const auto add_chunk = [&](const Chunk& chunk, Ranges& ranges) {
    std::string_view rest = chunk.text;
    for (std::uint64_t rows = 0; rows < chunk.rows;) {
      const std::string_view row = row_in(take_line(rest, line_end), format);
      if (row.empty()) continue;
      ++rows;
      FieldReader fields(row, format.delimiter);
      std::string_view field;
      for (std::size_t c = 0; c < types.size() && fields.next(field); ++c)
        if (place_of[c] != npos) ranges[place_of[c]].add(format.quotes ? unquoted(field) : field);
    }
  };
  const Ranges ranges = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, scan.chunks.size()), Ranges(format.inferred.size()),
      [&](const tbb::blocked_range<std::size_t>& range, Ranges partial) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          progress.check();
          add_chunk(scan.chunks[i], partial);
        }
        return partial;
      },
      [](Ranges left, const Ranges& right) {
        for (std::size_t i = 0; i < left.size(); ++i) left[i].add(right[i]);
        return left;
      });

  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const std::size_t c = format.inferred[i];
    types[c] = scan.rows == 0 ? ScalarType::Float64 : ranges[i].type();
    if (types[c] == ScalarType::Float64 && ranges[i].not_exact > 0) {
      notes.push_back(fmt::format("column {}: {} integers were rounded to 64-bit floats",
                                  quoted(format.names[c]), ranges[i].not_exact));
    }
  }
  return types;
}

/// Fills the columns; returns where in the last chunk with rows the last row ends.
RowParser::End parse_rows(const Scan& scan, const RowParser& parser, Progress& progress) {
  FirstFailure failure;
  RowParser::End last_end;
  tbb::parallel_for(std::size_t{0}, scan.chunks.size(), [&](std::size_t i) {
    const Chunk& chunk = scan.chunks[i];
    progress.check();
    if (chunk.rows == 0 || !failure.matters(i)) return;
    try {
      const RowParser::End end = parser.parse(chunk);
      if (chunk.first_row + chunk.rows == scan.rows) last_end = end;
      progress.advance(std::max(end.bytes, chunk.reported) - chunk.reported);
    } catch (...) {
      failure.report(i, std::current_exception());
    }
  });
  failure.rethrow();
  return last_end;
}

void require_complete(const Source& source, const Scan& scan, std::uint64_t first_line,
                      std::optional<std::uint64_t> count) {
  if (scan.zero_byte_line && scan.rows < count.value_or(no_limit))
    throw InputError(source.name, Place::line(*scan.zero_byte_line), "a zero byte", "text");
  if (scan.rows < count.value_or(0)) {
    throw InputError(source.name, Place::line(first_line + std::max<std::uint64_t>(scan.lines, 1) - 1),
                     fmt::format("the end of the file after {} rows", scan.rows),
                     fmt::format("{} rows", *count));
  }
}

}  // namespace

Rows read_rows(const Source& source, std::string_view text, std::uint64_t first_line, const RowFormat& format,
               std::optional<std::uint64_t> count, Progress& progress) {
  assert(!format.names.empty() && format.names.size() == format.types.size());
  const char line_end = line_end_of(text);
  const Scan scan = find_rows(text, first_line, format, line_end, count.value_or(no_limit), progress);
  if (scan.rows > max_points) {
    throw InputError(source.name, Place::file(), fmt::format("{} rows", scan.rows),
                     fmt::format("at most {}", max_points));
  }

  Rows rows;
  rows.count = scan.rows;
  const std::vector<ScalarType> types = column_types(scan, format, line_end, progress, rows.notes);
  std::size_t row_size = 0;
  for (const ScalarType type : types) row_size += size_of(type);
  require_memory(scan.rows * row_size, "reading rows");
  for (std::size_t c = 0; c < types.size(); ++c)
    rows.columns.emplace_back(format.names[c], types[c], scan.rows);
  const RowParser parser(source, format, line_end, rows.columns);
  const RowParser::End end = parse_rows(scan, parser, progress);
  require_complete(source, scan, first_line, count);

  rows.next_line = first_line;
  const auto last = std::find_if(scan.chunks.rbegin(), scan.chunks.rend(),
                                 [](const Chunk& chunk) { return chunk.rows > 0; });
  if (last != scan.chunks.rend()) {
    rows.consumed = static_cast<std::size_t>(last->text.data() - text.data()) + end.bytes;
    rows.next_line = last->first_line + end.lines;
  }
  return rows;
}

}  // namespace keenline
