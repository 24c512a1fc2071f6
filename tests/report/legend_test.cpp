#include "keenline/report/legend.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace keenline {
namespace {

/// Luminance, which every kind of colour vision sees.
double luminance(Color color) {
  const auto linear = [](std::uint8_t part) { return std::pow(part / 255.0, 2.2); };
  return 0.2126 * linear(color.red) + 0.7152 * linear(color.green) + 0.0722 * linear(color.blue);
}

bool shows(const Image& image, Color color) {
  return std::count(image.pixels().begin(), image.pixels().end(), color) > 0;
}

TEST(Legend, EveryKindHasItsColor) {
  std::set<std::tuple<int, int, int>> colors;
  for (const Kind kind : all_kinds) {
    const Color color = color_of(kind);
    colors.insert({color.red, color.green, color.blue});
  }
  EXPECT_EQ(colors.size(), all_kinds.size());
}

TEST(Legend, SharpIsDarkerThanSmoothForEveryEye) {
  for (const Kind sharp : {Kind::Edge, Kind::Corner, Kind::Peak})
    for (const Kind smooth : {Kind::Flat, Kind::Curved})
      EXPECT_LT(luminance(color_of(sharp)) + 0.1, luminance(color_of(smooth)));
  EXPECT_GT(luminance(color_of(Kind::Edge)) - luminance(color_of(Kind::Corner)), 0.1);
}

TEST(Legend, SharesRiseInBrightness) {
  for (int i = 0; i < 20; ++i)
    EXPECT_LT(luminance(color_of_share(i / 20.0)), luminance(color_of_share((i + 1) / 20.0))) << i;
  EXPECT_EQ(color_of_share(-3), color_of_share(0));
  EXPECT_EQ(color_of_share(3), color_of_share(1));
}

TEST(Legend, NumbersHaveEightColors) {
  for (int a = 0; a < 8; ++a)
    for (int b = 0; b < a; ++b) EXPECT_NE(color_of_number(a), color_of_number(b));
  EXPECT_EQ(color_of_number(8), color_of_number(0));
}

TEST(Legend, CountsTheKindsThatOccur) {
  std::vector<Kind> kinds(1234, Kind::Flat);
  kinds.push_back(Kind::Undecided);
  kinds.insert(kinds.end(), 2, Kind::Corner);
  const auto entries = legend_of(kinds);
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].text, "flat 1,234");
  EXPECT_EQ(entries[1].text, "corner 2");
  EXPECT_EQ(entries[1].color, color_of(Kind::Corner));
  EXPECT_EQ(entries[2].text, "undecided 1");
  EXPECT_TRUE(legend_of(std::span<const Kind>{}).empty());
}

TEST(Legend, IsDrawnInAsManyRowsAsItNeeds) {
  const std::vector<LegendEntry> entries{{{200, 0, 0}, "one"}, {{0, 200, 0}, "two"}, {{0, 0, 200}, "three"}};
  const int wide = legend_height(entries, 400);
  const int narrow = legend_height(entries, 80);
  EXPECT_GT(wide, 0);
  EXPECT_GT(narrow, wide + 12);
  EXPECT_EQ(legend_height({}, 400), 0);
  for (const auto& [width, height] : {std::pair{400, wide}, {80, narrow}}) {
    Image image(width, height);
    draw_legend(image, 0, entries);
    for (const LegendEntry& entry : entries) EXPECT_TRUE(shows(image, entry.color)) << entry.text;
    EXPECT_TRUE(shows(image, ink));
  }
}

TEST(Legend, AColorBarRunsFromLowToHigh) {
  Image image(400, 20);
  draw_color_bar(image, 4, "score", "0", "90");
  std::vector<double> bar;
  for (int x = 100; x < 360; x += 20) bar.push_back(luminance(image.at(x, 8)));
  EXPECT_TRUE(std::is_sorted(bar.begin(), bar.end()));
  EXPECT_LT(bar.front() + 0.3, bar.back());
  Image tiny(10, 5);
  draw_color_bar(tiny, 3, "a very long name of an attribute", "-1e+300",
                 "1e+300");  // nothing to see, no crash
}

TEST(Legend, ACaptionStandsInTheMiddle) {
  Image image(200, caption_height("abc", 200));
  draw_caption(image, "abc");
  int left = image.width();
  int right = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) == white) continue;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  EXPECT_LT(left, right);
  EXPECT_NEAR(left, image.width() - 1 - right, 2);
  EXPECT_EQ(caption_height("", 200), 0);
}

}  // namespace
}  // namespace keenline
