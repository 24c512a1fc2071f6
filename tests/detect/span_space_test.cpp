#include "keenline/detect/span_space.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"

namespace keenline {
namespace {

bool span_space(const std::vector<Point>& normals) {
  kernels::Symmetric3 squares;
  for (const Point& normal : normals) kernels::add_square(squares, normal, 1);
  return normals_span_space(squares);
}

/// In the xy plane.
Point at(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle), 0};
}

TEST(SpanSpace, TheFacesOfACubeDoTheFacesOfAPrismDoNot) {
  EXPECT_TRUE(span_space({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_FALSE(span_space({at(0), at(60), at(120)}));
  EXPECT_FALSE(span_space({at(0), at(90)}));
  EXPECT_FALSE(span_space({}));
}

TEST(SpanSpace, TwoNormalsMustBe28DegreesApart) {
  const Point across{0, 0, 1};
  EXPECT_FALSE(span_space({at(0), at(28), across}));
  EXPECT_TRUE(span_space({at(0), at(29), across}));
}

}  // namespace
}  // namespace keenline
