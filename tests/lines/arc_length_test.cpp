#include "keenline/lines/arc_length.h"

#include <gtest/gtest.h>

#include "keenline/vectors.h"

namespace keenline {
namespace {

const Polyline hook{.vertices = {{0, 0, 0}, {3, 0, 0}, {3, 0, 0}, {3, 4, 0}}};
const Polyline square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .closed = true};

TEST(ArcLength, FindsPlacesByTheWayToThem) {
  const ArcLength arc(hook);
  EXPECT_EQ(arc.total(), 7);
  EXPECT_EQ(arc.at(3), 7);
  EXPECT_EQ(arc.point(2), (Point{2, 0, 0}));
  EXPECT_EQ(arc.point(5), (Point{3, 2, 0}));
  EXPECT_EQ(arc.point(3), (Point{3, 0, 0}));
}

TEST(ArcLength, EndsWhereAnOpenLineEnds) {
  const ArcLength arc(hook);
  EXPECT_EQ(arc.point(-1), (Point{0, 0, 0}));
  EXPECT_EQ(arc.point(100), (Point{3, 4, 0}));
  EXPECT_EQ(arc.spot(100).segment, 2U);
  EXPECT_EQ(arc.spot(100).part, 1);
}

TEST(ArcLength, GoesRoundAClosedLine) {
  const ArcLength arc(square);
  EXPECT_EQ(arc.total(), 4);
  EXPECT_EQ(arc.point(3.5), (Point{0, 0.5, 0}));
  EXPECT_EQ(arc.point(9.25), (Point{1, 0.25, 0}));
  EXPECT_EQ(arc.point(-0.25), (Point{0, 0.25, 0}));
}

TEST(ArcLength, DirectionsAreTakenOverAWindow) {
  const ArcLength arc(hook);
  EXPECT_EQ(arc.direction(1, 1), (Point{1, 0, 0}));
  EXPECT_EQ(arc.direction(7, 2), (Point{0, 1, 0}));
  const Point round_the_bend = arc.direction(3, 2);
  EXPECT_NEAR(round_the_bend[0], round_the_bend[1], 1e-15);
  EXPECT_NEAR(length(round_the_bend), 1, 1e-15);
  // However large the window: a closed line is not as long back as it is forth.
  EXPECT_EQ(ArcLength(square).direction(0.5, 100), (Point{1, 0, 0}));
}

TEST(ArcLength, ALineOfOnePlaceHasNoDirection) {
  const Polyline nowhere{.vertices = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, .closed = true};
  const ArcLength arc(nowhere);
  EXPECT_EQ(arc.total(), 0);
  EXPECT_EQ(arc.point(5), (Point{1, 2, 3}));
  EXPECT_EQ(arc.direction(0, 1), (Point{0, 0, 0}));
}

}  // namespace
}  // namespace keenline
