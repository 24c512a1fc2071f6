#include "keenline/report/splats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"

namespace keenline {
namespace {

constexpr Color red{200, 0, 0};
constexpr Color blue{0, 0, 200};

Splat splat(float x, float y, float depth, float radius, Color color) {
  Splat s;
  s.x = x;
  s.y = y;
  s.depth = depth;
  s.radius = radius;
  s.color = color;
  return s;
}

SplatOptions size(int width, int height) {
  SplatOptions options;
  options.width = width;
  options.height = height;
  return options;
}

TEST(Splats, OneDiscWhereItBelongs) {
  const std::vector<Splat> splats{splat(10.5F, 6.5F, 0, 3, red)};
  const Image image = draw_splats(splats, size(21, 13));
  EXPECT_EQ(image.at(10, 6), red);
  EXPECT_EQ(image.at(12, 6), red);
  EXPECT_EQ(image.at(10, 2), white);
  EXPECT_EQ(image.at(14, 6), white);
}

TEST(Splats, TheRimIsSmooth) {
  const std::vector<Splat> splats{splat(10, 10, 0, 5, red)};
  const Image image = draw_splats(splats, size(20, 20));
  const auto pixels = image.pixels();
  EXPECT_TRUE(std::any_of(pixels.begin(), pixels.end(), [](Color c) { return c != red && c != white; }));
}

TEST(Splats, TheNearerHidesTheFartherInAnyOrder) {
  std::vector<Splat> splats{splat(5, 5, 1, 3, red), splat(5, 5, 2, 3, blue)};
  EXPECT_EQ(draw_splats(splats, size(10, 10)).at(5, 5), blue);
  std::swap(splats[0], splats[1]);
  EXPECT_EQ(draw_splats(splats, size(10, 10)).at(5, 5), blue);
}

TEST(Splats, OfEquallyNearOnesTheEarlierIsSeen) {
  const std::vector<Splat> splats{splat(5, 5, 1, 3, red), splat(5, 5, 1, 3, blue)};
  EXPECT_EQ(draw_splats(splats, size(10, 10)).at(5, 5), red);
}

TEST(Splats, ATiltedDiscIsNarrowAndCrossesAnother) {
  Splat tilted = splat(10, 10, 0, 6, red);
  tilted.normal = {std::sqrt(0.75F), 0, 0.5F};  // turned 60 degrees to the right
  const std::vector<Splat> alone{tilted};
  const Image narrow = draw_splats(alone, size(20, 20));
  EXPECT_NE(narrow.at(10, 5), white);  // 4.5 up: on the disc
  EXPECT_EQ(narrow.at(5, 10), white);  // 4.5 to the left: its rim lies at 3
  // Its left half is nearer than a disc that faces the viewer, its right half farther.
  const std::vector<Splat> both{tilted, splat(10, 10, 0, 6, blue)};
  const Image crossing = draw_splats(both, size(20, 20));
  EXPECT_EQ(crossing.at(8, 10).blue, 0);
  EXPECT_EQ(crossing.at(11, 10).red, 0);
}

TEST(Splats, SurfacesAreShadedByTheirDirection) {
  Splat left = splat(10, 10, 0, 5, {200, 200, 200});
  left.normal = {-0.5F, 0.5F, std::sqrt(0.5F)};
  Splat right = left;
  right.x = 30;
  right.normal = {0.5F, -0.5F, std::sqrt(0.5F)};
  const std::vector<Splat> splats{left, right};
  const Image image = draw_splats(splats, size(40, 20));
  EXPECT_GT(image.at(10, 10).red, image.at(30, 10).red + 20);
}

TEST(Splats, BehindARimItIsDarker) {
  const std::vector<Splat> splats{splat(15, 15, 0, 12, {200, 200, 200}), splat(15, 15, 100, 5, red)};
  SplatOptions options = size(30, 30);
  const Image shaded = draw_splats(splats, options);
  EXPECT_LT(shaded.at(21, 15).red, 200);
  EXPECT_EQ(shaded.at(25, 15).red, 200);
  EXPECT_EQ(shaded.at(15, 15), red);
  options.rim_darkness = 0;
  EXPECT_EQ(draw_splats(splats, options).at(21, 15).red, 200);
}

TEST(Splats, AMarkerIsABallWithADarkRim) {
  Splat marker = splat(20, 20, 0, 10, red);
  marker.is_marker = true;
  const std::vector<Splat> splats{marker};
  const Image image = draw_splats(splats, size(40, 40));
  EXPECT_EQ(image.at(20, 20), red);
  EXPECT_LT(image.at(28, 20).red, 160);
  EXPECT_GT(image.at(28, 20).red, 100);
}

TEST(Splats, NothingFallsBetweenTheSamples) {
  const std::vector<Splat> splats{splat(5.3F, 5.7F, 0, 1e-6F, red)};
  EXPECT_NE(draw_splats(splats, size(10, 10)).at(5, 5), white);
}

TEST(Splats, HostileNumbersAreLeftOut) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float largest = std::numeric_limits<float>::max();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Splat> splats;
  for (const float bad : {infinity, -infinity, nan, largest, -largest}) {
    splats.push_back(splat(bad, 5, 0, 2, red));
    splats.push_back(splat(5, bad, 0, 2, red));
    splats.push_back(splat(5, 5, bad, 2, red));
  }
  splats.push_back(splat(5, 5, 0, nan, red));
  const Image image = draw_splats(splats, size(10, 10));
  EXPECT_TRUE(std::all_of(image.pixels().begin(), image.pixels().end(), [](Color c) { return c == white; }));
  EXPECT_EQ(draw_splats({}, size(3, 3)).at(1, 1), white);
}

TEST(Splats, OptionsOutOfRangeAreRefused) {
  test::expect_error<InvalidArgument>([] { (void)draw_splats({}, size(0, 10)); }, "0 x 10");
  SplatOptions options = size(10, 10);
  options.supersampling = 9;
  test::expect_error<InvalidArgument>([&] { (void)draw_splats({}, options); }, "1 to 8");
}

TEST(Splats, CanBeStopped) {
  test::CancelledProgress stop;
  EXPECT_THROW((void)draw_splats({}, size(10, 10), stop), Cancelled);
}

}  // namespace
}  // namespace keenline
