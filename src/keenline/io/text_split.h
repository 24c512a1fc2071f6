#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace keenline {

/// What ends the lines of `text`: '\n' (also before "\r\n"), or '\r' when the first line ends with a lone
/// one.
[[nodiscard]] char line_end_of(std::string_view text);

/// Takes the first line off `text`; it comes without its line end.
[[nodiscard]] std::string_view take_line(std::string_view& text, char line_end);

/// `line` up to a '#' or "//" that is not between double quotes.
[[nodiscard]] std::string_view without_comment(std::string_view line);

/// Walks through the fields of a line. Delimiter ' ': words between runs of spaces and tabs; another: what
/// stands between delimiters, trimmed, perhaps empty. Quotes have no meaning here.
class FieldReader {
 public:
  FieldReader(std::string_view line, char delimiter) : rest_(line), delimiter_(delimiter) {}
  [[nodiscard]] bool next(std::string_view& field);

 private:
  std::string_view rest_;
  char delimiter_;
  bool ended_ = false;
};

[[nodiscard]] std::size_t count_fields(std::string_view line, char delimiter);

/// `field` without a pair of double quotes around it.
[[nodiscard]] std::string_view unquoted(std::string_view field);

/// The fields of a line in which quotes have the meaning of RFC 4180: delimiters between them do not count,
/// and two in a row are one. A delimiter after the last field is not followed by another, empty field.
[[nodiscard]] std::vector<std::string> split_quoted(std::string_view line, char delimiter);

/// The first of ';', ',' and tab that stands in the line outside of quotes, else ' '.
[[nodiscard]] char guess_delimiter(std::string_view line);

/// "1,5": a number in the notation of many languages, but not of any point cloud format.
[[nodiscard]] bool is_number_with_comma(std::string_view word);

}  // namespace keenline
