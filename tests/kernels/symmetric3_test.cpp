#include "keenline/kernels/symmetric3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace keenline::kernels {
namespace {

/// a v = lambda v, unit length, falling order.
void expect_decomposition(const Symmetric3& m) {
  Eigen::Matrix3d a;
  a << m.xx, m.xy, m.xz, m.xy, m.yy, m.yz, m.xz, m.yz, m.zz;
  const Eigen3 found = eigen_decomposition(m);
  const double scale = a.norm();
  const Eigen::Vector3d expected = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(a).eigenvalues();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d v(found.vectors[static_cast<std::size_t>(i)].data());
    const double value = found.values[static_cast<std::size_t>(i)];
    EXPECT_NEAR(v.norm(), 1, 1e-14);
    EXPECT_LE((a * v - value * v).norm(), 1e-14 * scale);
    EXPECT_NEAR(value, expected[2 - i], 1e-14 * scale);
  }
}

TEST(Symmetric3, DecomposesRandomMatrices) {
  std::mt19937 generator(1);
  const auto number = [&] { return static_cast<double>(generator()) / 2147483648.0 - 1; };
  for (int i = 0; i < 1000; ++i)
    expect_decomposition({number(), number(), number(), number(), number(), number()});
}

TEST(Symmetric3, DecomposesSpecialMatrices) {
  expect_decomposition({});
  expect_decomposition({1, 0, 0, 1, 0, 1});
  expect_decomposition({3, 0, 0, 1, 0, 2});
  expect_decomposition({1, 1, 1, 1, 1, 1});         // rank one
  expect_decomposition({1, 1e-9, 0, 1, 1e-12, 1});  // nearly all equal
  expect_decomposition({1e100, 1e99, 0, 1e100, 5e99, 3e98});
  expect_decomposition({1e-100, 1e-101, 0, 1e-100, 5e-101, 3e-102});
}

TEST(Symmetric3, FindsTheAxisOfAPlaneSNormals) {
  const Eigen3 found = eigen_decomposition({0, 0, 0, 0, 0, 5});
  EXPECT_EQ(found.values[0], 5);
  EXPECT_EQ(std::abs(found.vectors[0][2]), 1);
}

TEST(Symmetric3, LargestEigenvectorIsTheFirstOfAll) {
  std::mt19937 generator(2);
  const auto number = [&] { return static_cast<double>(generator()) / 2147483648.0 - 1; };
  for (int i = 0; i < 1000; ++i) {
    // Of lines that gather more and more closely.
    Symmetric3 m;
    const double scatter = std::pow(0.98, i);
    const std::array<double, 3> axis{number(), number(), number()};
    for (int line = 0; line < 10; ++line)
      add_square(
          m, {axis[0] + scatter * number(), axis[1] + scatter * number(), axis[2] + scatter * number()}, 1);
    const Eigen3 all = eigen_decomposition(m);
    const auto found = largest_eigenvector(m);
    double cosine = 0;
    for (std::size_t k = 0; k < 3; ++k) cosine += found[k] * all.vectors[0][k];
    double off = 0;
    for (std::size_t k = 0; k < 3; ++k)
      off = std::max(off, std::abs(found[k] - std::copysign(all.vectors[0][k], cosine * all.vectors[0][k])));
    // The nearer the values, the less certain the vector.
    EXPECT_LE(off, 1e-14 * all.values[0] / (all.values[0] - all.values[1])) << i;
  }
}

TEST(Symmetric3, LargestEigenvectorOfSpecialMatrices) {
  EXPECT_EQ(largest_eigenvector({0, 0, 0, 0, 0, 5}), (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(largest_eigenvector({0, 0, 0, 1e-200, 0, 0}), (std::array<double, 3>{0, 1, 0}));
  EXPECT_EQ(largest_eigenvector({1e300, 0, 0, 0, 0, 0}), (std::array<double, 3>{1, 0, 0}));
  // None is largest.
  for (const Symmetric3& m : {Symmetric3{}, Symmetric3{1, 0, 0, 1, 0, 1}, Symmetric3{1, 0, 0, 1, 0, 0}})
    EXPECT_EQ(largest_eigenvector(m), eigen_decomposition(m).vectors[0]);
}

}  // namespace
}  // namespace keenline::kernels
