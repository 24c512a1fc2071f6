#include "keenline/io/faces.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr std::uint32_t largest_int32 = std::numeric_limits<std::int32_t>::max();

}  // namespace

void FaceBuilder::add(std::span<const std::uint32_t> vertices) {
  if (vertices.size() > largest_int32) throw InvalidArgument("a face has more vertices than a list can hold");
  const std::span<const std::byte> bytes = std::as_bytes(vertices);
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  offsets_.push_back(bytes_.size() / sizeof(std::uint32_t));
  for (const std::uint32_t vertex : vertices) largest_ = std::max(largest_, vertex);
  longest_ = std::max(longest_, vertices.size());
}

Table FaceBuilder::finish(std::string table_name) {
  FaceBuilder rows = std::exchange(*this, FaceBuilder());
  const ScalarType type = rows.largest_ <= largest_int32 ? ScalarType::Int32 : ScalarType::UInt32;
  const ScalarType count_type = rows.longest_ <= 255 ? ScalarType::UInt8 : ScalarType::Int32;
  Table table{std::move(table_name), rows.rows(), {}};
  table.columns.emplace_back("vertex_indices", type, count_type, std::move(rows.offsets_),
                             std::move(rows.bytes_));
  return table;
}

std::string expected_vertex_number(std::uint64_t first, std::uint64_t vertex_count) {
  if (vertex_count == 0) return "no vertex number: there are no vertices";
  return fmt::format("a vertex number from {} to {}", first, vertex_count - 1 + first);
}

}  // namespace keenline
