#include "keenline/kernels/triangle_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/each_target.h"

namespace keenline::kernels {
namespace {

using Offset = std::array<double, 3>;
using Offsets = std::vector<Offset>;

std::vector<int> shapes_of(const Offsets& offsets) {
  const std::size_t count = offsets.empty() ? 0 : offsets.size() * (offsets.size() - 1) / 2;
  std::vector<std::uint8_t> shapes(count + shape_slack);
  triangle_shapes(offsets.empty() ? nullptr : offsets.front().data(), static_cast<int>(offsets.size()),
                  shapes.data());
  return {shapes.begin(), shapes.begin() + static_cast<std::ptrdiff_t>(count)};
}

double squared_distance(const Offset& a, const Offset& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += (a[axis] - b[axis]) * (a[axis] - b[axis]);
  return sum;
}

/// By Heron's formula, in double precision.
double textbook_shape(const Offset& a, const Offset& b) {
  const double squares[3] = {squared_distance(a, {}), squared_distance(b, {}), squared_distance(a, b)};
  const double sides[3] = {std::sqrt(squares[0]), std::sqrt(squares[1]), std::sqrt(squares[2])};
  const double half = (sides[0] + sides[1] + sides[2]) / 2;
  const double square_of_area = half * (half - sides[0]) * (half - sides[1]) * (half - sides[2]);
  const double sum = squares[0] + squares[1] + squares[2];
  return sum > 0 ? 256 * 48 * std::max(0.0, square_of_area) / (sum * sum) : 0;
}

Offsets random_offsets(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  Offsets offsets(count);
  for (auto& offset : offsets)
    for (double& c : offset)
      c = seed % 2 == 0 ? static_cast<double>(generator() % 3) - 1
                        : static_cast<double>(generator()) * 0x1p-31 - 1;
  return offsets;
}

TEST(TriangleShapes, OfKnownTriangles) {
  const Offsets equilateral{{1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  const Offsets right{{0, 1, 0}, {0, 0, 1}};  // q² = (sqrt(3) / 2)²
  const Offsets flat{{1, 1, 0}, {2, 2, 0}};
  const Offsets nothing{{0, 0, 0}, {0, 0, 0}};
  on_each_target([&] {
    EXPECT_GE(shapes_of(equilateral).at(0), 254);
    EXPECT_EQ(shapes_of(right).at(0), 192);
    EXPECT_EQ(shapes_of(flat).at(0), 0);
    EXPECT_EQ(shapes_of(nothing).at(0), 0);
    EXPECT_TRUE(shapes_of({}).empty());
    EXPECT_TRUE(shapes_of({{1, 2, 0}}).empty());
  });
}

TEST(TriangleShapes, AreThoseOfTheTextbook) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Offsets offsets = random_offsets(2 + seed, seed);
    const std::vector<int> shapes = shapes_of(offsets);
    std::size_t at = 0;
    for (std::size_t i = 0; i < offsets.size(); ++i)
      for (std::size_t j = i + 1; j < offsets.size(); ++j, ++at)
        EXPECT_NEAR(shapes[at] + 0.5, textbook_shape(offsets[i], offsets[j]), 0.51 + 1e-3) << seed;
  }
}

TEST(TriangleShapes, AreTheSameOnEveryTarget) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Offsets offsets = random_offsets(seed, seed);
    std::vector<int> expected;
    on_each_target([&] {
      const auto shapes = shapes_of(offsets);
      if (target_is_scalar()) expected = shapes;
      EXPECT_EQ(shapes, expected) << seed;
    });
  }
  on_each_target([&] { EXPECT_EQ(shapes_of(random_offsets(255, 1)).size(), 32385U); });
}

TEST(TriangleShapes, SizeIsOfNoAccountUntilItIsTooSmall) {
  const Offsets offsets = random_offsets(20, 1);
  Offsets small = offsets;
  for (Offset& offset : small)
    for (double& c : offset) c *= 0x1p-20;
  Offsets tiny = offsets;
  for (Offset& offset : tiny)
    for (double& c : offset) c *= 1e-200;
  on_each_target([&] {
    EXPECT_EQ(shapes_of(small), shapes_of(offsets));
    EXPECT_EQ(shapes_of(tiny), std::vector<int>(190, 0));
  });
}

TEST(TriangleShapes, TheBestAreThoseThatSortingFinds) {
  std::mt19937 generator(5);
  for (const std::size_t count : {1U, 7U, 31U, 32U, 33U, 120U, 378U}) {
    std::vector<std::uint8_t> shapes(count);
    const unsigned range = count == 33 ? 4 : 256;  // few: many alike
    for (auto& shape : shapes) shape = static_cast<std::uint8_t>(generator() % range);
    std::vector<std::uint8_t> sorted = shapes;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    on_each_target([&] {
      for (std::size_t best = 1; best <= count; ++best)
        EXPECT_EQ(shape_of_best(shapes.data(), count, best), sorted[best - 1]) << count << ' ' << best;
      EXPECT_EQ(shape_of_best(shapes.data(), count, count + 1), 0);
    });
  }
}

}  // namespace
}  // namespace keenline::kernels
