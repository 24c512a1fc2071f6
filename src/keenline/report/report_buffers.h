#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "keenline/cloud.h"

namespace keenline {

/// How the bytes of a buffer lie, so that they deflate well: see docs/report-format.md.
enum class BufferCoding : std::uint8_t {
  Raw,     ///< as in memory
  Planes,  ///< all lowest bytes, then all second bytes, …
  Delta    ///< differences to the number before, with the sign folded in; then planes
};

/// "raw", "planes", "delta".
[[nodiscard]] std::string_view name_of(BufferCoding coding);

/// Integers of one type, some for every point, as a report holds them: little endian.
struct ReportBuffer {
  std::string name;
  ScalarType type = ScalarType::UInt8;
  std::size_t components = 1;  ///< numbers of a tuple
  std::size_t count = 0;       ///< tuples
  BufferCoding coding = BufferCoding::Raw;
  std::string bytes;
};

/// A difference in the arithmetic of T: 0, -1, 1, -2, … become 0, 1, 2, 3, …, small whatever their sign.
template <std::unsigned_integral T>
[[nodiscard]] constexpr T folded(T difference) {
  const auto sign = static_cast<T>(0U - (difference >> (8 * sizeof(T) - 1)));
  return static_cast<T>(static_cast<T>(difference << 1U) ^ sign);
}

/// `values` holds tuple after tuple. T is an unsigned integer of 8, 16 or 32 bits.
/// \pre values.size() is a multiple of components
template <typename T>
[[nodiscard]] ReportBuffer encoded(std::string name, std::span<const T> values, std::size_t components,
                                   BufferCoding coding);

}  // namespace keenline
