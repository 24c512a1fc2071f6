#include "keenline/lines/join_lines.h"

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// From one place to another in steps of about 1, the spacing of these tests.
Polyline straight(const Point& from, const Point& to) {
  Polyline line;
  const int steps = std::max(1, static_cast<int>(std::lround(distance(from, to))));
  for (int i = 0; i <= steps; ++i)
    line.vertices.push_back(sum(from, scaled(static_cast<double>(i) / steps, difference(to, from))));
  line.support = static_cast<std::uint64_t>(steps);
  return line;
}

Polyline arc(double from_deg, double to_deg, double radius) {
  Polyline line;
  const double degree = std::acos(-1.0) / 180;
  const int steps = static_cast<int>(std::abs(to_deg - from_deg) * degree * radius) + 1;
  for (int i = 0; i <= steps; ++i) {
    const double angle = (from_deg + (to_deg - from_deg) * i / steps) * degree;
    line.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  return line;
}

FeatureGraph joined(std::vector<Polyline> lines) {
  FeatureGraph graph;
  graph.polylines = std::move(lines);
  FeatureGraph result = join_lines(graph, 1);
  validate(result);
  return result;
}

TEST(JoinLines, EndsThatFaceEachOtherAcrossAGapAreOneLine) {
  const Polyline left = straight({0, 0, 0}, {10, 0, 0});
  // Whichever way the parts run.
  for (const Polyline& right : {straight({15, 0, 0}, {30, 0, 0}), straight({30, 0, 0}, {15, 0, 0})}) {
    for (const auto& lines : {std::vector{left, right}, std::vector{right, left}}) {
      const FeatureGraph graph = joined(lines);
      ASSERT_EQ(graph.polylines.size(), 1U);
      EXPECT_DOUBLE_EQ(length_of(graph.polylines[0]), 30);
      EXPECT_EQ(graph.polylines[0].support, 25U);
    }
  }
  EXPECT_EQ(joined({left, straight({16.5, 0, 0}, {30, 0, 0})}).polylines.size(), 2U);  // too wide
}

TEST(JoinLines, OverlapsDoNotGoBackAndForth) {
  const FeatureGraph graph = joined({straight({0, 0, 0}, {10.4, 0, 0}), straight({9.6, 0, 0}, {20, 0, 0})});
  ASSERT_EQ(graph.polylines.size(), 1U);
  EXPECT_NEAR(length_of(graph.polylines[0]), 20, 1e-12);
  const FeatureGraph touching = joined({straight({0, 0, 0}, {10, 0, 0}), straight({10, 0, 0}, {20, 0, 0})});
  ASSERT_EQ(touching.polylines.size(), 1U);
  EXPECT_EQ(touching.polylines[0].vertices.size(), 21U);
}

TEST(JoinLines, BesideEachOtherIsNotInLine) {
  const Polyline left = straight({0, 0, 0}, {10, 0, 0});
  EXPECT_EQ(joined({left, straight({13, 0.3, 0}, {30, 0.3, 0})}).polylines.size(), 1U);
  EXPECT_EQ(joined({left, straight({13, 0.4, 0}, {30, 0.4, 0})}).polylines.size(), 2U);
  // Bent by 15 degrees; back the way it came; of another kind.
  EXPECT_EQ(joined({left, straight({10, 0, 0}, {10 + 19.3, 5.2, 0})}).polylines.size(), 2U);
  EXPECT_EQ(joined({left, straight({10, 0.1, 0}, {0, 0.1, 0})}).polylines.size(), 2U);
  Polyline border = straight({13, 0, 0}, {30, 0, 0});
  border.kind = LineKind::Border;
  EXPECT_EQ(joined({left, border}).polylines.size(), 2U);
}

TEST(JoinLines, EndsInCornersStay) {
  FeatureGraph graph;
  graph.corners.push_back({{10, 0, 0}, {}});
  graph.polylines = {straight({0, 0, 0}, {10, 0, 0}), straight({10, 0, 0}, {20, 0, 0})};
  graph.polylines[0].end_corner = 0;
  EXPECT_EQ(join_lines(graph, 1).polylines.size(), 2U);
  graph.polylines[1].start_corner = 0;
  EXPECT_EQ(join_lines(graph, 1).polylines.size(), 2U);
}

TEST(JoinLines, ChainsKeepTheirCornersAndWhatIsKnownOfVertices) {
  FeatureGraph graph;
  graph.corners = {{{0, 0, 0}, {}}, {{40, 0, 0}, {}}};
  graph.polylines = {straight({25, 0, 0}, {15, 0, 0}), straight({0, 0, 0}, {12, 0, 0}),
                     straight({40, 0, 0}, {28, 0, 0})};
  graph.polylines[1].start_corner = 0;
  graph.polylines[2].start_corner = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    Polyline& line = graph.polylines[i];
    line.residual.assign(line.vertices.size(), static_cast<double>(i));
    line.normals.assign(line.vertices.size(), {{0, 0, 1}, {0, 1, 0}});
  }
  graph.polylines[0].dihedral_deg.assign(11, 90);
  const FeatureGraph result = join_lines(graph, 1);
  validate(result);
  ASSERT_EQ(result.polylines.size(), 1U);
  const Polyline& line = result.polylines[0];
  EXPECT_DOUBLE_EQ(length_of(line), 40);
  EXPECT_TRUE(line.start_corner && line.end_corner && *line.start_corner != *line.end_corner);
  EXPECT_TRUE(line.dihedral_deg.empty());  // only one of the parts knew
  ASSERT_EQ(line.residual.size(), line.vertices.size());
  EXPECT_EQ(line.residual[line.residual.size() / 2], 0);
  // The parts ran against each other: left is the same side all along.
  const bool first_is_reversed = *line.start_corner == 1;
  for (std::size_t i = 0; i < line.vertices.size(); ++i)
    EXPECT_EQ(line.normals[i].left == (Point{0, 0, 1}), (line.residual[i] == 1) != first_is_reversed) << i;
}

TEST(JoinLines, ARingOfPartsIsClosed) {
  const FeatureGraph halves = joined({arc(2, 178, 60), arc(358, 182, 60)});
  ASSERT_EQ(halves.polylines.size(), 1U);
  EXPECT_TRUE(halves.polylines[0].closed);
  EXPECT_NEAR(length_of(halves.polylines[0]), 2 * std::acos(-1.0) * 60, 0.5);
  const FeatureGraph alone = joined({arc(-1, 359.5, 60)});  // overlaps itself
  ASSERT_EQ(alone.polylines.size(), 1U);
  EXPECT_TRUE(alone.polylines[0].closed);
  EXPECT_NEAR(length_of(alone.polylines[0]), 2 * std::acos(-1.0) * 60, 0.5);
}

TEST(JoinLines, WithoutLooseEndsNothingChanges) {
  EXPECT_TRUE(joined({}).polylines.empty());
  Polyline square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, .closed = true};
  EXPECT_EQ(joined({square}).polylines[0].vertices, square.vertices);
  square.vertices.resize(2);
  FeatureGraph invalid;
  invalid.polylines.push_back(square);
  EXPECT_THROW((void)join_lines(invalid, 1), InvalidArgument);
}

}  // namespace
}  // namespace keenline
