#include "keenline/report/picture.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/report/legend.h"
#include "keenline/synth/synth.h"
#include "keenline/synth/true_lines.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

SynthCloud shape(const std::string& name, std::uint64_t points, Sampling sampling = Sampling::Random) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.sampling = sampling;
  return synthesize(options);
}

PictureOptions view(double azimuth_deg, double elevation_deg, int width = 200, int height = 200) {
  PictureOptions options;
  options.camera = {azimuth_deg, elevation_deg};
  options.width = width;
  options.height = height;
  return options;
}

bool equal(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::equal(a.pixels().begin(), a.pixels().end(), b.pixels().begin());
}

/// Pixels of this hue, shaded or not: the largest part is the same and stands out from the smallest.
std::size_t pixels_like(const Image& image, Color color) {
  return static_cast<std::size_t>(
      std::count_if(image.pixels().begin(), image.pixels().end(), [color](Color c) {
        const auto off = [](int a, int b) { return std::abs(a - b) > 8; };
        return !off(c.red, color.red) && !off(c.green, color.green) && !off(c.blue, color.blue);
      }));
}

/// The picture without its legend.
constexpr int without_legend = 180;

std::size_t background_in(const Image& image, int left, int top, int right, int bottom) {
  std::size_t count = 0;
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x) count += image.at(x, y) == white ? 1U : 0U;
  return count;
}

PointCloud with_kinds(PointCloud cloud, const std::vector<std::uint8_t>& kinds) {
  cloud.set_attribute(Column("kind", kinds));
  return cloud;
}

TEST(Picture, LinesAndCornersStandInFrontOfTheirCloud) {
  const SynthCloud cube = shape("cube", 3000);
  const FeatureGraph graph = true_lines(cube);
  PictureOptions options = view(-60, 25);
  const Image without = draw_cloud(cube.cloud, options);
  options.lines = &graph;
  const Image with = draw_cloud(cube.cloud, options);
  const auto edge_pixels = [](const Image& image) { return pixels_like(image, color_of(Kind::Edge)); };
  const auto corner_pixels = [](const Image& image) { return pixels_like(image, color_of(Kind::Corner)); };
  EXPECT_EQ(edge_pixels(without), 0U);
  EXPECT_EQ(corner_pixels(without), 0U);
  EXPECT_GT(edge_pixels(with), 200U);
  EXPECT_GT(corner_pixels(with), 20U);
  // Labels of points would be in the way.
  const PointCloud labelled = with_kinds(cube.cloud, std::vector<std::uint8_t>(cube.cloud.size(), 2));
  EXPECT_TRUE(equal(draw_cloud(labelled, options), with));
  options.color = "kind";
  EXPECT_FALSE(equal(draw_cloud(labelled, options), with));
}

TEST(Picture, LinesFarLargerThanTheCloudAreDrawnOnlyInPart) {
  const SynthCloud cube = shape("cube", 500);
  PictureOptions options = view(-60, 25);
  for (const double far : {1e3, 1e9, 1e150}) {
    FeatureGraph graph;
    graph.polylines.push_back({.vertices = {{-far, 0, 0}, {far, 0, 0}, {0, far, far}}});
    options.lines = &graph;
    EXPECT_EQ(draw_cloud(cube.cloud, options).width(), 200) << far;
  }
}

TEST(Picture, ASinglePointStandsInTheMiddle) {
  PointCloud cloud;
  cloud.positions = {{5, -7, 1e6}};
  const Image image = draw_cloud(cloud, view(20, 30));
  int left = image.width();
  int right = 0;
  int top = image.height();
  int bottom = 0;
  for (int y = 0; y < without_legend; ++y) {
    for (int x = 0; x < image.width(); ++x) {
      if (image.at(x, y) == white) continue;
      left = std::min(left, x), right = std::max(right, x);
      top = std::min(top, y), bottom = std::max(bottom, y);
    }
  }
  ASSERT_LE(left, right);
  EXPECT_NEAR(left, image.width() - 1 - right, 1);
  EXPECT_NEAR((top + bottom) / 2, without_legend / 2, 3);
  EXPECT_LT(right - left, 12);
}

