#include "keenline/synth/random.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace keenline::synth {
namespace {

TEST(Random, streams_repeat_and_differ) {
  const auto first_bits = [](std::uint64_t seed, Purpose purpose, std::uint64_t index) {
    return RandomStream(seed, purpose, index).bits();
  };
  const std::uint64_t bits = first_bits(1, Purpose::Position, 2);
  EXPECT_EQ(first_bits(1, Purpose::Position, 2), bits);
  EXPECT_NE(first_bits(2, Purpose::Position, 2), bits);
  EXPECT_NE(first_bits(1, Purpose::Noise, 2), bits);
  EXPECT_NE(first_bits(1, Purpose::Position, 3), bits);
  EXPECT_NE(first_bits(2, Purpose::Position, 1), bits);
}

TEST(Random, uniform_numbers_fill_the_unit_interval_evenly_across_streams) {
  constexpr std::size_t bins = 64;
  constexpr std::size_t count = 64000;
  std::array<double, bins> histogram{};
  for (std::size_t i = 0; i < count; ++i) {
    const double u = RandomStream(5, Purpose::Position, i).uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    histogram[static_cast<std::size_t>(u * bins)] += 1;
  }
  double chi_squared = 0;
  for (const double n : histogram) chi_squared += (n - 1000) * (n - 1000) / 1000;
  // 63 degrees of freedom: mean 63, standard deviation 11.2.
  EXPECT_LT(chi_squared, 63 + 5 * 11.2);
  EXPECT_GT(chi_squared, 63 - 5 * 11.2);
}

TEST(Random, normal_numbers_have_the_moments_and_tails_of_the_normal_distribution) {
  RandomStream random(11, Purpose::Noise, 0);
  constexpr int count = 100000;
  double sum = 0;
  double squares = 0;
  double fourths = 0;
  int beyond_two = 0;
  for (int i = 0; i < count; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    fourths += x * x * x * x;
    beyond_two += std::abs(x) > 2 ? 1 : 0;
  }
  EXPECT_NEAR(sum / count, 0, 0.016);  // 5 standard errors each
  EXPECT_NEAR(squares / count, 1, 0.0224);
  EXPECT_NEAR(fourths / count, 3, 0.155);
  EXPECT_NEAR(beyond_two / double{count}, 0.0455, 0.0033);
}

TEST(Random, coordinates_of_a_normal_vector_are_independent) {
  RandomStream random(12, Purpose::Noise, 0);
  constexpr int count = 50000;
  double xy = 0;
  double yz = 0;
  double xx = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 v = random.normal_vector();
    xy += v.x * v.y;
    yz += v.y * v.z;
    xx += v.x * v.x;
  }
  EXPECT_NEAR(xy / count, 0, 0.0224);
  EXPECT_NEAR(yz / count, 0, 0.0224);
  EXPECT_NEAR(xx / count, 1, 0.032);
}

}  // namespace
}  // namespace keenline::synth
