#include "keenline/io/graph_json.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/memory.h"

namespace keenline {
namespace {

using nlohmann::json;

/// A value with the way to it, for messages. \pre what it was taken from is still there
class Value {
 public:
  Value(const json& value, std::string_view file) : value_(&value), file_(file) {}

  [[nodiscard]] std::optional<Value> find(std::string_view name) const {
    if (!value_->is_object()) fail("an object");
    const auto found = value_->find(name);
    if (found == value_->end() || found->is_null()) return std::nullopt;
    return Value(*found, *this, name, 0);
  }
  [[nodiscard]] Value at(std::string_view name) const {
    const std::optional<Value> member = find(name);
    if (!member) fail(fmt::format("a member '{}'", name));
    return *member;
  }

  [[nodiscard]] std::size_t size() const {
    if (!value_->is_array()) fail("an array");
    return value_->size();
  }
  [[nodiscard]] Value operator[](std::size_t i) const { return Value((*value_)[i], *this, {}, i); }

  [[nodiscard]] double number() const {
    if (!value_->is_number()) fail("a number");
    return value_->get<double>();
  }
  [[nodiscard]] std::uint64_t count(std::uint64_t largest) const {
    if (!value_->is_number_unsigned() || value_->get<std::uint64_t>() > largest)
      fail(fmt::format("an integer from 0 to {}", largest));
    return value_->get<std::uint64_t>();
  }
  [[nodiscard]] bool boolean() const {
    if (!value_->is_boolean()) fail("true or false");
    return value_->get<bool>();
  }
  [[nodiscard]] const std::string& text() const {
    if (!value_->is_string()) fail("a string");
    return value_->get_ref<const std::string&>();
  }
  [[nodiscard]] bool is_null() const { return value_->is_null(); }

  [[noreturn]] void fail(std::string_view expected) const {
    throw InputError(file_,
                     fmt::format("{}: found {}, expected {}", escaped(path(), 200), found(), expected));
  }

 private:
  Value(const json& value, const Value& parent, std::string_view name, std::size_t index)
      : value_(&value), parent_(&parent), file_(parent.file_), name_(name), index_(index) {}

  [[nodiscard]] std::string path() const {
    if (parent_ == nullptr) return "the whole";
    const std::string before = parent_->parent_ == nullptr ? "" : parent_->path();
    if (name_.empty()) return fmt::format("{}[{}]", before, index_);
    return fmt::format("{}{}{}", before, before.empty() ? "" : ".", name_);
  }
  [[nodiscard]] std::string found() const {
    if (value_->is_string()) return keenline::quoted(value_->get_ref<const std::string&>());
    if (value_->is_number() || value_->is_boolean()) return value_->dump();
    if (value_->is_array()) return fmt::format("an array of {}", value_->size());
    return value_->is_null() ? "null" : "an object";
  }

  const json* value_;
  const Value* parent_ = nullptr;
  std::string_view file_;
  std::string_view name_;  // of a member; empty for the element `index_` of an array
  std::size_t index_ = 0;
};

void require_size(const Value& list, std::size_t size) {
  if (list.size() != size) list.fail(fmt::format("an array of {}", size));
}

double number_from(const Value& value) { return value.number(); }

Point point_from(const Value& value) {
  require_size(value, 3);
  return {value[0].number(), value[1].number(), value[2].number()};
}

SideNormals sides_from(const Value& value) {
  require_size(value, 2);
  return {point_from(value[0]), point_from(value[1])};
}

template <typename T>
std::vector<T> list_from(const Value& list, T (*item_from)(const Value&)) {
  std::vector<T> items;
  items.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) items.push_back(item_from(list[i]));
  return items;
}

/// Empty when there is no such member.
template <typename T>
std::vector<T> member_list(const Value& object, std::string_view name, T (*item_from)(const Value&)) {
  const std::optional<Value> list = object.find(name);
  return list ? list_from(*list, item_from) : std::vector<T>();
}

FittedCurve curve_from(const Value& value) {
  const Value type = value.at("type");
  if (type.text() == "line") return FittedLine{point_from(value.at("start")), point_from(value.at("end"))};
  if (type.text() == "arc") {
    return FittedArc{point_from(value.at("center")), point_from(value.at("normal")),
                     point_from(value.at("x_axis")), value.at("radius").number(),
                     value.at("sweep_deg").number()};
  }
  if (type.text() != "spline") type.fail("line, arc or spline");
  return FittedSpline{list_from(value.at("control_points"), point_from),
                      list_from(value.at("knots"), number_from)};
}

LineKind kind_from(const Value& value) {
  for (const LineKind kind : {LineKind::Crease, LineKind::Border})
    if (value.text() == name_of(kind)) return kind;
  value.fail("crease or border");
}

std::optional<std::uint32_t> corner_number_from(const Value& value) {
  if (value.is_null()) return std::nullopt;
  return static_cast<std::uint32_t>(value.count(std::numeric_limits<std::uint32_t>::max()));
}

GraphCorner corner_from(const Value& value) {
  GraphCorner corner{point_from(value.at("position")), {}};
  if (const auto residual = value.find("residual")) corner.residual = residual->number();
  return corner;
}

Polyline polyline_from(const Value& value) {
  Polyline line;
  line.vertices = list_from(value.at("vertices"), point_from);
  if (const auto closed = value.find("closed")) line.closed = closed->boolean();
  if (const auto kind = value.find("kind")) line.kind = kind_from(*kind);
  if (const auto corners = value.find("corners")) {
    require_size(*corners, 2);
    line.start_corner = corner_number_from((*corners)[0]);
    line.end_corner = corner_number_from((*corners)[1]);
  }
  if (const auto support = value.find("support"))
    line.support = support->count(std::numeric_limits<std::uint64_t>::max());
  line.dihedral_deg = member_list(value, "dihedral_deg", number_from);
  line.normals = member_list(value, "normals", sides_from);
  line.residual = member_list(value, "residual", number_from);
  if (const auto curve = value.find("curve")) line.fitted = curve_from(*curve);
  return line;
}

/// Each value begins behind one of these; the parsed form of one takes less than 96 bytes.
void require_memory_for(const Source& source) {
  const auto starts_value = [](char c) { return c == ',' || c == '[' || c == '{' || c == ':'; };
  const auto values = std::count_if(source.bytes.begin(), source.bytes.end(), starts_value);
  require_memory(96 * static_cast<std::uint64_t>(values) + source.bytes.size(), source.name);
}

json parse(const Source& source) {
  require_memory_for(source);
  try {
    return json::parse(source.bytes.begin(), source.bytes.end());
  } catch (const json::parse_error& e) {
    const std::size_t byte = std::min(std::max<std::size_t>(e.byte, 1) - 1, source.bytes.size());
    const std::string_view rest = source.bytes.substr(byte);
    throw InputError(source.name, Place::byte(byte), rest.empty() ? "the end of the file" : quoted(rest, 16),
                     "JSON");
  } catch (const json::out_of_range&) {
    throw InputError(source.name, "a number is too large for a double");
  }
}

}  // namespace

FeatureGraph read_graph_json(const Source& source) {
  const json document = parse(source);
  const Value root(document, source.name);
  FeatureGraph graph;
  if (const auto crs = root.find("crs")) graph.crs = crs->text();
  graph.corners = list_from(root.at("corners"), corner_from);
  graph.polylines = list_from(root.at("polylines"), polyline_from);
  try {
    validate(graph);
  } catch (const InvalidArgument& e) {
    throw InputError(source.name, e.what());
  }
  return graph;
}

}  // namespace keenline
