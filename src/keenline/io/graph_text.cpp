#include "keenline/io/graph_text.h"

#include <iterator>

#include <fmt/format.h>

namespace keenline {
namespace {

/// Length of the UTF-8 sequence that starts text[i]; 0 when there is none.
std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) {
    return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
  };
  const auto continues = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xC2 && lead <= 0xDF) return continues(1) ? 2 : 0;
  if (lead >= 0xE0 && lead <= 0xEF) {
    const bool overlong = lead == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = lead == 0xED && byte(1) >= 0xA0;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xF0 && lead <= 0xF4) {
    const bool overlong = lead == 0xF0 && byte(1) < 0x90;
    const bool too_large = lead == 0xF4 && byte(1) >= 0x90;
    return continues(1) && continues(2) && continues(3) && !overlong && !too_large ? 4 : 0;
  }
  return 0;
}

}  // namespace

void append_number(std::string& text, double value) {
  fmt::format_to(std::back_inserter(text), "{}", value + 0.0);  // -0.0 + 0.0 is 0.0
}

void append_json(std::string& text, const Point& point) {
  text += '[';
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (axis > 0) text += ", ";
    append_number(text, point[axis]);
  }
  text += ']';
}

void append_json(std::string& text, std::string_view value) {
  text += '"';
  for (std::size_t i = 0; i < value.size();) {
    const std::size_t length = utf8_length(value, i);
    const auto byte = static_cast<unsigned char>(value[i]);
    if (length == 0) text += "\xEF\xBF\xBD";
    else if (byte < 0x20) fmt::format_to(std::back_inserter(text), "\\u{:04x}", byte);
    else if (byte == '"' || byte == '\\') (text += '\\') += value[i];
    else text += value.substr(i, length);
    i += length == 0 ? 1 : length;
  }
  text += '"';
}

}  // namespace keenline
