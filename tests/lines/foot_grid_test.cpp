#include "keenline/lines/foot_grid.h"

#include <set>

#include <gtest/gtest.h>

#include "keenline/synth/random.h"

namespace keenline {
namespace {

Foot foot_at(const Point& position) {
  Foot foot;
  foot.position = position;
  return foot;
}

TEST(FootGrid, FindsAllThatIsWithinReach) {
  synth::RandomStream random(3, synth::Purpose::Position, 0);
  FootGrid grid;
  std::vector<Point> positions;
  for (std::size_t i = 0; i < 500; ++i) {
    positions.push_back({20 * random.uniform() - 10, 20 * random.uniform() - 10, 20 * random.uniform() - 10});
    grid.insert({i, 0, foot_at(positions.back())});
  }
  for (const double reach : {0.5, 3.0, 9.0, 1e9}) {
    const Point query{1, -2, 3};
    std::set<std::size_t> found;
    grid.near(query, reach,
              [&](const FootGrid::Entry& entry) { EXPECT_TRUE(found.insert(entry.path).second); });
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (distance(positions[i], query) <= reach) {
        EXPECT_TRUE(found.contains(i)) << reach;
      }
    }
  }
}

TEST(FootGrid, TakesPositionsThatNoIntegerCanHold) {
  FootGrid grid;
  grid.insert({7, 0, foot_at({1e300, -1e300, 0})});
  int found = 0;
  grid.near({1e300, -1e300, 0}, 1, [&](const FootGrid::Entry& entry) {
    EXPECT_EQ(entry.path, 7U);
    ++found;
  });
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace keenline
