#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

class Progress;
struct Source;

/// How the rows of a text are to be taken apart.
struct RowFormat {
  char delimiter = ' ';   ///< ' ' = any run of spaces and tabs; else ',', ';' or '\t', fields trimmed
  bool comments = false;  ///< text from '#' or "//" to the end of the line is skipped
  bool quotes = false;    ///< a number may stand between double quotes
  bool trailing_delimiter = false;  ///< every row ends with one more delimiter, with nothing after it
  std::vector<std::string> names;   ///< of the columns, for messages and results; at least one
  std::vector<ScalarType> types;    ///< of the columns
  /// Numbers of the columns whose type is found from their values, whatever `types` says of them: Int32,
  /// Int64 or UInt64, the first that holds all of them, when every value is written as an integer; else
  /// Float64.
  std::vector<std::size_t> inferred;
};

struct Rows {
  std::vector<Column> columns;
  std::uint64_t count = 0;
  std::size_t consumed = 0;        ///< bytes of `text` up to the end of the last row's line
  std::uint64_t next_line = 0;     ///< number of the line after it
  std::vector<std::string> notes;  ///< what an inferred column could not hold exactly
};

/// Parses a text of numbers into columns, in parallel; the result does not depend on the number of threads.
/// Lines that are blank (or all comment) are no rows. A row must have exactly one number per column.
/// Memory follows the rows that are there, never `count`.
/// \param text what to parse, a part of source.bytes that begins with line number `first_line`
/// \param count exactly so many rows, then stop; without it, all rows up to the end of the text
/// \throw InputError for the first line (in the order of the file) that is not understood, or when rows are
/// missing, or when there are more than max_points; Cancelled.
[[nodiscard]] Rows read_rows(const Source& source, std::string_view text, std::uint64_t first_line,
                             const RowFormat& format, std::optional<std::uint64_t> count, Progress& progress);

}  // namespace keenline
