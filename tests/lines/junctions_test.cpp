#include "keenline/lines/junctions.h"

#include <cmath>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/kernels/portable_math.h"

#include "support/cancelled_progress.h"
#include "support/straight_path.h"

namespace keenline {
namespace {

using test::straight_path;

const TraceFrame frame{{100, 200, 300}, 0.5};

constexpr Point x{1, 0, 0};
constexpr Point y{0, 1, 0};
constexpr Point z{0, 0, 1};

// Corners are drawn a little to where their lines were seen: by thousandths of a spacing.

TEST(ConnectPaths, ThreeEndsMeetInTheCommonPointOfTheirPlanes) {
  // They stop short of the corner by different lengths, one runs past it.
  const FeatureGraph graph =
      connect_paths({straight_path({1, 0, 0}, {20, 0, 0}, y, z), straight_path({0, 30, 0}, {0, 2, 0}, x, z),
                     straight_path({0, 0, -1}, {0, 0, 20}, x, y)},
                    frame, 6);
  validate(graph);
  ASSERT_EQ(graph.corners.size(), 1U);
  EXPECT_LT(distance(graph.corners[0].position, frame.origin), 2e-3);
  EXPECT_NEAR(*graph.corners[0].residual, 0, 1e-3);
  ASSERT_EQ(graph.polylines.size(), 3U);
  double length = 0;
  for (const Polyline& line : graph.polylines) {
    EXPECT_TRUE(line.start_corner.has_value() != line.end_corner.has_value());
    length += length_of(line);
  }
  EXPECT_NEAR(length, 0.5 * (20 + 30 + 20), 5e-3);
}

TEST(ConnectPaths, EndsThatFaceEachOtherAreOneLine) {
  const FeatureGraph graph = connect_paths(
      {straight_path({0, 0, 0}, {10, 0, 0}, y, z), straight_path({30, 0, 0}, {14, 0, 0}, y, z)}, frame, 6);
  validate(graph);
  ASSERT_EQ(graph.polylines.size(), 1U);
  EXPECT_TRUE(graph.corners.empty());
  EXPECT_NEAR(length_of(graph.polylines[0]), 0.5 * 30, 1e-9);
}

TEST(ConnectPaths, SeveralStretchesInARowAreOneLine) {
  for (const bool turned : {false, true}) {
    std::vector<Path> stretches;
    for (double from = 0; from < 60; from += 12) {
      const Point a{from, 0, 0};
      const Point b{from + 9, 0, 0};
      stretches.push_back(turned ? straight_path(b, a, y, z) : straight_path(a, b, y, z));
    }
    const FeatureGraph graph = connect_paths(stretches, frame, 6);
    validate(graph);
    ASSERT_EQ(graph.polylines.size(), 1U);
    EXPECT_NEAR(length_of(graph.polylines[0]), 0.5 * 57, 1e-9);
  }
}

TEST(ConnectPaths, AnyLengthIsNoNoiseWhereNoneIsAskedFor) {
  for (const double length : {0.0, 1.0, 2.0, 9.0}) {
    const FeatureGraph graph = connect_paths(
        {straight_path({0, 0, 0}, {length, 0, 0}, y, z), straight_path({1, 1, 1}, {1 + length, 1, 1}, y, z)},
        frame, 0);
    EXPECT_NO_THROW(validate(graph)) << length;
  }
}

TEST(ConnectPaths, ALineThatRunsIntoAnotherCutsIt) {
  const FeatureGraph graph = connect_paths(
      {straight_path({-15, 0, 0}, {15, 0, 0}, y, z), straight_path({0.3, 20, 0}, {0.3, 2, 0}, x, z)}, frame,
      6);
  validate(graph);
  ASSERT_EQ(graph.corners.size(), 1U);
  EXPECT_LT(distance(graph.corners[0].position, frame.global({0.3, 0, 0})), 1e-2);
  EXPECT_EQ(graph.polylines.size(), 3U);
}

TEST(ConnectPaths, ALineIsAsLongInItsSpacingsFromHoweverFarItWasSeen) {
  Path path = straight_path({0, 0, 0}, {8, 0, 0}, y, z);
  for (Foot& foot : path.feet) foot.scale = 2;
  EXPECT_TRUE(connect_paths({path}, frame, 6).polylines.empty());
  path.unit = 2;
  EXPECT_EQ(connect_paths({path}, frame, 6).polylines.size(), 1U);
}

TEST(ConnectPaths, ShortLinesWithLooseEndsAreNoise) {
  EXPECT_TRUE(connect_paths({straight_path({0, 0, 0}, {5, 0, 0}, y, z)}, frame, 6).polylines.empty());
  EXPECT_EQ(connect_paths({straight_path({0, 0, 0}, {7, 0, 0}, y, z)}, frame, 6).polylines.size(), 1U);
  EXPECT_TRUE(connect_paths({}, frame, 6).polylines.empty());
}

TEST(ConnectPaths, AStretchThatTheDetectorDidNotSeeMustLeadToACorner) {
  Path path = straight_path({0, 0, 0}, {30, 0, 0}, y, z);
  for (std::size_t i = 20; i < path.feet.size(); ++i) path.feet[i].is_backed = false;
  const FeatureGraph loose = connect_paths({path}, frame, 6);
  ASSERT_EQ(loose.polylines.size(), 1U);
  EXPECT_NEAR(length_of(loose.polylines[0]), 0.5 * 19, 1e-9);
  const FeatureGraph met = connect_paths({path, straight_path({31, 1, 0}, {31, 20, 0}, x, z)}, frame, 6);
  ASSERT_EQ(met.polylines.size(), 2U);
  EXPECT_NEAR(length_of(met.polylines[0]), 0.5 * 31, 5e-3);
}

TEST(ConnectPaths, ALooseEndBesideACornerBelongsToIt) {
  // The last path has run past the corner and aside.
  const FeatureGraph graph =
      connect_paths({straight_path({1, 0, 0}, {20, 0, 0}, y, z), straight_path({0, 1, 0}, {0, 20, 0}, x, z),
                     straight_path({0, 0, 1}, {0, 0, 20}, x, y),
                     straight_path({-20, -20, 1.3}, {-1, -1, 1.3}, {1, -1, 0}, z)},
                    frame, 6);
  validate(graph);
  EXPECT_EQ(graph.corners.size(), 1U);
  ASSERT_EQ(graph.polylines.size(), 4U);
  for (const Polyline& line : graph.polylines) EXPECT_TRUE(line.start_corner || line.end_corner);
}

TEST(ConnectPaths, ALoopWithLinesIsCutAtItsCorners) {
  Path loop;
  loop.closed = true;
  for (int i = 0; i < 60; ++i) {
    const auto [sin, cos] = kernels::sin_cos(kernels::radians(6.0 * i));
    Foot foot;
    foot.position = {10 * cos, 10 * sin, 0};
    foot.tangent = {-sin, cos, 0};
    foot.normals = {z, Point{cos, sin, 0}};
    foot.is_backed = true;
    loop.feet.push_back(foot);
  }
  const Path spoke = straight_path({12, 0, 0}, {30, 0, 0}, y, z);
  const FeatureGraph one = connect_paths({loop, spoke}, frame, 6);
  validate(one);
  EXPECT_EQ(one.corners.size(), 1U);
  ASSERT_EQ(one.polylines.size(), 2U);
  EXPECT_TRUE(one.polylines[0].closed);
  EXPECT_EQ(one.polylines[0].start_corner, 0U);
  const FeatureGraph two =
      connect_paths({loop, spoke, straight_path({-30, 0, 0}, {-12, 0, 0}, y, z)}, frame, 6);
  validate(two);
  EXPECT_EQ(two.corners.size(), 2U);
  ASSERT_EQ(two.polylines.size(), 4U);
  for (const Polyline& line : two.polylines) EXPECT_FALSE(line.closed);
  double length = 0;
  for (const Polyline& line : two.polylines) length += length_of(line);
  EXPECT_NEAR(length, 0.5 * (20 + 20 + 62.8), 0.5);
}

TEST(ConnectPaths, ALineThatPassesACornerIsCutThereHoweverWideThePointsAreApart) {
  for (const double scale : {1.0, 30.0}) {
    std::vector<Path> paths{straight_path({1, 0, 0}, {20, 0, 0}, y, z),
                            straight_path({0, 1, 0}, {0, 20, 0}, x, z),
                            straight_path({-15, 0, 1}, {15, 0, 1}, y, z)};
    for (Path& path : paths) {
      for (Foot& foot : path.feet) {
        foot.position = scaled(scale, foot.position);
        foot.scale = scale;
      }
    }
    const FeatureGraph graph = connect_paths(paths, frame, 6);
    validate(graph);
    EXPECT_EQ(graph.corners.size(), 1U) << scale;
    EXPECT_EQ(graph.polylines.size(), 4U) << scale;
  }
}

TEST(ConnectPaths, CanBeCancelled) {
  EXPECT_THROW(
      (void)connect_paths({straight_path({0, 0, 0}, {9, 0, 0}, y, z)}, frame, 6, test::CancelledProgress()),
      Cancelled);
}

}  // namespace
}  // namespace keenline
