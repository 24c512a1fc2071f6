#include "keenline/lines/line_net.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

/// Nodes at x = 0, 1, 2 … of a row, connected.
LineNet row(std::uint32_t count) {
  std::vector<Point> positions;
  for (std::uint32_t i = 0; i < count; ++i) positions.push_back({1.0 * i, 0, 0});
  LineNet net(positions);
  for (std::uint32_t i = 0; i + 1 < count; ++i) net.connect(i, i + 1);
  return net;
}

/// A row of 11 nodes, and on its middle, node 5, a branch of nodes 11, 12, 13.
LineNet tee() {
  std::vector<Point> positions;
  for (int i = 0; i < 11; ++i) positions.push_back({1.0 * i, 0, 0});
  for (int i = 1; i < 4; ++i) positions.push_back({5, 1.0 * i, 0});
  LineNet net(positions);
  for (std::uint32_t i = 0; i < 10; ++i) net.connect(i, i + 1);
  net.connect(5, 11);
  net.connect(11, 12);
  net.connect(12, 13);
  return net;
}

std::size_t pieces(const LineNet& net) {
  std::size_t count = 0;
  for (std::uint32_t node = 0; node < net.size(); ++node) count += net.degree_of(node);
  return count / 2;
}

TEST(LineNet, PrunesShortBranchesTheShortestFirst) {
  LineNet net = tee();
  net.prune_branches_below(3);
  EXPECT_EQ(pieces(net), 13U) << "a branch of just that length stays";
  net.prune_branches_below(3.1);
  EXPECT_EQ(pieces(net), 10U);
  net.prune_branches_below(100);
  EXPECT_EQ(pieces(net), 10U) << "without a junction nothing is a branch";
  net = tee();
  net.prune_branches_below(6);
  // When the branch of 3 is gone, the row is one line and no branch of 5.
  EXPECT_EQ(pieces(net), 10U);
}

TEST(LineNet, DropsSmallPartsAndBranches) {
  LineNet net = row(5);
  net.drop_parts_below(4);
  EXPECT_EQ(pieces(net), 4U);
  net.drop_parts_below(4.1);
  EXPECT_EQ(pieces(net), 0U);
  net = tee();
  net.connect(0, 13);
  net.drop_branches();
  EXPECT_EQ(net.ends().size(), 0U);
  EXPECT_EQ(net.degree_of(10), 0U);
  EXPECT_EQ(net.degree_of(6), 0U);
  EXPECT_EQ(pieces(net), 9U) << "0 to 5 and up the branch";
}

TEST(LineNet, WaysAreShortestAndLimited) {
  LineNet net = tee();
  EXPECT_DOUBLE_EQ(net.way_between(0, 13, 100), 8);
  EXPECT_EQ(net.way_between(0, 13, 8), std::numeric_limits<double>::infinity());
  net.connect(0, 13);
  EXPECT_DOUBLE_EQ(net.way_between(0, 13, 100), std::sqrt(34.0));
  EXPECT_EQ(net.way_between(4, 4, 1), 0);
}

TEST(LineNet, JunctionsNearEachOtherBecomeOne) {
  // An H lying down: two junctions two apart, four arms of length 5.
  std::vector<Point> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  LineNet net(positions);
  for (const double side : {-1.0, 1.0})
    for (int i = 1; i <= 5; ++i) {
      positions.push_back({0, side * i, 0});
      positions.push_back({2, side * i, 0});
    }
  net = LineNet(positions);
  net.connect(0, 1);
  net.connect(1, 2);
  for (std::uint32_t i = 3; i < positions.size(); ++i) {
    const bool is_first = (i - 3) % 10 < 2;
    if (is_first) net.connect(i, (i - 3) % 2 == 0 ? 0 : 2);
    else net.connect(i, i - 2);
  }
  ASSERT_EQ(net.ends().size(), 4U);
  LineNet untouched = net;
  untouched.merge_junctions(2);
  EXPECT_EQ(untouched.chains().size(), 5U) << "not nearer than 2";
  net.merge_junctions(2.1);
  EXPECT_EQ(net.degree_of(0), 4U);
  EXPECT_EQ(net.degree_of(1), 0U);
  EXPECT_EQ(net.degree_of(2), 0U);
  EXPECT_EQ(net.position_of(0), (Point{1, 0, 0}));
  EXPECT_EQ(net.chains().size(), 4U);
}

TEST(LineNet, EyeletsAreTakenOut) {
  // A triangle hangs on the end of a tee's branch.
  std::vector<Point> positions{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 1, 0}, {3, -1, 0}};
  LineNet net(positions);
  net.connect(0, 1);
  net.connect(1, 2);
  net.connect(2, 3);
  net.connect(3, 4);
  net.connect(4, 2);
  net.drop_eyelets_below(4);
  EXPECT_EQ(pieces(net), 5U);
  net.drop_eyelets_below(5);
  EXPECT_EQ(pieces(net), 2U);
}

}  // namespace
}  // namespace keenline
