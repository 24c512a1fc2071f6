#include "keenline/synth/polynomial.h"

#include <vector>

#include <gtest/gtest.h>

namespace keenline::synth {
namespace {

std::vector<double> roots(const Quartic& p, double low = -10, double high = 10) {
  const Roots found = roots_of(p, low, high);
  return {found.begin(), found.end()};
}

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
}

TEST(Polynomial, finds_all_roots_in_order) {
  expect_near(roots({-6, 2}), {3});
  expect_near(roots({-2, 0, 1}), {-1.4142135623730951, 1.4142135623730951});
  expect_near(roots({-6, 11, -6, 1}), {1, 2, 3});
  expect_near(roots({24, -50, 35, -10, 1}), {1, 2, 3, 4});
  expect_near(roots({0.25, 0, -1.25, 0, 1}), {-1, -0.5, 0.5, 1});
}

TEST(Polynomial, keeps_to_the_interval) {
  expect_near(roots({24, -50, 35, -10, 1}, 1.5, 3.5), {2, 3});
  expect_near(roots({-2, 0, 1}, 0, 10), {1.4142135623730951});
  expect_near(roots({-2, 0, 1}, 2, 10), {});
}

TEST(Polynomial, has_no_roots_where_there_are_none) {
  expect_near(roots({}), {});
  expect_near(roots({5}), {});
  expect_near(roots({1, 0, 1}), {});
  expect_near(roots({1, 0, 0, 0, 1}), {});
}

TEST(Polynomial, separates_roots_that_are_close) {
  const double a = 1.0001;  // (x - 1)(x - a)(x + 2)(x - 3)
  const std::vector<double> found = roots({-6 * a, 6 + 5 * a, -5 + 2 * a, -2 - a, 1});
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NEAR(found[1], 1, 1e-11);
  EXPECT_NEAR(found[2], a, 1e-11);
}

}  // namespace
}  // namespace keenline::synth
