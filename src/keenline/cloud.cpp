#include "keenline/cloud.h"

#include <algorithm>
#include <cassert>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {

std::size_t size_of(ScalarType type) {
  return visit_type(type, [](auto zero) { return sizeof(zero); });
}

std::string_view name_of(ScalarType type) {
  switch (type) {
    case ScalarType::Int8: return "int8";
    case ScalarType::UInt8: return "uint8";
    case ScalarType::Int16: return "int16";
    case ScalarType::UInt16: return "uint16";
    case ScalarType::Int32: return "int32";
    case ScalarType::UInt32: return "uint32";
    case ScalarType::Int64: return "int64";
    case ScalarType::UInt64: return "uint64";
    case ScalarType::Float32: return "float32";
    case ScalarType::Float64: break;
  }
  return "float64";
}

Column::Column(std::string name, ScalarType type, std::size_t rows)
    : name_(std::move(name)), type_(type), bytes_(rows * size_of(type)) {}

Column::Column(std::string name, ScalarType type, ScalarType count_type, std::vector<std::uint64_t> offsets,
               std::vector<std::byte> bytes)
    : name_(std::move(name)),
      type_(type),
      count_type_(count_type),
      bytes_(std::move(bytes)),
      offsets_(std::move(offsets)) {
  if (offsets_.empty() || offsets_.front() != 0 || !std::is_sorted(offsets_.begin(), offsets_.end()) ||
      offsets_.back() * size_of(type_) != bytes_.size())
    throw InvalidArgument(fmt::format("column {}: list offsets do not match its values", quoted(name_)));
}

std::size_t Column::rows() const { return is_list() ? offsets_.size() - 1 : value_count(); }

double Column::value(std::size_t i) const {
  assert(i < value_count());
  return visit_type(type_, [&](auto zero) { return static_cast<double>(values<decltype(zero)>()[i]); });
}

const Column* PointCloud::attribute(std::string_view name) const {
  const auto found =
      std::find_if(attributes.begin(), attributes.end(), [&](const Column& c) { return c.name() == name; });
  return found == attributes.end() ? nullptr : &*found;
}

void PointCloud::set_attribute(Column column) {
  if (column.rows() != size())
    throw InvalidArgument(fmt::format("attribute {} has {} rows, the cloud has {} points",
                                      quoted(column.name()), column.rows(), size()));
  const auto found = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const Column& c) { return c.name() == column.name(); });
  if (found == attributes.end()) attributes.push_back(std::move(column));
  else *found = std::move(column);
}

std::size_t count_finite(const PointCloud& cloud) {
  return static_cast<std::size_t>(std::count_if(cloud.positions.begin(), cloud.positions.end(), is_finite));
}

}  // namespace keenline
