#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "keenline/cloud.h"

namespace keenline {

/// Collects the vertex numbers of faces or polylines, row by row, into a table with the integer list column
/// "vertex_indices".
class FaceBuilder {
 public:
  /// One more row, which may be empty. \throw InvalidArgument when the row is longer than 2^31 - 1.
  void add(std::span<const std::uint32_t> vertices);
  [[nodiscard]] std::size_t rows() const { return offsets_.size() - 1; }
  /// The rows so far as a table; the builder is empty afterwards. Numbers are int32, or uint32 when one of
  /// them needs it; list lengths are uint8, or int32 when one of them needs it.
  [[nodiscard]] Table finish(std::string table_name = "face");

 private:
  std::vector<std::uint64_t> offsets_{0};
  std::vector<std::byte>
      bytes_;  // 32-bit numbers: the same bits for int32 and uint32 as long as int32 can hold them
  std::uint32_t largest_ = 0;
  std::size_t longest_ = 0;
};

/// Words for a message, when a vertex number is not one: "a vertex number from 0 to 7".
[[nodiscard]] std::string expected_vertex_number(std::uint64_t first, std::uint64_t vertex_count);

}  // namespace keenline
