#pragma once

#include <cstddef>
#include <vector>

namespace keenline {

/// The value that would be at place n if the values were sorted. They are put in another order. T is float or
/// double. \pre n < size; no NaN
template <typename T>
[[nodiscard]] T nth_smallest(std::vector<T>& values, std::size_t n);

/// The middle one; of an even number of values the upper one of the two. They are put in another order.
/// \pre not empty; no NaN
template <typename T>
[[nodiscard]] T median(std::vector<T>& values) {
  return nth_smallest(values, values.size() / 2);
}

/// The same with the lower one of the two.
template <typename T>
[[nodiscard]] T lower_median(std::vector<T>& values) {
  return nth_smallest(values, (values.size() - 1) / 2);
}

}  // namespace keenline
