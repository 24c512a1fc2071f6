#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "keenline/cloud.h"

namespace keenline {

class Progress;

/// `value` with its bytes in the opposite order.
template <typename T>
[[nodiscard]] T byte_swapped(T value) {
  if constexpr (sizeof(T) == 2)
    return std::bit_cast<T>(__builtin_bswap16(std::bit_cast<std::uint16_t>(value)));
  if constexpr (sizeof(T) == 4)
    return std::bit_cast<T>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  if constexpr (sizeof(T) == 8)
    return std::bit_cast<T>(__builtin_bswap64(std::bit_cast<std::uint64_t>(value)));
  return value;
}

/// The T stored at `bytes`, at any alignment.
template <typename T>
[[nodiscard]] T load(const char* bytes, std::endian order = std::endian::little) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return order == std::endian::native ? value : byte_swapped(value);
}

/// Stores `value` little endian at `bytes`, at any alignment.
template <typename T>
void store(T value, char* bytes) {
  if constexpr (std::endian::native != std::endian::little) value = byte_swapped(value);
  std::memcpy(bytes, &value, sizeof value);
}

/// Whether a double holds this value exactly. Only 64-bit integers can fail.
template <typename T>
[[nodiscard]] bool is_exact_in_double(T value) {
  if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
    const double rounded = static_cast<double>(value);
    // The largest integers round up to a power of two that does not convert back.
    return rounded < static_cast<double>(std::numeric_limits<T>::max()) && static_cast<T>(rounded) == value;
  }
  return true;
}

/// Records of one size, one after another.
struct Records {
  const char* data = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;  ///< bytes from one record to the next
  std::endian order = std::endian::little;
};

/// One field of every record.
struct RecordField {
  std::size_t offset = 0;  ///< of its first value in the record
  ScalarType type = ScalarType::UInt8;
  std::size_t values = 1;       ///< so many values, one after another
  std::byte* target = nullptr;  ///< where the values of all records go, packed
};

/// Takes records apart, in parallel. Reports progress in bytes.
/// \pre every field lies within the stride; every target has room for count * values of its type. \throw
/// Cancelled.
void unpack_records(const Records& records, std::span<const RecordField> fields, Progress& progress);

}  // namespace keenline
