#include "keenline/kernels/symmetric3.h"

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

}  // namespace
}  // namespace keenline::kernels
