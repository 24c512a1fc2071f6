#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

/// The shortest decimal that reads back to the same double; minus zero becomes 0. \pre value is finite
void append_number(std::string& text, double value);

/// "[x, y, z]"
void append_json(std::string& text, const Point& point);

/// In quotes; what is not UTF-8 becomes U+FFFD, as JSON must be.
void append_json(std::string& text, std::string_view value);

/// "[a, b, …]", each value as `append(text, value)` gives it.
template <typename T, typename Append>
void append_json_list(std::string& text, const std::vector<T>& values, const Append& append) {
  text += '[';
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) text += ", ";
    append(text, values[i]);
  }
  text += ']';
}

}  // namespace keenline
