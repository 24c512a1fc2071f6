#pragma once

#include <vector>

#include "keenline/cloud.h"

namespace keenline {

/// Exponent e such that distances between finite points times 2^-e square safely: without overflow, and
/// without underflow where different coordinates are within 300 decades. 0 for all but extreme clouds.
/// Threads: any number, same result. Cost: O(n).
[[nodiscard]] int safe_exponent(const std::vector<Point>& positions);

/// The point times 2^-exponent; what would be larger than 2^500 then, as one outlier may be, is 2^500.
[[nodiscard]] Point safely_scaled(const Point& p, int exponent);

}  // namespace keenline
