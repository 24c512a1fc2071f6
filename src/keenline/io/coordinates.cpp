#include "keenline/io/coordinates.h"

#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <type_traits>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/io/records.h"
#include "keenline/io/text.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

template <typename Body>
void for_blocks(std::size_t count, const Progress& progress, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16384),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      progress.check();
                      body(range.begin(), range.end());
                    });
}

/// Whether `value`, read from a text, is how some program prints a float: rounded to some number of digits.
bool is_printed_float(double value) {
  if (!std::isfinite(value)) return true;
  if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max())) return false;
  const auto nearest = static_cast<double>(static_cast<float>(value));
  if (nearest == value) return true;
  std::array<char, 64> text{};
  for (int digits_after_first = 5; digits_after_first <= 16; ++digits_after_first) {
    const auto printed = std::to_chars(text.data(), text.data() + text.size(), nearest,
                                       std::chars_format::scientific, digits_after_first);
    double back = 0;
    if (parse_number({text.data(), static_cast<std::size_t>(printed.ptr - text.data())}, back) ==
            Parsed::Ok &&
        back == value)
      return true;
  }
  return false;
}

bool all_are_printed_floats(std::span<const double> values, const Progress& progress) {
  std::atomic<bool> all{true};
  for_blocks(values.size(), progress, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end && all.load(std::memory_order_relaxed); ++i)
      if (!is_printed_float(values[i])) all = false;
  });
  return all;
}

}  // namespace

ScalarType parsed_coordinate_type(ScalarType declared) {
  return declared == ScalarType::Float32 ? ScalarType::Float64 : declared;
}

std::optional<std::size_t> set_axis(PointCloud& cloud, std::size_t axis, const Column& column,
                                    ScalarType declared, const Progress& progress) {
  std::optional<std::size_t> inexact;
  visit_type(column.type(), [&](auto zero) {
    using T = decltype(zero);
    const auto values = column.values<T>();
    if constexpr (std::is_integral_v<T> && sizeof(T) == 8) {
      for (std::size_t i = 0; i < values.size() && !inexact; ++i) {
        if (i % 65536 == 0) progress.check();
        if (!is_exact_in_double(values[i])) inexact = i;
      }
      if (inexact) return;
    }
    if constexpr (std::is_same_v<T, double>) {
      if (declared == ScalarType::Float32 && all_are_printed_floats(values, progress)) {
        cloud.position_types[axis] = declared;
        for_blocks(values.size(), progress, [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            cloud.positions[i][axis] = static_cast<double>(static_cast<float>(values[i]));
        });
        return;
      }
    }
    cloud.position_types[axis] = column.type();
    for_blocks(values.size(), progress, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) cloud.positions[i][axis] = static_cast<double>(values[i]);
    });
  });
  return inexact;
}

std::string number_text(const Column& column, std::size_t i) {
  return visit_type(column.type(),
                    [&](auto zero) { return fmt::format("{}", column.values<decltype(zero)>()[i]); });
}

}  // namespace keenline