TEST(Picture, ASurfaceHasNoHoles) {
  for (const Sampling sampling : {Sampling::Random, Sampling::Grid, Sampling::Mesh}) {
    const PointCloud cloud = shape("plane", 4000, sampling).cloud;
    const Image image = draw_cloud(cloud, view(-90, 90));  // from above: the square fills the picture
    EXPECT_EQ(background_in(image, 25, 15, 175, 165), 0U);
    EXPECT_EQ(background_in(image, 0, 0, 8, 160), 8U * 160U);  // and the margin is empty
  }
}

TEST(Picture, TheNearFaceHidesTheFarOne) {
  PointCloud cloud;
  std::vector<std::uint8_t> kinds;
  for (const double z : {0.0, 1.0}) {
    for (int i = 0; i < 40; ++i) {
      for (int j = 0; j < 40; ++j) {
        cloud.positions.push_back({i / 40.0, j / 40.0, z});
        kinds.push_back(static_cast<std::uint8_t>(z == 0 ? Kind::Curved : Kind::Undecided));
      }
    }
  }
  cloud = with_kinds(cloud, kinds);
  const Image above = draw_cloud(cloud, view(-90, 90));
  const Image below = draw_cloud(cloud, view(-90, -90));
  const auto blue = [](Color c) { return c.blue > c.red + 20; };
  EXPECT_FALSE(blue(above.at(100, 90)));
  EXPECT_TRUE(blue(below.at(100, 90)));
}

TEST(Picture, SharpPointsStandInFront) {
  PointCloud cloud;
  std::vector<std::uint8_t> kinds;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      cloud.positions.push_back({i / 30.0, j / 30.0, 0});
      kinds.push_back(static_cast<std::uint8_t>(Kind::Flat));
    }
  }
  kinds[15 * 30 + 15] = static_cast<std::uint8_t>(Kind::Edge);
  const Image image = draw_cloud(with_kinds(cloud, kinds), view(-90, 90));
  std::size_t seen = 0;
  for (int y = 60; y < 120; ++y)
    for (int x = 60; x < 140; ++x) seen += image.at(x, y) == color_of(Kind::Edge) ? 1U : 0U;
  EXPECT_GT(seen, 0U);
  EXPECT_LT(seen, 60U);
}

TEST(Picture, KindIsShownWithoutAsking) {
  const PointCloud cloud = shape("cube", 2000).cloud;
  std::vector<std::uint8_t> kinds;
  const Column& truth = *cloud.attribute("truth_kind");
  for (std::size_t i = 0; i < cloud.size(); ++i) kinds.push_back(static_cast<std::uint8_t>(truth.value(i)));
  EXPECT_EQ(pixels_like(draw_cloud(cloud, view(30, 30)), color_of(Kind::Edge)), 0U);
  PictureOptions by_truth = view(30, 30);
  by_truth.color = "truth_kind";
  const Image truth_picture = draw_cloud(cloud, by_truth);
  EXPECT_GT(pixels_like(truth_picture, color_of(Kind::Edge)), 100U);
  EXPECT_TRUE(equal(draw_cloud(with_kinds(cloud, kinds), view(30, 30)), truth_picture));
}

TEST(Picture, ValuesAreShownFromSmallestToLargest) {
  PointCloud cloud;
  std::vector<double> heights;
  for (int i = 0; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      cloud.positions.push_back({i / 40.0, j / 40.0, 0});
      heights.push_back(i < 20 ? -1e308 : 1e308);
    }
  }
  heights[0] = std::numeric_limits<double>::infinity();
  cloud.set_attribute(Column("height", heights));
  PictureOptions options = view(-90, 90);
  options.color = "height";
  const Image image = draw_cloud(cloud, options);
  const Color low = image.at(60, 90);
  const Color high = image.at(140, 90);
  EXPECT_GT(low.blue, low.green);    // violet
  EXPECT_GT(high.green, high.blue);  // yellow
}

