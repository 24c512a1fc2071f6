#include "keenline/lines/band_least_squares.h"

#include <array>
#include <utility>

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(BandLeastSquares, OneUnknownIsTheWeightedMean) {
  BandLeastSquares equations(1, 1);
  equations.add(0, std::array{1.0}, {3, 0, 1}, 1);
  equations.add(0, std::array{1.0}, {6, 0, 1}, 2);
  const auto found = std::move(equations).solve();
  ASSERT_TRUE(found);
  EXPECT_NEAR((*found)[0][0], 5, 1e-15);
  EXPECT_EQ((*found)[0][1], 0);
  EXPECT_NEAR((*found)[0][2], 1, 1e-15);
}

TEST(BandLeastSquares, ABandIsSolvedLikeTheWholeMatrix) {
  // Second differences of squares, and both ends: x_i = i².
  constexpr std::size_t count = 30;
  const auto solve_with = [&](std::size_t band) {
    BandLeastSquares equations(count, band);
    equations.add(0, std::array{1.0}, {0, 0, 0});
    equations.add(count - 1, std::array{1.0}, {841, 0, 0});
    for (std::size_t i = 0; i + 2 < count; ++i) equations.add(i, std::array{1.0, -2.0, 1.0}, {2, 0, 0});
    return std::move(equations).solve();
  };
  const auto narrow = solve_with(3);
  const auto wide = solve_with(count);
  ASSERT_TRUE(narrow && wide);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR((*narrow)[i][0], static_cast<double>(i * i), 1e-8);
    EXPECT_NEAR((*wide)[i][0], (*narrow)[i][0], 1e-8);
  }
}

TEST(BandLeastSquares, UnknownsThatNothingDeterminesAreNotMadeUp) {
  EXPECT_FALSE(BandLeastSquares(2, 2).solve());
  BandLeastSquares one_equation(2, 2);
  one_equation.add(0, std::array{1.0, 1.0}, {1, 1, 1});
  EXPECT_FALSE(std::move(one_equation).solve());
  BandLeastSquares nearly_dependent(2, 2);
  nearly_dependent.add(0, std::array{1.0, 1.0}, {1, 1, 1});
  nearly_dependent.add(0, std::array{1.0, 1.0 + 1e-9}, {2, 1, 1});
  EXPECT_FALSE(std::move(nearly_dependent).solve());
}

TEST(BandLeastSquares, NoUnknownsAreKnown) {
  const auto found = BandLeastSquares(0, 1).solve();
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->empty());
}

}  // namespace
}  // namespace keenline
