#include "keenline/synth/polynomial.h"

#include <cmath>

namespace keenline::synth {
namespace {

struct ValueAndSlope {
  double value = 0;
  double slope = 0;
};

ValueAndSlope evaluate(const Quartic& p, std::size_t degree, double x) {
  ValueAndSlope result{p[degree], 0};
  for (std::size_t i = degree; i-- > 0;) {
    result.slope = result.slope * x + result.value;
    result.value = result.value * x + p[i];
  }
  return result;
}

/// Newton's method, with bisection wherever it would leave the bracket. \pre the signs at `low` and `high`
/// differ
double root_between(const Quartic& p, std::size_t degree, double low, double high, bool rising) {
  double x = 0.5 * (low + high);
  for (int step = 0; step < 200; ++step) {
    const auto [value, slope] = evaluate(p, degree, x);
    if (value == 0) return x;
    ((value < 0) == rising ? low : high) = x;
    double next = x - value / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == x || std::abs(next - x) <= 1e-16 * std::abs(x)) return next;
    x = next;
  }
  return x;
}

Roots roots_of(const Quartic& p, std::size_t degree, double low, double high) {
  Roots roots;
  while (degree > 0 && p[degree] == 0) --degree;
  if (degree == 0) return roots;
  // Between its extrema the polynomial is monotonic.
  Quartic derivative{};
  for (std::size_t i = 1; i <= degree; ++i) derivative[i - 1] = static_cast<double>(i) * p[i];
  const Roots extrema = roots_of(derivative, degree - 1, low, high);

  double a = low;
  double value_a = evaluate(p, degree, a).value;
  for (std::size_t piece = 0; piece <= extrema.count; ++piece) {
    const double b = piece < extrema.count ? extrema.values[piece] : high;
    const double value_b = evaluate(p, degree, b).value;
    if ((value_a < 0) != (value_b < 0))
      roots.values[roots.count++] = root_between(p, degree, a, b, value_a < 0);
    a = b;
    value_a = value_b;
  }
  return roots;
}

}  // namespace

Roots roots_of(const Quartic& polynomial, double low, double high) {
  return roots_of(polynomial, 4, low, high);
}

}  // namespace keenline::synth
