#include "keenline/report/gauss_sphere.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keenline/detect/gauss.h"
#include "keenline/errors.h"
#include "keenline/report/legend.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

PointGaussMap three_lines() {
  PointGaussMap map;
  map.lines = {{1, 0, 0}, {0, 1, 0}, {0, 0.6F, 0.8F}};
  map.cluster = {0, 1, -1};
  map.sizes = {1, 1};
  map.kind = Kind::Edge;
  return map;
}

GaussSphereOptions seen_from(double azimuth_deg, double elevation_deg) {
  GaussSphereOptions options;
  options.camera = {azimuth_deg, elevation_deg};
  options.width = 300;
  options.height = 320;
  return options;
}

struct Center {
  double x = 0;
  double y = 0;
  int pixels = 0;
};

/// Of the pixels above the legend that have exactly this colour.
Center center_of(const Image& image, Color color) {
  Center center;
  for (int y = 0; y < 280; ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) != color) continue;
      center.x += x + 0.5;
      center.y += y + 0.5;
      ++center.pixels;
    }
  }
  if (center.pixels > 0) center.x /= center.pixels, center.y /= center.pixels;
  return center;
}

TEST(GaussSphere, LinesStandWhereTheyPointInTheColorOfTheirCluster) {
  // From the x axis: the first line is in the middle, the second at the rim.
  const Image image = draw_gauss_sphere(three_lines(), seen_from(0, 0));
  const Center first = center_of(image, color_of_number(0));
  const Center second = center_of(image, color_of_number(1));
  ASSERT_GT(first.pixels, 0);
  ASSERT_GT(second.pixels, 0);
  EXPECT_NEAR(first.x, 150, 1);
  EXPECT_NEAR(first.y, second.y, 1);
  EXPECT_GT(std::abs(second.x - 150), 100);
  EXPECT_LT(std::abs(second.x - 150), 145);
}

TEST(GaussSphere, BothEndsOfALineAreSeenTheFarOneFaint) {
  // Turned a little: the near end of the first line to the left, the far end to the right.
  const Image turned = draw_gauss_sphere(three_lines(), seen_from(30, 0));
  const Center near = center_of(turned, color_of_number(0));
  ASSERT_GT(near.pixels, 0);
  EXPECT_LT(near.x, 100);
  const Color far = turned.at(static_cast<int>(300 - near.x), static_cast<int>(near.y));
  EXPECT_GT(far.red, far.blue + 20);                  // the same hue
  EXPECT_GT(far.blue, color_of_number(0).blue + 60);  // but pale
  // A line and its reverse are the same picture.
  PointGaussMap reversed = three_lines();
  for (auto& line : reversed.lines)
    for (float& coordinate : line) coordinate = -coordinate;
  const Image same = draw_gauss_sphere(reversed, seen_from(30, 0));
  EXPECT_TRUE(std::equal(turned.pixels().begin(), turned.pixels().end(), same.pixels().begin()));
}

TEST(GaussSphere, ManyLinesInOnePlaceAreALargerDot) {
  PointGaussMap map = three_lines();
  const int alone = center_of(draw_gauss_sphere(map, seen_from(0, 0)), color_of_number(0)).pixels;
  map.lines.insert(map.lines.end(), 30, {1, 0, 0});
  map.cluster.insert(map.cluster.end(), 30, 0);
  EXPECT_GT(center_of(draw_gauss_sphere(map, seen_from(0, 0)), color_of_number(0)).pixels, 2 * alone);
}

TEST(GaussSphere, APointWithoutLinesIsAnEmptySphere) {
  const Image image = draw_gauss_sphere({}, seen_from(0, 0));
  EXPECT_EQ(center_of(image, color_of_number(0)).pixels, 0);
  EXPECT_NE(image.at(150, 150), white);
}

TEST(GaussSphere, OptionsOutOfRangeAreRefused) {
  GaussSphereOptions options;
  options.width = 10;
  test::expect_error<InvalidArgument>([&] { (void)draw_gauss_sphere({}, options); }, "64 to 8192");
  test::expect_error<InvalidArgument>([] { (void)draw_gauss_sphere({}, seen_from(0, 91)); }, "-90 to 90");
}

}  // namespace
}  // namespace keenline
