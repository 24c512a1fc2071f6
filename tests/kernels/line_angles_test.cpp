#include "keenline/kernels/line_angles.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace keenline::kernels {
namespace {

constexpr double units_per_radian = 65520 / (std::numbers::pi / 2);

TEST(LineAngles, AreWithinAUnitOfTheArcCosine) {
  for (int i = 0; i <= 100000; ++i) {
    const double angle = std::numbers::pi / 2 * i / 100000;
    const auto cosine = static_cast<float>(std::cos(angle));
    const double expected = std::acos(static_cast<double>(std::abs(cosine))) * units_per_radian;
    EXPECT_NEAR(line_angle(cosine), expected, 0.51) << angle;
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
  std::vector<std::uint32_t> angles(16, 999);
  line_angles(Lines{x.data(), y.data(), z.data(), 4}, angles.data());
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(angles[i * 4 + i], 0U);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(angles[i * 4 + j], angles[j * 4 + i]);
  }
  EXPECT_EQ(angles[0 * 4 + 1], right_angle);
  EXPECT_EQ(angles[0 * 4 + 3], 0U);  // a line and its reverse
  EXPECT_NEAR(angles[1 * 4 + 2], std::acos(0.6) * units_per_radian, 1);
}

TEST(LineAngles, MeanAngleToADirection) {
  const std::vector<float> x{1, 0, 0};
  const std::vector<float> y{0, -1, 0.5F};
  const std::vector<float> z{0, 0, static_cast<float>(std::sqrt(0.75))};
  EXPECT_EQ(mean_angle_to(Lines{x.data(), y.data(), z.data(), 3}, 0, 1, 0), (90 + 0 + 60) * 728 / 3.0);
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
