#include "keenline/report/report_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"

#include "support/sample_graph.h"

namespace keenline {
namespace {

/// A square lattice of side x side points, row after row; every seventh row is an edge.
PointCloud lattice(std::uint32_t side) {
  PointCloud cloud;
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) cloud.positions.push_back({x * 1.0, y * 1.0, 0});
  return cloud;
}

std::vector<Kind> flat(const PointCloud& cloud) { return std::vector<Kind>(cloud.size(), Kind::Flat); }

TEST(ReportSelection, AllPointsWhereTheyFit) {
  const PointCloud cloud = lattice(10);
  std::vector<std::uint32_t> all(100);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(select_points(cloud, flat(cloud), 100), all);
  EXPECT_EQ(select_points(cloud, flat(cloud), 1000), all);
}

TEST(ReportSelection, EverySharpPointAndBorderIsKept) {
  const PointCloud cloud = lattice(60);
  std::vector<Kind> kinds = flat(cloud);
  const std::array<Kind, 6> others{Kind::Edge, Kind::Curved, Kind::Corner,
                                   Kind::Peak, Kind::Border, Kind::Undecided};
  for (std::size_t i = 0; i < kinds.size(); i += 5) kinds[i] = others[i / 5 % others.size()];
  const std::vector<std::uint32_t> selected = select_points(cloud, kinds, 1000);
  EXPECT_EQ(selected.size(), 1000U);
  EXPECT_TRUE(std::is_sorted(selected.begin(), selected.end()));
  EXPECT_EQ(std::adjacent_find(selected.begin(), selected.end()), selected.end());
  for (std::uint32_t i = 0; i < kinds.size(); ++i) {
    if (is_feature(kinds[i]) || kinds[i] == Kind::Border) {
      EXPECT_TRUE(std::binary_search(selected.begin(), selected.end(), i)) << i;
    }
  }
}

TEST(ReportSelection, MoreSharpPointsThanFitAreKeptAlone) {
  const PointCloud cloud = lattice(20);
  std::vector<Kind> kinds = flat(cloud);
  std::fill(kinds.begin() + 100, kinds.begin() + 200, Kind::Edge);
  std::vector<std::uint32_t> sharp(100);
  std::iota(sharp.begin(), sharp.end(), 100U);
  EXPECT_EQ(select_points(cloud, kinds, 10), sharp);
}

TEST(ReportSelection, OthersAreThinnedEvenly) {
  // A quarter of a lattice whose rows are a multiple of four long: every fourth in the order of the file
  // would leave stripes.
  const PointCloud cloud = lattice(64);
  const std::vector<std::uint32_t> selected = select_points(cloud, flat(cloud), 64 * 64 / 4);
  ASSERT_EQ(selected.size(), 1024U);
  std::array<int, 64> tiles{};  // of 8 x 8 points
  for (const std::uint32_t i : selected) ++tiles[i / 64 / 8 * 8 + i % 64 / 8];
  for (const int count : tiles) EXPECT_NEAR(count, 16, 2);
}

TEST(ReportSelection, PointsThatAreNotFiniteHaveNoPlace) {
  PointCloud cloud = lattice(5);
  cloud.positions[3][1] = std::numeric_limits<double>::infinity();
  cloud.positions[4][2] = std::nan("");
  std::vector<Kind> kinds = flat(cloud);
  kinds[3] = Kind::Edge;  // not what a method says
  for (const std::size_t limit : {1U, 10U, 23U, 100U}) {
    const std::vector<std::uint32_t> selected = select_points(cloud, kinds, limit);
    EXPECT_EQ(selected.size(), std::min<std::size_t>(limit, 23));
    for (const std::uint32_t i : selected) EXPECT_TRUE(i != 3 && i != 4);
  }
  EXPECT_TRUE(select_points({}, {}, 1).empty());
}

TEST(ReportSelection, SamePointsForAnyNumberOfThreads) {
  const PointCloud cloud = lattice(100);
  const std::vector<std::uint32_t> expected = select_points(cloud, flat(cloud), 777);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(select_points(cloud, flat(cloud), 777), expected);
}

}  // namespace
}  // namespace keenline
