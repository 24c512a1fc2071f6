#include "keenline/report/lettering.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace keenline {
namespace {

/// The letters as lines of '#' and '.', one per dot.
std::string drawn(std::string_view text, int width, int height) {
  Image image(width, height);
  draw_text(image, 0, 0, text, 1, Color{0, 0, 0});
  std::string lines;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) lines += image.at(x, y).red < 64 ? '#' : '.';
    lines += '\n';
  }
  return lines;
}

TEST(Lettering, DrawsTheTablesDots) {
  EXPECT_EQ(drawn("L", 6, 9), "#.....\n#.....\n#.....\n#.....\n#.....\n#.....\n#####.\n......\n......\n");
  EXPECT_EQ(drawn("+", 6, 7), "......\n..#...\n..#...\n#####.\n..#...\n..#...\n......\n");
}

TEST(Lettering, EveryLetterIsItsOwn) {
  std::set<std::string> shapes;
  for (char letter = ' '; letter <= '~'; ++letter) shapes.insert(drawn({&letter, 1}, 6, 9));
  EXPECT_EQ(shapes.size(), 95U);
}

TEST(Lettering, SizeScalesTheLetters) {
  Image image(60, 80);
  draw_text(image, 0, 0, "I", 8, Color{0, 0, 0});
  EXPECT_EQ(image.at(12, 28), (Color{0, 0, 0}));  // the stem: the second of three columns
  EXPECT_EQ(image.at(4, 28), white);
  EXPECT_DOUBLE_EQ(text_width("I", 8), 24);
  EXPECT_DOUBLE_EQ(text_width("Wort", 3), 3 * text_width("Wort", 1));
  EXPECT_EQ(text_width("", 3), 0);
}

TEST(Lettering, DigitsStandInColumns) {
  EXPECT_EQ(text_width("111", 2), text_width("888", 2));
  EXPECT_LT(text_width("iii", 2), text_width("mmm", 2));
}

TEST(Lettering, WhatIsNotPrintableIsAQuestionMark) {
  EXPECT_EQ(drawn("\n", 6, 9), drawn("?", 6, 9));
  EXPECT_EQ(drawn("\xc3\xa9", 14, 9), drawn("?", 14, 9));  // one character of two bytes
  EXPECT_EQ(drawn(std::string_view("\0\x7f", 2), 14, 9), drawn("??", 14, 9));
}

TEST(Lettering, FittedCutsWhatIsTooLong) {
  EXPECT_EQ(fitted("short", 1000, 2), "short");
  const std::string cut = fitted("a very long line of text", 60, 1);
  EXPECT_LE(text_width(cut, 1), 60);
  EXPECT_TRUE(cut.starts_with("a very"));
  EXPECT_TRUE(cut.ends_with("..."));
  EXPECT_EQ(fitted("a very long line of text", 0, 1), "...");
}

TEST(Lettering, TextPartlyOutsideIsClipped) {
  Image image(10, 5);
  draw_text(image, -7, -3, "HHHHHHHHHH", 1.7);
  draw_text(image, 1e9, 1e9, "H", 2);
  EXPECT_NE(image.at(5, 2), image.at(9, 4));
}

}  // namespace
}  // namespace keenline
