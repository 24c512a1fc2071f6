#include "keenline/kernels/line_angles.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/each_target.h"

namespace keenline::kernels {
namespace {

constexpr double units_per_radian = 65520 / (std::numbers::pi / 2);

TEST(LineAngles, AreWithinAUnitOfTheArcCosine) {
  for (int i = 0; i <= 100000; ++i) {
    const double angle = std::numbers::pi / 2 * i / 100000;
    const auto cosine = static_cast<float>(std::cos(angle));
    const double expected = std::acos(static_cast<double>(std::abs(cosine))) * units_per_radian;
    // Rounding, the polynomial, and floats that are 1/256 unit apart.
    EXPECT_NEAR(line_angle(cosine), expected, 0.5 + 0.03 + 0.01) << angle;
    EXPECT_EQ(line_angle(cosine), line_angle(-cosine));
  }
}

TEST(LineAngles, AreWholeForTheAnglesThatPeopleUse) {
  EXPECT_EQ(line_angle(1.0F), 0U);
  EXPECT_EQ(line_angle(1.0F + 1e-6F), 0U);  // rounding above one
  EXPECT_EQ(line_angle(0.0F), 90 * 728U);
  EXPECT_EQ(line_angle(0.5F), 60 * 728U);
  EXPECT_EQ(line_angle(-0.5F), 60 * 728U);
  EXPECT_EQ(line_angle(static_cast<float>(std::sqrt(0.5))), 45 * 728U);
  EXPECT_EQ(line_angle(static_cast<float>(std::sqrt(0.75))), 30 * 728U);
}

TEST(LineAngles, FillASymmetricMatrix) {
  const std::vector<float> x{1, 0, 0, -1};
  const std::vector<float> y{0, 1, 0.6F, 0};
  const std::vector<float> z{0, 0, 0.8F, 0};
  on_each_target([&] {
    constexpr std::size_t row = row_length(4);
    std::vector<std::uint32_t> angles(4 * row, 999);
    line_angles(Lines{x.data(), y.data(), z.data(), 4}, angles.data());
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(angles[i * row + i], 0U);
      for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(angles[i * row + j], angles[j * row + i]);
    }
    EXPECT_EQ(angles[0 * row + 1], right_angle);
    EXPECT_EQ(angles[0 * row + 3], 0U);  // a line and its reverse
    EXPECT_NEAR(angles[1 * row + 2], std::acos(0.6) * units_per_radian, 1);
  });
}

/// Unit vectors up to rounding, some more than one long; every third one coincides with another, its reverse,
/// or an axis.
struct ManyLines {
  std::vector<float> x, y, z;

  ManyLines(std::size_t count, unsigned seed) {
    std::mt19937 generator(seed);
    const auto number = [&] { return static_cast<double>(generator()) * 0x1p-31 - 1; };
    for (std::size_t i = 0; i < count; ++i) {
      double v[3] = {number(), number(), number()};
      if (i % 3 == 2) v[0] = 0, v[1] = seed % 2 == 0 ? 0 : v[1];
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      x.push_back(static_cast<float>(v[0] / length));
      y.push_back(static_cast<float>(v[1] / length));
      z.push_back(static_cast<float>(v[2] / length * (1 + 1e-7 * number())));
    }
  }
  [[nodiscard]] Lines lines() const { return {x.data(), y.data(), z.data(), static_cast<int>(x.size())}; }
};

TEST(LineAngles, AreTheSameOnEveryTargetForAnyNumberOfLines) {
  for (std::size_t n = 0; n <= 150; ++n) {
    const ManyLines many(n, static_cast<unsigned>(n));
    const std::size_t row = row_length(static_cast<int>(n));
    on_each_target([&] {
      // One row beyond the last must stay as it is.
      std::vector<std::uint32_t> angles((n + 1) * row, 999);
      line_angles(many.lines(), angles.data());
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const float c = many.x[i] * many.x[j] + many.y[i] * many.y[j] + many.z[i] * many.z[j];
          ASSERT_EQ(angles[i * row + j], i == j ? 0 : line_angle(c)) << n << ' ' << i << ' ' << j;
        }
      for (std::size_t j = 0; j < row; ++j) ASSERT_EQ(angles[n * row + j], 999U);
    });
  }
}

TEST(LineAngles, TheLargestCountIn32BitsAgreesWith64) {
  const ManyLines many(512, 1);
  const std::size_t row = row_length(512);
  std::vector<std::uint64_t> expected(512 * row, 0);
  line_angles(many.lines(), expected.data());
  on_each_target([&] {
    std::vector<std::uint32_t> angles(512 * row, 0);
    line_angles(many.lines(), angles.data());
    for (std::size_t i = 0; i < 512; ++i)
      for (std::size_t j = 0; j < 512; ++j) ASSERT_EQ(angles[i * row + j], expected[i * row + j]);
  });
}

TEST(LineAngles, EveryFloatOfAnOctaveHasTheAngleOfTheScalarCode) {
  // Cosines as a line (c, 0, 0) has them with the x axis: consecutive floats below 1, and coarser ones.
  for (const std::uint32_t step : {1U, 15013U}) {
    ManyLines many(0, 0);
    many.x = {1};
    for (std::uint32_t i = 0; i < 500; ++i) many.x.push_back(std::bit_cast<float>(0x3F800000U - i * step));
    many.y = many.z = std::vector<float>(many.x.size(), 0);
    on_each_target([&] {
      std::vector<std::uint32_t> angles(501 * row_length(501));
      line_angles(many.lines(), angles.data());
      for (std::size_t i = 1; i <= 500; ++i) ASSERT_EQ(angles[i], line_angle(many.x[i])) << many.x[i];
    });
  }
}

TEST(LineAngles, TheSmallestCosineIsThatOfTheFurthestLine) {
  for (std::size_t n = 0; n <= 40; ++n) {
    const ManyLines many(n, 3);
    float expected = 1;
    for (std::size_t i = 0; i < n; ++i)
      expected = std::min(expected, std::abs(0.6F * many.x[i] + -0.8F * many.y[i] + 0.0F * many.z[i]));
    on_each_target([&] { EXPECT_EQ(smallest_cosine_to(many.lines(), 0.6F, -0.8F, 0), expected) << n; });
  }
}

TEST(LineAngles, AllWithinIsNeverWronglyTrue) {
  // Two lines at +a and -a beside the first: a from it, 2a apart.
  for (const double degrees : {0.1, 0.5, 1.0, 5.0, 20.0}) {
    const double a = degrees * std::numbers::pi / 180;
    const std::vector<float> x{1, static_cast<float>(std::cos(a)), static_cast<float>(std::cos(a))};
    const std::vector<float> y{0, static_cast<float>(std::sin(a)), static_cast<float>(-std::sin(a))};
    const std::vector<float> z{0, 0, 0};
    const Lines lines{x.data(), y.data(), z.data(), 3};
    EXPECT_FALSE(all_within(lines, 2 * degrees * angle_units_per_degree - 3));
    EXPECT_TRUE(all_within(lines, 2 * degrees * angle_units_per_degree + 4));
  }
}

}  // namespace
}  // namespace keenline::kernels
