#include "keenline/io/graph_text.h"

#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace keenline {
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
  using Json = nlohmann::json;
  text += Json(value).dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace keenline
