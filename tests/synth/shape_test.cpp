#include "keenline/synth/shape.h"

#include <array>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::pi;

Outline triangle() { return polygon_outline(std::array<Vec3, 3>{{{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}}); }

TEST(Shape, distances_are_infinite_without_features) {
  EXPECT_EQ(distance_to(std::span<const Curve>{}, {}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(distance_to(std::span<const Vec3>{}, {}), std::numeric_limits<double>::infinity());
  const std::vector<Vec3> points{{3, 0, 0}, {0, 2, 0}};
  EXPECT_EQ(distance_to(points, {}), 2);
}

TEST(ShapeBuilder, prism_of_a_triangle) {
  ShapeBuilder builder;
  builder.prism({triangle()}, -1, 1);
  const Shape prism = std::move(builder).finish();
  EXPECT_EQ(prism.faces.size(), 5U);
  EXPECT_EQ(prism.edges.size(), 9U);
  EXPECT_EQ(prism.corners.size(), 6U);
  EXPECT_TRUE(prism.borders.empty());
  EXPECT_NEAR(prism.area(), 2 * 6 + 2 * 12, 1e-13);
  EXPECT_NEAR(prism.bounds().diagonal(), std::sqrt(16.0 + 9 + 4), 1e-14);
}

TEST(ShapeBuilder, smooth_joints_of_an_outline_leave_no_edge_on_its_wall) {
  // A stadium: two lines, two half circles, all tangent.
  const Outline stadium{Curve::segment({-1, -1, 0}, {1, -1, 0}), Curve::arc({1, -1, 0}, {1, 1, 0}, {1, 0, 0}),
                        Curve::segment({1, 1, 0}, {-1, 1, 0}),
                        Curve::arc({-1, 1, 0}, {-1, -1, 0}, {-1, 0, 0})};
  ShapeBuilder builder;
  builder.prism({stadium}, 0, 1);
  const Shape shape = std::move(builder).finish();
  EXPECT_EQ(shape.edges.size(), 8U);
  EXPECT_TRUE(shape.corners.empty());
  EXPECT_NEAR(shape.area(), 2 * (4 + pi) + 4 + 2 * pi, 1e-13);
}

TEST(ShapeBuilder, revolved_chain_finds_edges_peaks_and_borders) {
  // Open at the bottom, a kink at (2, 0), a peak at (0, 2).
  ShapeBuilder builder;
  builder.revolve({Curve::segment({1, -1, 0}, {2, 0, 0}), Curve::segment({2, 0, 0}, {0, 2, 0})});
  const Shape shape = std::move(builder).finish();
  ASSERT_EQ(shape.edges.size(), 1U);
  EXPECT_NEAR(shape.edges[0].length(), 4 * pi, 1e-14);
  ASSERT_EQ(shape.borders.size(), 1U);
  EXPECT_NEAR(shape.borders[0].length(), 2 * pi, 1e-14);
  ASSERT_EQ(shape.peaks.size(), 1U);
  EXPECT_EQ(shape.peaks[0].point(), (Point{0, 0, 2}));
}

TEST(ShapeBuilder, a_ring_of_constant_height_is_a_plane_face_with_a_hole) {
  ShapeBuilder builder;
  builder.revolve({Curve::segment({1, 0, 0}, {3, 0, 0})});
  const Shape ring = std::move(builder).finish();
  EXPECT_NEAR(ring.area(), 8 * pi, 1e-13);
  EXPECT_FALSE(ring.faces[0]->is_curved());
  EXPECT_EQ(ring.borders.size(), 2U);
}

TEST(ShapeBuilder, polygons_share_their_edges) {
  const std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  ShapeBuilder builder;
  builder.polygons(vertices, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 2, 3}});
  const Shape tetrahedron = std::move(builder).finish();
  EXPECT_EQ(tetrahedron.edges.size(), 6U);
  EXPECT_EQ(tetrahedron.corners.size(), 4U);
  EXPECT_NEAR(tetrahedron.area(), 1.5 + 0.5 * std::sqrt(3.0), 1e-14);
}

}  // namespace
}  // namespace keenline::synth
