#include "keenline/order_statistics.h"

#include <algorithm>

namespace keenline {

template <typename T>
T nth_smallest(std::vector<T>& values, std::size_t n) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(n);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

template float nth_smallest<float>(std::vector<float>&, std::size_t);
template double nth_smallest<double>(std::vector<double>&, std::size_t);

}  // namespace keenline
