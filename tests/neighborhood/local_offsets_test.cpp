#include "keenline/neighborhood/local_offsets.h"

#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace keenline {
namespace {

std::vector<std::uint32_t> others(const std::vector<Point>& positions) {
  std::vector<std::uint32_t> indices(positions.size() - 1);
  std::iota(indices.begin(), indices.end(), 1U);
  return indices;
}

TEST(LocalOffsets, AreDifferencesInAUnitThatIsAPowerOfTwo) {
  const std::vector<Point> positions{{1, 2, 3}, {1, 2, 9}, {-2, 2, 3}};
  LocalOffsets local;
  ASSERT_TRUE(local.gather(positions, 0, others(positions)));
  EXPECT_EQ(local.unit(), 4);
  EXPECT_EQ(local.per_unit(), 0.25);
  ASSERT_EQ(local.offsets().size(), 2U);
  EXPECT_EQ(local.offsets()[0], (Point{0, 0, 1.5}));
  EXPECT_EQ(local.offsets()[1], (Point{-0.75, 0, 0}));
}

TEST(LocalOffsets, LoseNothingFarFromTheOrigin) {
  const double detail = 0x1p-29;  // the next double after 1e7
  const std::vector<Point> positions{{1e7, 1e7, 1e7}, {1e7 + detail, 1e7, 1e7 - 2 * detail}};
  LocalOffsets local;
  ASSERT_TRUE(local.gather(positions, 0, others(positions)));
  EXPECT_EQ(local.offsets()[0], (Point{0.5, 0, -1}));
}

TEST(LocalOffsets, SquareSafelyAtAnyScale) {
  for (const double scale : {0x1p-1074, 0x1p-1022, 0x1p-300, 1.0, 0x1p300, 0x1p1023}) {
    const std::vector<Point> positions{{0, 0, 0}, {scale, 0, -scale}, {0, 0, scale}};
    LocalOffsets local;
    ASSERT_TRUE(local.gather(positions, 0, others(positions)));
    for (const Point& offset : local.offsets()) {
      EXPECT_TRUE(std::isnormal(dot(offset, offset))) << scale;
      EXPECT_EQ(std::abs(offset[2]) * local.unit(), scale);
    }
    EXPECT_EQ(local.unit() * local.per_unit(), 1);
  }
}

TEST(LocalOffsets, SayWhenThereIsNothingToWorkWith) {
  constexpr double largest = std::numeric_limits<double>::max();
  LocalOffsets local;
  EXPECT_FALSE(local.gather({{1, 2, 3}}, 0, {}));
  const std::vector<Point> same(4, {1, 2, 3});
  EXPECT_FALSE(local.gather(same, 0, others(same)));
  const std::vector<Point> wide{{-largest, 0, 0}, {largest, 0, 0}};
  EXPECT_FALSE(local.gather(wide, 0, others(wide)));
}

TEST(ScatterOf, IsTheSumOfSquaresAboutTheMeanOfAllPoints) {
  // 0, (3, 0, 0), (0, 6, 3): mean (1, 2, 1).
  const std::vector<Point> offsets{{3, 0, 0}, {0, 6, 3}};
  const kernels::Symmetric3 scatter = scatter_of(offsets);
  EXPECT_DOUBLE_EQ(scatter.xx, 1 + 4 + 1);
  EXPECT_DOUBLE_EQ(scatter.yy, 4 + 4 + 16);
  EXPECT_DOUBLE_EQ(scatter.zz, 1 + 1 + 4);
  EXPECT_DOUBLE_EQ(scatter.xy, 2 - 4 - 4);
  EXPECT_DOUBLE_EQ(scatter.xz, 1 - 2 - 2);
  EXPECT_DOUBLE_EQ(scatter.yz, 2 + 2 + 8);
}

}  // namespace
}  // namespace keenline
