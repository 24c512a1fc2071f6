#include "keenline/synth/true_lines.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace keenline {
namespace {

FeatureGraph lines_of(const std::string& shape, std::uint64_t points = 2000) {
  SynthOptions options;
  options.shape = shape;
  options.points = points;
  FeatureGraph graph = true_lines(synthesize(options));
  validate(graph);
  return graph;
}

double total_length(const FeatureGraph& graph) {
  double length = 0;
  for (const Polyline& line : graph.polylines) length += length_of(line);
  return length;
}

TEST(TrueLines, ACubeHasTwelveStraightEdgesBetweenEightCornersOfThree) {
  const FeatureGraph graph = lines_of("cube");
  ASSERT_EQ(graph.corners.size(), 8U);
  ASSERT_EQ(graph.polylines.size(), 12U);
  std::vector<int> ends(8, 0);
  for (const Polyline& line : graph.polylines) {
    ASSERT_TRUE(line.start_corner && line.end_corner);
    ++ends[*line.start_corner];
    ++ends[*line.end_corner];
    ASSERT_EQ(line.vertices.size(), 2U);
    EXPECT_EQ(line.vertices.front(), graph.corners[*line.start_corner].position);
    EXPECT_EQ(line.vertices.back(), graph.corners[*line.end_corner].position);
    EXPECT_EQ(length_of(line), 1);
    EXPECT_EQ(line.kind, LineKind::Crease);
  }
  EXPECT_EQ(ends, std::vector<int>(8, 3));
}

TEST(TrueLines, ARoundedCubeHasTheLinesOfACube) {
  const FeatureGraph rounded = lines_of("rounded-cube");
  EXPECT_EQ(rounded.corners.size(), 8U);
  ASSERT_EQ(rounded.polylines.size(), 12U);
  for (const Polyline& line : rounded.polylines) {
    EXPECT_TRUE(line.start_corner && line.end_corner);
    EXPECT_EQ(length_of(line), 1);
  }
}

TEST(TrueLines, ACylinderHasTwoLoopsThatMissTheCirclesByAThousandthAtMost) {
  const FeatureGraph graph = lines_of("cylinder", 50);  // the angle limits the chords, not the spacing
  EXPECT_TRUE(graph.corners.empty());
  ASSERT_EQ(graph.polylines.size(), 2U);
  for (const Polyline& line : graph.polylines) {
    EXPECT_TRUE(line.closed);
    EXPECT_FALSE(line.start_corner || line.end_corner);
    const double pi = std::acos(-1);
    EXPECT_NEAR(length_of(line), 2 * pi, 0.001 * 2 * pi);
    for (std::size_t i = 0; i < segment_count(line); ++i) {
      const Point& a = line.vertices[i];
      const Point& b = segment_end(line, i);
      EXPECT_GT(std::hypot(a[0] + b[0], a[1] + b[1]) / 2, 1 - 0.001);
    }
  }
}

TEST(TrueLines, BordersAreLinesOfTheirOwnKindBetweenTheirOwnCorners) {
  const FeatureGraph plane = lines_of("plane");
  EXPECT_EQ(plane.corners.size(), 4U);
  ASSERT_EQ(plane.polylines.size(), 4U);
  for (const Polyline& line : plane.polylines) {
    EXPECT_TRUE(line.start_corner && line.end_corner && line.start_corner != line.end_corner);
    EXPECT_EQ(line.kind, LineKind::Border);
  }
  EXPECT_EQ(total_length(plane), 4);

  const FeatureGraph crease = lines_of("crease");
  EXPECT_EQ(crease.corners.size(), 6U) << "those of two squares; at two of them the crease ends";
  EXPECT_EQ(crease.polylines.size(), 7U);
  EXPECT_EQ(counts_of(crease).loose_ends, 0U);

  const FeatureGraph vase = lines_of("vase");
  EXPECT_TRUE(vase.corners.empty());
  EXPECT_EQ(counts_of(vase).loops, 2U);
}

TEST(TrueLines, APeakIsACornerWithoutLines) {
  const FeatureGraph cone = lines_of("cone");
  ASSERT_EQ(cone.corners.size(), 1U);
  ASSERT_EQ(cone.polylines.size(), 1U);
  EXPECT_TRUE(cone.polylines[0].closed);
  EXPECT_FALSE(cone.polylines[0].start_corner);
  EXPECT_EQ(cone.corners[0].position[0], 0);
}

TEST(TrueLines, EveryEndOfASolidLiesInACorner) {
  for (const char* const shape : {"box", "icosahedron", "trim-star", "fandisk", "through-hole"}) {
    for (const Polyline& line : lines_of(shape).polylines) {
      if (line.closed) continue;
      EXPECT_TRUE(line.start_corner && line.end_corner) << shape;
    }
  }
  EXPECT_EQ(lines_of("icosahedron").polylines.size(), 30U);
  EXPECT_TRUE(lines_of("sphere").polylines.empty());
}

}  // namespace
}  // namespace keenline
