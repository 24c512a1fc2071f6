#include "keenline/errors.h"

#include <system_error>

#include <fmt/format.h>

namespace keenline {
namespace {

/// Length of the valid UTF-8 sequence that starts text[i] and is not a control character; 0 when there is
/// none.
std::size_t printable_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
  };
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned lead = byte(0);
  if (lead >= 0x20 && lead < 0x7F) return 1;
  // U+0080 … U+009F are control characters too (terminals act on them), hence the stricter second byte after
  // 0xC2; U+2028, U+2029 and the bidirectional controls U+202A … U+202E, U+2066 … U+2069 can forge or reorder
  // a line.
  if (lead >= 0xC2 && lead <= 0xDF && continues(1)) return lead == 0xC2 && byte(1) < 0xA0 ? 0 : 2;
  if (lead >= 0xE0 && lead <= 0xEF && continues(1) && continues(2)) {
    if (lead == 0xE0 && byte(1) < 0xA0) return 0;   // overlong
    if (lead == 0xED && byte(1) >= 0xA0) return 0;  // surrogates
    if (lead == 0xE2 && byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE) return 0;
    if (lead == 0xE2 && byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9) return 0;
    return 3;
  }
  if (lead >= 0xF0 && lead <= 0xF4 && continues(1) && continues(2) && continues(3)) {
    if (lead == 0xF0 && byte(1) < 0x90) return 0;   // overlong
    if (lead == 0xF4 && byte(1) >= 0x90) return 0;  // past U+10FFFF
    return 4;
  }
  return 0;
}

std::string placed(std::string_view file, Place place, std::string_view found, std::string_view expected) {
  std::string where;
  if (place.unit == Place::Unit::Line) where = fmt::format("line {}: ", place.number);
  if (place.unit == Place::Unit::Byte) where = fmt::format("byte {}: ", place.number);
  return fmt::format("{}: {}found {}, expected {}", escaped(file, 4096), where, found, expected);
}

}  // namespace

InputError::InputError(std::string_view file, Place place, std::string_view found, std::string_view expected)
    : Error(placed(file, place, found, expected)) {}

InputError::InputError(std::string_view file, std::string_view problem)
    : Error(fmt::format("{}: {}", escaped(file, 4096), problem)) {}

OutputError::OutputError(std::string_view file, std::string_view problem)
    : Error(fmt::format("{}: {}", escaped(file, 4096), problem)) {}

std::string escaped(std::string_view text, std::size_t longest) {
  std::string result;
  std::size_t i = 0;
  while (i < text.size()) {
    if (i >= longest) return result + "...";
    const std::size_t length = printable_length(text, i);
    if (length == 0) {
      result += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[i]));
      ++i;
    } else {
      result += text.substr(i, length);
      i += length;
    }
  }
  return result;
}

std::string quoted(std::string_view text, std::size_t longest) { return "'" + escaped(text, longest) + "'"; }

std::string system_message(int error_number) { return std::generic_category().message(error_number); }

}  // namespace keenline