TEST(Picture, SameCloudSamePixelsWithAnyNumberOfThreads) {
  const PointCloud cloud = shape("fandisk", 5000).cloud;
  const Image image = draw_cloud(cloud, view(-60, 25));
  for (const std::size_t threads : {1U, 3U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(equal(draw_cloud(cloud, view(-60, 25)), image));
  }
}

TEST(Picture, SizeAndPlaceOfACloudDoNotMatter) {
  const PointCloud cloud = shape("cube", 1500, Sampling::Grid).cloud;
  const Image image = draw_cloud(cloud, view(-60, 25));
  // Powers of two move and scale without rounding.
  for (const auto& [factor, shift] : {std::pair{0x1p-1000, 0.0}, {0x1p1000, 0.0}, {1.0, 0x1p20}}) {
    PointCloud other = cloud;
    for (Point& p : other.positions)
      for (double& coordinate : p) coordinate = coordinate * factor + shift;
    EXPECT_GT(background_in(image, 0, 0, 200, 180), 0U);
    const Image drawn = draw_cloud(other, view(-60, 25));
    std::size_t different = 0;
    for (std::size_t i = 0; i < image.pixels().size(); ++i)
      different += image.pixels()[i] == drawn.pixels()[i] ? 0U : 1U;
    EXPECT_LT(different, image.pixels().size() / 100) << factor << " " << shift;
  }
}

TEST(Picture, HostileCloudsAreDrawn) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double largest = std::numeric_limits<double>::max();
  const double smallest = std::numeric_limits<double>::denorm_min();
  const std::vector<std::vector<Point>> clouds{
      {},
      {{nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}},
      {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
      {{0, 0, 0}, {1, 1, 1}},
      {{largest, largest, largest}, {-largest, -largest, -largest}, {0, 0, 0}},
      {{0, 0, 0}, {smallest, 0, 0}, {0, smallest, 0}, {0, 0, smallest}, {smallest, smallest, 0}},
      {{0, 0, 0}, {1e-300, 0, 0}, {1e300, 0, 0}, {nan, nan, nan}},
      {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}, {0, 0, 4}, {0, 0, 5}}};
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    PointCloud cloud;
    cloud.positions = clouds[i];
    for (const double elevation : {0.0, 90.0}) {
      const Image image = draw_cloud(cloud, view(0, elevation));
      const std::size_t drawn = 200U * 180U - background_in(image, 0, 0, 200, 180);
      if (count_finite(cloud) == 0) EXPECT_EQ(drawn, 0U) << i;
      else EXPECT_GT(drawn, 0U) << i;
      EXPECT_LT(drawn, 200U * 180U) << i;
    }
  }
}

TEST(Picture, AStrayPointDoesNotCoverThePicture) {
  PointCloud cloud = shape("cube", 2000).cloud;
  cloud.attributes.clear();
  cloud.positions.push_back({3, 0, 0});
  const Image image = draw_cloud(cloud, view(-90, 0));
  EXPECT_GT(background_in(image, 80, 20, 175, 160), 94U * 140U);
}

TEST(Picture, CaptionAndLegendTakeTheirRoom) {
  const PointCloud cloud = shape("cube", 500).cloud;
  PictureOptions options = view(0, 0);
  const auto ink_in = [](const Image& image, int top, int bottom) {
    int count = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = 0; x < image.width(); ++x) count += image.at(x, y) == ink ? 1 : 0;
    return count;
  };
  const Image plain = draw_cloud(cloud, options);
  EXPECT_EQ(ink_in(plain, 0, without_legend), 0);
  EXPECT_GT(ink_in(plain, without_legend, 200), 20);
  options.caption = "a cube";
  const Image titled = draw_cloud(cloud, options);
  EXPECT_GT(ink_in(titled, 0, 20), 20);
  EXPECT_EQ(ink_in(titled, 20, without_legend), 0);
  EXPECT_EQ(titled.height(), 200);
}

TEST(Picture, RefusesWhatCannotBeShown) {
  PointCloud cloud = shape("cube", 100).cloud;
  PictureOptions options = view(0, 0);
  options.color = "speed";
  test::expect_error<InvalidArgument>([&] { (void)draw_cloud(cloud, options); }, "speed", "truth_kind");
  options.color.clear();
  cloud = with_kinds(cloud, std::vector<std::uint8_t>(100, 17));
  test::expect_error<InvalidArgument>([&] { (void)draw_cloud(cloud, options); }, "17", "kind");
  for (const auto& [width, height] : {std::pair{63, 100}, {100, 9000}})
    test::expect_error<InvalidArgument>(
        [&, w = width, h = height] { (void)draw_cloud({}, view(0, 0, w, h)); }, "64 to 8192");
  test::expect_error<InvalidArgument>([] { (void)draw_cloud({}, view(0, 100)); }, "-90 to 90");
}

}  // namespace
}  // namespace keenline
