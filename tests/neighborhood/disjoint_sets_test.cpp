#include "keenline/neighborhood/disjoint_sets.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(DisjointSets, AreNamedByTheirSmallestMember) {
  DisjointSets sets(6);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(sets.find(i), i);
  EXPECT_TRUE(sets.join(5, 4));
  EXPECT_TRUE(sets.join(2, 5));
  EXPECT_FALSE(sets.join(4, 2));
  EXPECT_FALSE(sets.join(3, 3));
  EXPECT_EQ(sets.find(5), 2U);
  EXPECT_EQ(sets.find(4), 2U);
  EXPECT_EQ(sets.find(3), 3U);
}

TEST(DisjointSets, AgreeWithRelabelling) {
  constexpr std::uint32_t count = 300;
  DisjointSets sets(count);
  std::vector<std::uint32_t> set_of(count);
  for (std::uint32_t i = 0; i < count; ++i) set_of[i] = i;
  std::mt19937 random(5);
  for (int round = 0; round < 250; ++round) {
    const auto a = static_cast<std::uint32_t>(random() % count);
    const auto b = static_cast<std::uint32_t>(random() % count);
    const std::uint32_t kept = std::min(set_of[a], set_of[b]);
    const std::uint32_t lost = std::max(set_of[a], set_of[b]);
    EXPECT_EQ(sets.join(a, b), kept != lost);
    std::replace(set_of.begin(), set_of.end(), lost, kept);
  }
  for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(sets.find(i), set_of[i]);
}

}  // namespace
}  // namespace keenline
