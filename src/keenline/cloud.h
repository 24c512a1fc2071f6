#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace keenline {

using Point = std::array<double, 3>;

/// How one number is stored in a file and in a column.
enum class ScalarType : std::uint8_t {
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

[[nodiscard]] std::size_t size_of(ScalarType type);
/// "int8" … "float64".
[[nodiscard]] std::string_view name_of(ScalarType type);

/// The ScalarType that stores a C++ arithmetic type.
template <typename T>
[[nodiscard]] consteval ScalarType scalar_type_of();

/// One named column: a number, or a list of numbers, per row. Values keep the type they had in the file.
class Column {
 public:
  /// `rows` zeros.
  Column(std::string name, ScalarType type, std::size_t rows);
  /// One number per row.
  template <typename T>
  Column(std::string name, const std::vector<T>& values);
  /// Lists: row i holds values offsets[i] … offsets[i+1]-1; `bytes` holds offsets.back() values of `type`.
  /// `count_type` is how the file stored each list's length.
  /// \throw InvalidArgument when offsets do not rise from 0 to the number of values.
  Column(std::string name, ScalarType type, ScalarType count_type, std::vector<std::uint64_t> offsets,
         std::vector<std::byte> bytes);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] ScalarType type() const { return type_; }
  [[nodiscard]] bool is_list() const { return !offsets_.empty(); }
  [[nodiscard]] ScalarType count_type() const { return count_type_; }
  [[nodiscard]] std::size_t rows() const;
  /// Number of values in all rows together (rows() unless this is a list).
  [[nodiscard]] std::size_t value_count() const { return bytes_.size() / size_of(type_); }
  /// Lists only: rows() + 1 positions into the values.
  [[nodiscard]] std::span<const std::uint64_t> offsets() const { return offsets_; }

  /// Value number `i` (of a list column: of all lists strung together) as a double; 64-bit integers may
  /// round.
  [[nodiscard]] double value(std::size_t i) const;

  /// The values as they are stored. \pre scalar_type_of<T>() == type()
  template <typename T>
  [[nodiscard]] std::span<const T> values() const;
  template <typename T>
  [[nodiscard]] std::span<T> values();
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::span<std::byte> bytes() { return bytes_; }

  void rename(std::string name) { name_ = std::move(name); }

 private:
  std::string name_;
  ScalarType type_;
  ScalarType count_type_ = ScalarType::UInt8;
  std::vector<std::byte> bytes_;        // operator new aligns for every scalar type
  std::vector<std::uint64_t> offsets_;  // empty unless a list
};

/// A named group of rows beside the points: PLY's elements, the faces of a mesh.
/// Faces are the table "face" with the integer list column "vertex_indices".
struct Table {
  std::string name;
  std::size_t rows = 0;
  std::vector<Column> columns;
};

/// Points in the order of the file, with everything the file said about them.
struct PointCloud {
  std::vector<Point> positions;
  /// How each coordinate was stored in the file, and will be stored in an output.
  std::array<ScalarType, 3> position_types{ScalarType::Float64, ScalarType::Float64, ScalarType::Float64};
  std::vector<Column> attributes;  ///< one row per point; names are unique
  std::vector<Table> tables;       ///< what else the file holds; carried through to outputs that can hold it
  std::vector<std::string> comments;  ///< free text lines of the file; carried through

  [[nodiscard]] std::size_t size() const { return positions.size(); }
  /// nullptr when there is none of that name.
  [[nodiscard]] const Column* attribute(std::string_view name) const;
  /// Adds the column, or replaces the one of that name. \throw InvalidArgument unless it has size() rows.
  void set_attribute(Column column);
};

[[nodiscard]] inline bool is_finite(const Point& p) {
  // A sum of absolute values could overflow; x - x is 0 for every finite x and NaN otherwise.
  return p[0] - p[0] == 0 && p[1] - p[1] == 0 && p[2] - p[2] == 0;
}
[[nodiscard]] std::size_t count_finite(const PointCloud& cloud);

/// Points are numbered by 32-bit indices everywhere.
inline constexpr std::uint64_t max_points = 0xFFFF'FFFEU;

/// Calls `function` with a value-initialised T of the C++ type that `type` stores: visit_type(t, [&](auto
/// zero) {…}).
template <typename Function>
decltype(auto) visit_type(ScalarType type, Function&& function);

// --- templates
// -------------------------------------------------------------------------------------------------

template <typename T>
consteval ScalarType scalar_type_of() {
  if constexpr (std::is_same_v<T, std::int8_t>) return ScalarType::Int8;
  if constexpr (std::is_same_v<T, std::uint8_t>) return ScalarType::UInt8;
  if constexpr (std::is_same_v<T, std::int16_t>) return ScalarType::Int16;
  if constexpr (std::is_same_v<T, std::uint16_t>) return ScalarType::UInt16;
  if constexpr (std::is_same_v<T, std::int32_t>) return ScalarType::Int32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return ScalarType::UInt32;
  if constexpr (std::is_same_v<T, std::int64_t>) return ScalarType::Int64;
  if constexpr (std::is_same_v<T, std::uint64_t>) return ScalarType::UInt64;
  if constexpr (std::is_same_v<T, float>) return ScalarType::Float32;
  if constexpr (std::is_same_v<T, double>) return ScalarType::Float64;
}

template <typename T>
std::span<const T> Column::values() const {
  return {reinterpret_cast<const T*>(bytes_.data()), value_count()};
}
template <typename T>
std::span<T> Column::values() {
  return {reinterpret_cast<T*>(bytes_.data()), value_count()};
}
template <typename T>
Column::Column(std::string name, const std::vector<T>& values)
    : Column(std::move(name), scalar_type_of<T>(), values.size()) {
  std::copy(values.begin(), values.end(), this->values<T>().begin());
}

template <typename Function>
decltype(auto) visit_type(ScalarType type, Function&& function) {
  switch (type) {
    case ScalarType::Int8: return function(std::int8_t{});
    case ScalarType::UInt8: return function(std::uint8_t{});
    case ScalarType::Int16: return function(std::int16_t{});
    case ScalarType::UInt16: return function(std::uint16_t{});
    case ScalarType::Int32: return function(std::int32_t{});
    case ScalarType::UInt32: return function(std::uint32_t{});
    case ScalarType::Int64: return function(std::int64_t{});
    case ScalarType::UInt64: return function(std::uint64_t{});
    case ScalarType::Float32: return function(float{});
    case ScalarType::Float64: break;
  }
  return function(double{});
}

}  // namespace keenline
