#include "keenline/lines/side_surface.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/uneven_clouds.h"

namespace keenline {
namespace {

constexpr std::array<double, 6> factors{0.5, -0.25, 0.125, 0.03, -0.02, 0.01};

double height_at(double x, double y) {
  return factors[0] + factors[1] * x + factors[2] * y + factors[3] * y * y + factors[4] * x * y +
         factors[5] * x * x;
}

/// A frame that is no axis of anything.
SideSurface tilted_frame() {
  SideSurface frame;
  frame.z = unit({1, 2, 3});
  frame.x = unit(cross(frame.z, {1, 0, 0}));
  frame.y = cross(frame.z, frame.x);
  return frame;
}

Point at(const SideSurface& frame, double x, double y, double z) {
  return sum(sum(scaled(x, frame.x), scaled(y, frame.y)), scaled(z, frame.z));
}

TEST(SideSurface, AQuadricIsFoundAgainInItsOwnPoints) {
  const SideSurface frame = tilted_frame();
  std::vector<Point> places;
  for (const Point& p : test::random_points(40, 1)) {
    const double x = 8 * p[0] - 4;
    const double y = 8 * p[1] - 4;
    places.push_back(frame.in_frame(at(frame, x, y, height_at(x, y))));
  }
  places.push_back({1, 1, 50});
  std::vector<double> weights(places.size(), 2);
  weights.back() = 0;
  const auto quadric = fit_surface(frame, places, weights, SurfaceTerms::Quadric);
  ASSERT_TRUE(quadric);
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_NEAR(quadric->height[i], factors[i], 1e-12) << i;
}

TEST(SideSurface, FewerTermsStayAtZero) {
  std::vector<Point> places;
  for (const Point& p : test::random_points(30, 2)) places.push_back({p[0], p[1], height_at(p[0], p[1])});
  const std::vector<double> weights(places.size(), 1);
  const auto plane = fit_surface({}, places, weights, SurfaceTerms::Plane);
  const auto bent = fit_surface({}, places, weights, SurfaceTerms::BentAlongY);
  ASSERT_TRUE(plane && bent);
  EXPECT_EQ(plane->height[3], 0);
  EXPECT_NE(bent->height[3], 0);
  EXPECT_EQ(bent->height[4], 0);
  EXPECT_EQ(bent->height[5], 0);
}

TEST(SideSurface, PointsInARowMakeNoSurface) {
  const std::vector<Point> row{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}, {4, 4, 0}, {5, 5, 0}, {6, 6, 0}};
  const std::vector<double> weights(row.size(), 1);
  EXPECT_FALSE(fit_surface({}, row, weights, SurfaceTerms::Plane));
  EXPECT_FALSE(fit_surface({}, row, std::vector<double>(row.size(), 0.0), SurfaceTerms::Plane));
  EXPECT_FALSE(fit_surface({}, {}, {}, SurfaceTerms::Plane));
}

TEST(SideSurface, NormalsArePerpendicularToTheSurface) {
  SideSurface surface = tilted_frame();
  surface.height = factors;
  constexpr double small = 1e-6;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(2.0, -1.0), std::pair(-3.0, 3.0)}) {
    const Point here = at(surface, x, y, height_at(x, y));
    const Point normal = surface.normal(here);
    EXPECT_NEAR(length(normal), 1, 1e-15);
    EXPECT_GT(dot(normal, surface.z), 0);
    EXPECT_NEAR(dot(normal, difference(at(surface, x + small, y, height_at(x + small, y)), here)), 0, 1e-11);
    EXPECT_NEAR(dot(normal, difference(at(surface, x, y + small, height_at(x, y + small)), here)), 0, 1e-11);
  }
}

TEST(SideSurface, DistancesFromASphereAreRightNearIt) {
  SideSurface sphere;  // of radius 10, its top at the origin
  sphere.height = {0, 0, 0, -0.05, 0, -0.05};
  EXPECT_NEAR(sphere.above({2, 0, 0}), 0.2, 1e-15);
  for (const double x : {0.0, 1.0, 2.0}) {
    const double z = std::sqrt(100 - x * x) - 10 + 0.1;
    EXPECT_NEAR(sphere.distance({x, 0, z}), std::hypot(x, z + 10) - 10, 0.003);
  }
}

TEST(SideSurface, OffsetsAreInSpacings) {
  const SideSurface surface{.origin = {1e7, 0, 0}, .spacing = 0.5};
  EXPECT_EQ(surface.offset_of({1e7 + 2, 1, 0}), (Point{4, 2, 0}));
}

}  // namespace
}  // namespace keenline
