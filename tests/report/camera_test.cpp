#include "keenline/report/camera.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

void expect_near(const Point& a, const Point& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-15);
}

TEST(Camera, KnownViews) {
  const CameraAxes front = axes_of({-90, 0});  // as a map's reader sees it, from the south
  expect_near(front.right, {1, 0, 0});
  expect_near(front.up, {0, 0, 1});
  expect_near(front.toward, {0, -1, 0});
  const CameraAxes above = axes_of({-90, 90});
  expect_near(above.right, {1, 0, 0});
  expect_near(above.up, {0, 1, 0});
  expect_near(above.toward, {0, 0, 1});
}

TEST(Camera, AxesAreOrthonormalAndRightHanded) {
  for (const double azimuth : {-720.0, -33.0, 0.0, 10.0, 359.0}) {
    for (const double elevation : {-90.0, -20.0, 0.0, 71.0, 90.0}) {
      const auto [right, up, toward] = axes_of({azimuth, elevation});
      EXPECT_NEAR(dot(right, right), 1, 1e-14);
      EXPECT_NEAR(dot(up, up), 1, 1e-14);
      EXPECT_NEAR(dot(right, up), 0, 1e-14);
      expect_near({right[1] * up[2] - right[2] * up[1], right[2] * up[0] - right[0] * up[2],
                   right[0] * up[1] - right[1] * up[0]},
                  toward);
    }
  }
}

TEST(Camera, RefusesAnglesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Camera& camera :
       {Camera{0, 91}, Camera{0, -90.5}, Camera{nan, 0}, Camera{0, nan}, Camera{1 / 0.0, 0}})
    test::expect_error<InvalidArgument>([&] { (void)axes_of(camera); }, "-90 to 90");
}

}  // namespace
}  // namespace keenline
