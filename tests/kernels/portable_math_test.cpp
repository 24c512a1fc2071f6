#include "keenline/kernels/portable_math.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/synth/random.h"

namespace keenline::kernels {
namespace {

TEST(PortableMath, sin_and_cos_agree_with_extended_precision) {
  synth::RandomStream random(7, synth::Purpose::Position, 0);
  for (int i = 0; i < 20000; ++i) {
    const double range = i % 2 == 0 ? 4 : 1e5;
    const double x = range * (2 * random.uniform() - 1);
    const auto [sin, cos] = sin_cos(x);
    ASSERT_NEAR(sin, static_cast<double>(std::sin(static_cast<long double>(x))), 3e-16) << x;
    ASSERT_NEAR(cos, static_cast<double>(std::cos(static_cast<long double>(x))), 3e-16) << x;
  }
}

TEST(PortableMath, sin_and_cos_are_exact_where_that_is_possible) {
  EXPECT_EQ(sin_cos(0).sin, 0);
  EXPECT_EQ(sin_cos(0).cos, 1);
  EXPECT_EQ(sin_cos(pi / 2).sin, 1);
  EXPECT_EQ(sin_cos(-pi).cos, -1);
  // The sine of the double nearest to pi is what that double lacks.
  EXPECT_NEAR(sin_cos(pi).sin, 1.2246467991473532e-16, 1e-31);
}

TEST(PortableMath, exponential_agrees_with_extended_precision) {
  synth::RandomStream random(10, synth::Purpose::Position, 0);
  for (int i = 0; i < 20000; ++i) {
    const double x = (i % 2 == 0 ? -4 : -708) * random.uniform();
    const auto expected = static_cast<double>(std::exp(static_cast<long double>(x)));
    ASSERT_NEAR(exp_of_negative(x), expected, 1e-15 * expected) << x;
  }
  EXPECT_EQ(exp_of_negative(0), 1);
  EXPECT_EQ(exp_of_negative(-0.0), 1);
  EXPECT_EQ(exp_of_negative(-1e-300), 1);
  EXPECT_EQ(exp_of_negative(-709), 0);
  EXPECT_EQ(exp_of_negative(-std::numeric_limits<double>::max()), 0);
  EXPECT_EQ(exp_of_negative(-std::numeric_limits<double>::infinity()), 0);
}

TEST(PortableMath, logarithm_agrees_with_extended_precision) {
  synth::RandomStream random(8, synth::Purpose::Position, 0);
  for (int i = 0; i < 20000; ++i) {
    const double x = std::ldexp(1 + random.uniform(), static_cast<int>(random.uniform() * 2000) - 1000);
    const auto expected = static_cast<double>(std::log(static_cast<long double>(x)));
    ASSERT_NEAR(natural_log(x), expected, 1e-15 * std::abs(expected)) << x;
  }
  for (double x : {1 - 1e-9, 1 + 1e-9, 0.999, 1.001, std::numeric_limits<double>::denorm_min()}) {
    const auto expected = static_cast<double>(std::log(static_cast<long double>(x)));
    EXPECT_NEAR(natural_log(x), expected, 1e-15 * std::abs(expected)) << x;
  }
  EXPECT_EQ(natural_log(1), 0);
}

TEST(PortableMath, angle_agrees_with_extended_precision) {
  synth::RandomStream random(9, synth::Purpose::Position, 0);
  for (int i = 0; i < 20000; ++i) {
    const double x = 2 * random.uniform() - 1;
    const double y = (2 * random.uniform() - 1) * (i % 3 == 0 ? 1e-6 : 1);
    const auto expected =
        static_cast<double>(std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    ASSERT_NEAR(angle_of(y, x), expected, 1e-15 * std::abs(expected)) << x << ' ' << y;
  }
  EXPECT_EQ(angle_of(0, 0), 0);
  EXPECT_EQ(angle_of(0, 1), 0);
  EXPECT_EQ(angle_of(0, -1), pi);
  EXPECT_EQ(angle_of(1, 0), pi / 2);
  EXPECT_EQ(angle_of(-2, 0), -pi / 2);
}

}  // namespace
}  // namespace keenline::kernels
