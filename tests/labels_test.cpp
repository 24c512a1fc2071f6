#include "keenline/labels.h"

#include <set>

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(Labels, NumbersAreThoseThatFilesHold) {
  EXPECT_EQ(static_cast<int>(Kind::Flat), 0);
  EXPECT_EQ(static_cast<int>(Kind::Curved), 1);
  EXPECT_EQ(static_cast<int>(Kind::Edge), 2);
  EXPECT_EQ(static_cast<int>(Kind::Corner), 3);
  EXPECT_EQ(static_cast<int>(Kind::Peak), 4);
  EXPECT_EQ(static_cast<int>(Kind::Border), 5);
  EXPECT_EQ(static_cast<int>(Kind::Undecided), 255);
}

TEST(Labels, OnlyEdgesCornersAndPeaksAreFeatures) {
  std::set<std::string_view> features;
  std::set<std::string_view> names;
  for (const Kind kind : all_kinds) {
    names.insert(name_of(kind));
    if (is_feature(kind)) features.insert(name_of(kind));
  }
  EXPECT_EQ(names.size(), all_kinds.size());
  EXPECT_EQ(features, (std::set<std::string_view>{"edge", "corner", "peak"}));
}

}  // namespace
}  // namespace keenline
