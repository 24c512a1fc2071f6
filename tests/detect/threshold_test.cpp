#include "keenline/detect/threshold.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

std::vector<float> evenly(float from, float to, int count) {
  std::vector<float> scores;
  for (int i = 0; i < count; ++i)
    scores.push_back(from + (to - from) * (static_cast<float>(i) + 0.5F) / static_cast<float>(count));
  return scores;
}

std::vector<float> joined(std::vector<float> a, const std::vector<float>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Threshold, LiesInAGapBetweenLowAndHighScores) {
  const double found = choose_threshold(joined(evenly(0, 0.08F, 1000), evenly(0.3F, 0.6F, 100)), 0.05, 0.4);
  // Four fifths of it is no low score, five quarters of it no high one.
  EXPECT_GT(found, 0.08);
  EXPECT_LT(found, 0.3);
  EXPECT_GT(found * 1.25, 0.28);  // the largest of those
}

TEST(Threshold, IsTheLargestWhereNothingIsSharp) {
  EXPECT_DOUBLE_EQ(choose_threshold({}, 0.05, 0.4), 0.4);
  EXPECT_DOUBLE_EQ(choose_threshold(evenly(0, 0.01F, 50), 0.05, 0.4), 0.4);
}

TEST(Threshold, IsTheLargestWhereEverythingIsSharp) {
  EXPECT_DOUBLE_EQ(choose_threshold(evenly(0.8F, 1, 50), 0.05, 0.4), 0.4);
}

TEST(Threshold, IsWithinItsRange) {
  // Scores that fall faster than any threshold can follow: the smallest is the least unstable.
  std::vector<float> scores;
  for (int i = 1; i < 3000; ++i) scores.push_back(std::exp(-0.003F * static_cast<float>(i)));
  for (const double high : {0.06, 0.1, 0.9}) {
    const double found = choose_threshold(scores, 0.05, high);
    EXPECT_GE(found, 0.05 * (1 - 1e-12));
    EXPECT_LE(found, high);
  }
}

TEST(Threshold, DoesNotDependOnTheOrderOfScores) {
  std::mt19937 generator(5);
  std::vector<float> scores;
  for (int i = 0; i < 2000; ++i)
    scores.push_back(static_cast<float>(generator() % 1000) * static_cast<float>(generator() % 1000) / 1e6F);
  const double found = choose_threshold(scores, 0.05, 0.4);
  std::reverse(scores.begin(), scores.end());
  EXPECT_EQ(choose_threshold(scores, 0.05, 0.4), found);
}

}  // namespace
}  // namespace keenline
