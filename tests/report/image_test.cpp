#include "keenline/report/image.h"

#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

constexpr Color red{200, 0, 0};
constexpr Color blue{0, 0, 200};

TEST(Image, IsFilledAndAddressedByRows) {
  Image image(3, 2, red);
  image.at(2, 1) = blue;
  ASSERT_EQ(image.pixels().size(), 6U);
  EXPECT_EQ(image.pixels()[0], red);
  EXPECT_EQ(image.pixels()[5], blue);
}

TEST(Image, RefusesSizesThatAreNone) {
  for (const auto& [width, height] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {5, 40000}})
    test::expect_error<InvalidArgument>([w = width, h = height] { (void)Image(w, h); },
                                        "expected 1 to 32768");
}

TEST(Image, MixesColors) {
  EXPECT_EQ(mixed({0, 100, 255}, {100, 0, 255}, 0), (Color{0, 100, 255}));
  EXPECT_EQ(mixed({0, 100, 255}, {100, 0, 255}, 0.25), (Color{25, 75, 255}));
  EXPECT_EQ(mixed({0, 100, 255}, {100, 0, 255}, 7), (Color{100, 0, 255}));
}

TEST(Image, ADiscIsFullInsideSmoothAtItsRimAndEmptyOutside) {
  Image image(21, 21);
  draw_disc(image, 10.5, 10.5, 5, red);
  EXPECT_EQ(image.at(10, 10), red);
  EXPECT_EQ(image.at(14, 10), red);                     // 4 from the centre
  EXPECT_EQ(image.at(15, 10), mixed(white, red, 0.5));  // 5: half of the pixel is covered
  EXPECT_EQ(image.at(16, 10), white);
  EXPECT_EQ(image.at(14, 14), mixed(white, red, 0));  // 5.66 off: outside
}

TEST(Image, ALineHasItsThicknessAndRoundEnds) {
  Image image(30, 11);
  draw_line(image, 5.5, 5.5, 20.5, 5.5, 3, red);
  for (int x = 5; x <= 20; ++x) {
    EXPECT_EQ(image.at(x, 4), red) << x;
    EXPECT_EQ(image.at(x, 6), red) << x;
    EXPECT_EQ(image.at(x, 8), white) << x;
  }
  EXPECT_EQ(image.at(21, 5), red);
  EXPECT_EQ(image.at(23, 5), white);
}

TEST(Image, OpacityLetsThroughWhatIsBelow) {
  Image image(9, 9, blue);
  draw_disc(image, 4.5, 4.5, 3, red, 0.5);
  EXPECT_EQ(image.at(4, 4), mixed(blue, red, 0.5));
}

TEST(Image, WhatLiesOutsideIsNotDrawn) {
  Image image(8, 8);
  const Image before = image;
  const double far = 1e300;
  draw_disc(image, far, -far, 3, red);
  draw_disc(image, -50, 4, 3, red);
  EXPECT_TRUE(std::equal(image.pixels().begin(), image.pixels().end(), before.pixels().begin()));
  draw_line(image, -1e6, 4, 1e6, 4, 2, red);
  EXPECT_EQ(image.at(0, 4), red);
  EXPECT_EQ(image.at(7, 4), red);
}

TEST(Image, PasteClipsAtEverySide) {
  Image image(4, 4);
  paste(image, Image(3, 3, red), -1, 2);
  EXPECT_EQ(image.at(1, 2), red);
  EXPECT_EQ(image.at(0, 3), red);
  EXPECT_EQ(image.at(2, 2), white);
  EXPECT_EQ(image.at(0, 1), white);
}

TEST(Image, ASheetPlacesPicturesInRows) {
  const std::vector<Image> images{Image(10, 4, red), Image(6, 8, blue), Image(3, 3, ink)};
  const Image sheet = sheet_of(images, 2);
  EXPECT_EQ(sheet.width(), 16);
  EXPECT_EQ(sheet.height(), 11);
  EXPECT_EQ(sheet.at(0, 0), red);
  EXPECT_EQ(sheet.at(0, 5), white);  // the row is as high as its highest
  EXPECT_EQ(sheet.at(15, 7), blue);
  EXPECT_EQ(sheet.at(2, 10), ink);
  EXPECT_EQ(sheet_of(images, 100).width(), 19);
}

TEST(Image, ASheetRefusesWhatItCannotHold) {
  test::expect_error<InvalidArgument>([] { (void)sheet_of({}, 1); }, "0 pictures");
  const std::vector<Image> wide(2, Image(20000, 1));
  test::expect_error<InvalidArgument>([&] { (void)sheet_of(wide, 2); }, "40000 x 1");
  EXPECT_EQ(sheet_of(wide, 1).height(), 2);
}

}  // namespace
}  // namespace keenline
