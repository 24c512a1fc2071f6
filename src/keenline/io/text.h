#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace keenline {

/// Walks through the lines of a text: "\n" and "\r\n" end a line, a lone "\r" too when the text has no "\n"
/// at its first line end. The end of the text ends the last line.
class LineReader {
 public:
  explicit LineReader(std::string_view text, std::uint64_t first_line_number = 1);
  /// False at the end of the text. `line` comes without its line end.
  [[nodiscard]] bool next(std::string_view& line);
  /// Number of the line that next() gave last, from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// What next() has not yet given.
  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
  std::uint64_t number_;
  char end_ = '\n';
};

/// Takes the first blank-separated (space, tab) word off `text`; empty when there is none left.
[[nodiscard]] std::string_view take_word(std::string_view& text);

/// `text` without spaces, tabs and carriage returns at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// `text` without a UTF-8 byte order mark at its start.
[[nodiscard]] std::string_view without_bom(std::string_view text);

[[nodiscard]] bool starts_with_ignoring_case(std::string_view text, std::string_view lower_case_prefix);

enum class Parsed : std::uint8_t { Ok, NotANumber, OutOfRange };

/// The whole of `word` as a number of type T (any scalar type of cloud.h), independent of locale.
/// Floating point: decimal or exponent notation, nan and inf in any case, leading '+'. Overflow is OutOfRange
/// (underflow rounds). Integers: decimal digits with sign; also a decimal fraction that is a whole number
/// ("255.0").
template <typename T>
[[nodiscard]] Parsed parse_number(std::string_view word, T& value);

/// Words for a message: "a number", "an integer from 0 to 255".
template <typename T>
[[nodiscard]] std::string_view description_of_number();

/// 1234567 as "1,234,567".
[[nodiscard]] std::string grouped(std::uint64_t number);

}  // namespace keenline
