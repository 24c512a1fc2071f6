#include "keenline/io/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

namespace keenline {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::string_view blanks_and_returns = " \t\r";

bool is_infinity_word(std::string_view word) {
  if (!word.empty() && (word.front() == '-' || word.front() == '+')) word.remove_prefix(1);
  return !word.empty() && (word.front() == 'i' || word.front() == 'I');
}

std::string_view without_plus(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+') word.remove_prefix(1);
  return word;
}

template <typename Float>
Parsed parse_float(std::string_view word, Float& value) {
  word = without_plus(word);
  const char* const end = word.data() + word.size();
  const auto result = fast_float::from_chars(word.data(), end, value);
  if (word.empty() || result.ptr != end) return Parsed::NotANumber;
  // fast_float up to version 3 gives infinity for what is too large, later ones an error code with the same
  // value.
  if (std::isinf(value) && !is_infinity_word(word)) return Parsed::OutOfRange;
  if (result.ec != std::errc() && result.ec != std::errc::result_out_of_range) return Parsed::NotANumber;
  return Parsed::Ok;
}

template <typename Integer>
Parsed parse_integer(std::string_view word, Integer& value) {
  word = without_plus(word);
  const char* const end = word.data() + word.size();
  const auto result = std::from_chars(word.data(), end, value);
  if (result.ptr == end && !word.empty()) {
    if (result.ec == std::errc()) return Parsed::Ok;
    if (result.ec == std::errc::result_out_of_range) return Parsed::OutOfRange;
  }
  // "-1" for an unsigned type and "255.0" for any land here.
  double number = 0;
  if (parse_float(word, number) != Parsed::Ok || number != std::floor(number)) return Parsed::NotANumber;
  constexpr double two_to_53 = 9007199254740992.0;
  if (std::isinf(number) || std::abs(number) >= two_to_53 ||
      number < static_cast<double>(std::numeric_limits<Integer>::min()) ||
      number > static_cast<double>(std::numeric_limits<Integer>::max()))
    return Parsed::OutOfRange;
  value = static_cast<Integer>(number);
  return Parsed::Ok;
}

}  // namespace

LineReader::LineReader(std::string_view text, std::uint64_t first_line_number)
    : rest_(text), number_(first_line_number - 1) {
  const std::size_t first_end = text.find_first_of("\r\n");
  if (first_end != std::string_view::npos && text[first_end] == '\r' && text.substr(first_end + 1, 1) != "\n")
    end_ = '\r';
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find(end_);
  line = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (end_ == '\n' && line.ends_with('\r')) line.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks_and_returns), text.size()));
  return text.substr(0, text.find_last_not_of(blanks_and_returns) + 1);
}

std::string_view without_bom(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

bool starts_with_ignoring_case(std::string_view text, std::string_view lower_case_prefix) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return text.size() >= lower_case_prefix.size() &&
         std::equal(lower_case_prefix.begin(), lower_case_prefix.end(), text.begin(),
                    [&](char expected, char c) { return lower(c) == expected; });
}

template <typename T>
Parsed parse_number(std::string_view word, T& value) {
  if constexpr (std::is_floating_point_v<T>) return parse_float(word, value);
  else return parse_integer(word, value);
}

template <typename T>
std::string_view description_of_number() {
  if constexpr (std::is_same_v<T, std::int8_t>) return "an integer from -128 to 127";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "an integer from 0 to 255";
  if constexpr (std::is_same_v<T, std::int16_t>) return "an integer from -32768 to 32767";
  if constexpr (std::is_same_v<T, std::uint16_t>) return "an integer from 0 to 65535";
  if constexpr (std::is_same_v<T, std::int32_t>) return "an integer from -2147483648 to 2147483647";
  if constexpr (std::is_same_v<T, std::uint32_t>) return "an integer from 0 to 4294967295";
  if constexpr (std::is_same_v<T, std::int64_t>) return "a 64-bit integer";
  if constexpr (std::is_same_v<T, std::uint64_t>) return "an unsigned 64-bit integer";
  if constexpr (std::is_same_v<T, float>) return "a number that a 32-bit float can hold";
  if constexpr (std::is_same_v<T, double>) return "a number";
}

// NOLINTBEGIN(bugprone-macro-parentheses): T is a type
#define KEENLINE_INSTANTIATE(T)                          \
  template Parsed parse_number<T>(std::string_view, T&); \
  template std::string_view description_of_number<T>();
KEENLINE_INSTANTIATE(std::int8_t)
KEENLINE_INSTANTIATE(std::uint8_t)
KEENLINE_INSTANTIATE(std::int16_t)
KEENLINE_INSTANTIATE(std::uint16_t)
KEENLINE_INSTANTIATE(std::int32_t)
KEENLINE_INSTANTIATE(std::uint32_t)
KEENLINE_INSTANTIATE(std::int64_t)
KEENLINE_INSTANTIATE(std::uint64_t)
KEENLINE_INSTANTIATE(float)
KEENLINE_INSTANTIATE(double)
#undef KEENLINE_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

std::string grouped(std::uint64_t number) {
  std::string digits = fmt::format("{}", number);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, ",");
  return digits;
}

}  // namespace keenline
