#pragma once

#include <array>
#include <cstddef>

namespace keenline::synth {

/// A polynomial of degree at most 4; coefficients from the constant up.
using Quartic = std::array<double, 5>;

struct Roots {
  std::array<double, 4> values{};
  std::size_t count = 0;

  [[nodiscard]] const double* begin() const { return values.data(); }
  [[nodiscard]] const double* end() const { return values.data() + count; }
};

/// Where the polynomial changes sign in [low, high], ascending, to the last few bits. Where it only touches
/// zero, there may or may not be a root.
[[nodiscard]] Roots roots_of(const Quartic& polynomial, double low, double high);

}  // namespace keenline::synth
