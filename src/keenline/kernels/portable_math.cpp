#include "keenline/kernels/portable_math.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace keenline::kernels {
namespace {

constexpr double ln2_high = 0x1.62e42fee00000p-1;  // few bits: its multiples by an exponent are exact
constexpr double ln2_low = 0x1.a39ef35793c76p-33;

/// Sum of coefficients[i] * x^i.
template <std::size_t N>
double horner(const std::array<double, N>& coefficients, double x) {
  double sum = 0;
  for (std::size_t i = N; i-- > 0;) sum = sum * x + coefficients[i];
  return sum;
}

/// Taylor series in x^2 of sin(x)/x (first = 1) and of cos(x) (first = 0): alternating 1/(2i + first)!
template <std::size_t N>
constexpr std::array<double, N> alternating_factorials(int first) {
  std::array<double, N> series{};
  double term = 1;
  for (std::size_t i = 0; i < N; ++i) {
    series[i] = term;
    const int n = 2 * static_cast<int>(i) + first;
    term /= -(n + 1.0) * (n + 2.0);
  }
  return series;
}

/// Taylor series in x^2 of cosh(x) (first = 0) and of sinh(x)/x (first = 1): 1/(2i + first)!
template <std::size_t N>
constexpr std::array<double, N> reciprocal_factorials(int first) {
  std::array<double, N> series{};
  double factorial = 1;  // exact up to 18!
  for (std::size_t i = 0; i < N; ++i) {
    series[i] = 1 / factorial;
    const int n = 2 * static_cast<int>(i) + first;
    factorial *= (n + 1.0) * (n + 2.0);
  }
  return series;
}

/// 1, sign/3, 1/5, sign/7, …
template <std::size_t N>
constexpr std::array<double, N> odd_reciprocals(double sign) {
  std::array<double, N> series{};
  for (std::size_t i = 0; i < N; ++i)
    series[i] = (i % 2 == 0 ? 1 : sign) / (2.0 * static_cast<double>(i) + 1);
  return series;
}

/// x in [0, 1].
double arc_tangent(double x) {
  constexpr double tan_of_eighth = 0.41421356237309503;  // tan(pi/8): beyond it, turn by pi/4 first
  static constexpr auto series = odd_reciprocals<24>(-1);
  if (x <= tan_of_eighth) return x * horner(series, x * x);
  const double turned = (x - 1) / (x + 1);
  return pi / 4 + turned * horner(series, turned * turned);
}

}  // namespace

SinCos sin_cos(double radians) {
  // pi/2 in three parts; the first two have so few bits that their multiples by the quadrant are exact.
  constexpr double half_pi_1 = 0x1.921fb54400000p+0;
  constexpr double half_pi_2 = 0x1.0b4611a600000p-34;
  constexpr double half_pi_3 = 0x1.3198a2e037073p-69;
  const double quadrant = std::floor(radians * (2 / pi) + 0.5);
  const double x = ((radians - quadrant * half_pi_1) - quadrant * half_pi_2) - quadrant * half_pi_3;

  static constexpr auto sin_series = alternating_factorials<9>(1);
  static constexpr auto cos_series = alternating_factorials<10>(0);
  const double s = x * horner(sin_series, x * x);
  const double c = horner(cos_series, x * x);
  switch (static_cast<long>(quadrant) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

double exp_of_negative(double x) {
  if (!(x > -708)) return 0;  // smaller results would lose bits
  constexpr double doublings_per_unit = 1.4426950408889634;
  const auto doublings = static_cast<std::int64_t>(x * doublings_per_unit - 0.5);  // nearest, as x <= 0
  const auto count = static_cast<double>(doublings);
  const double rest = (x - count * ln2_high) - count * ln2_low;  // at most ln(2) / 2 in absolute value
  // e^x = cosh(x) + sinh(x): two short chains of operations run side by side where one long one would wait.
  static constexpr auto cosh_series = reciprocal_factorials<7>(0);
  static constexpr auto sinh_series = reciprocal_factorials<7>(1);
  const double squared = rest * rest;
  const auto power_of_two = std::bit_cast<double>(static_cast<std::uint64_t>(doublings + 1023) << 52U);
  return (horner(cosh_series, squared) + rest * horner(sinh_series, squared)) * power_of_two;
}

double natural_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // in [1/2, 1)
  if (mantissa < 0.70710678118654752) {
    mantissa *= 2;
    --exponent;
  }
  // ln m = 2 artanh((m - 1) / (m + 1))
  static constexpr auto series = odd_reciprocals<13>(1);
  const double t = (mantissa - 1) / (mantissa + 1);
  return exponent * ln2_high + (2 * t * horner(series, t * t) + exponent * ln2_low);
}

double angle_of(double y, double x) {
  const double across = std::abs(x);
  const double up = std::abs(y);
  if (across == 0 && up == 0) return 0;
  const double first_octants = up <= across ? arc_tangent(up / across) : pi / 2 - arc_tangent(across / up);
  const double half = x < 0 ? pi - first_octants : first_octants;
  return y < 0 ? -half : half;
}

}  // namespace keenline::kernels
