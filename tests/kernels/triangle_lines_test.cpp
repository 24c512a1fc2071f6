#include "keenline/kernels/triangle_lines.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/kernels/triangle_shapes.h"

#include "support/each_target.h"

namespace keenline::kernels {
namespace {

using Offsets = std::vector<std::array<double, 3>>;
using Line = std::tuple<float, float, float>;

/// Of all triangles, or of those that are shaped so well.
std::vector<Line> lines_of(const Offsets& offsets, double min_sine,
                           std::optional<std::uint8_t> least_shape = {}) {
  std::vector<double> lengths;
  for (const auto& a : offsets) lengths.push_back(std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]));
  const std::size_t room = offsets.size() * (offsets.size() + 1) / 2 + line_slack;
  std::vector<float> x(room);
  std::vector<float> y(room);
  std::vector<float> z(room);
  const double* const first = offsets.empty() ? nullptr : offsets.front().data();
  const auto corners = static_cast<int>(offsets.size());
  std::vector<std::uint8_t> shapes(room + shape_slack);
  triangle_shapes(first, corners, shapes.data());
  const int count =
      least_shape ? triangle_lines(first, lengths.data(), corners, min_sine, shapes.data(), *least_shape,
                                   x.data(), y.data(), z.data())
                  : triangle_lines(first, lengths.data(), corners, min_sine, x.data(), y.data(), z.data());
  std::vector<Line> lines;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) lines.emplace_back(x[i], y[i], z[i]);
  return lines;
}

/// Half of them on a lattice, where many triangles have no area.
Offsets random_offsets(std::size_t count, unsigned seed) {
  std::mt19937 generator(seed);
  Offsets offsets(count);
  for (auto& offset : offsets)
    for (double& c : offset)
      c = seed % 2 == 0 ? static_cast<double>(generator() % 3) - 1
                        : static_cast<double>(generator()) * 0x1p-31 - 1;
  return offsets;
}

TEST(TriangleLines, OfTheAxesAreTheAxes) {
  const Offsets axes{{2, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
  on_each_target([&] {
    EXPECT_EQ(lines_of(axes, 0), (std::vector<Line>{{0, 0, 1}, {0, -1, 0}, {1, 0, 0}}));
  });
}

TEST(TriangleLines, WithoutANormalOrTooSlenderAreLeftOut) {
  // Sines: 0 with the reverse and with a coincident point, 0.5 and 0.6 with the others.
  const Offsets offsets{{1, 0, 0}, {-2, 0, 0}, {0, 0, 0}, {std::sqrt(0.75), 0.5, 0}, {0.8, 0, 0.6}};
  on_each_target([&] {
    EXPECT_EQ(lines_of(offsets, 0).size(), 5U);
    EXPECT_EQ(lines_of(offsets, 0.49).size(), 5U);
    EXPECT_EQ(lines_of(offsets, 0.55).size(), 3U);
    EXPECT_EQ(lines_of(offsets, 0.8).size(), 0U);
    EXPECT_TRUE(lines_of({}, 0).empty());
    EXPECT_TRUE(lines_of({{1, 2, 3}}, 0).empty());
  });
}

TEST(TriangleLines, ThoseOfShapelyTrianglesAreAmongAll) {
  for (const std::size_t count : {3U, 16U, 28U, 100U, 255U}) {
    const Offsets offsets = random_offsets(count, 1);
    on_each_target([&] {
      const auto all = lines_of(offsets, 0.001);
      EXPECT_EQ(lines_of(offsets, 0.001, 0), all);
      const auto some = lines_of(offsets, 0.001, 190);
      EXPECT_LE(some.size(), all.size() / 2);
      std::size_t found = 0;  // in the same order
      for (const Line& line : all) found += found < some.size() && some[found] == line ? 1U : 0U;
      EXPECT_EQ(found, some.size());
    });
  }
  // A right angle is 192 of 256, see triangle_shapes().
  const Offsets axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 0.5}};
  on_each_target([&] {
    EXPECT_EQ(lines_of(axes, 0, 192), (std::vector<Line>{{0, 0, 1}}));
    EXPECT_TRUE(lines_of(axes, 0, 193).empty());
  });
}

TEST(TriangleLines, AreTheSameBitsOnEveryTarget) {
  for (unsigned seed = 0; seed < 42; ++seed) {
    const Offsets offsets = random_offsets(seed, seed);
    for (const double min_sine : {0.0, 0.001, 0.7}) {
      std::vector<Line> expected;
      on_each_target([&] {
        const auto lines = lines_of(offsets, min_sine);
        if (target_is_scalar()) expected = lines;
        EXPECT_EQ(lines, expected) << seed << ' ' << min_sine;
      });
      on_each_target([&] {
        const auto lines = lines_of(offsets, min_sine, 150);
        if (target_is_scalar()) expected = lines;
        EXPECT_EQ(lines, expected) << seed << ' ' << min_sine;
      });
    }
  }
  on_each_target([&] { EXPECT_GT(lines_of(random_offsets(255, 1), 0).size(), 32000U); });
}

}  // namespace
}  // namespace keenline::kernels
