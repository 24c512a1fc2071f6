#include "keenline/lines/snap.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <string>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/evaluate/compare_graphs.h"
#include "keenline/vectors.h"

#include "support/cancelled_progress.h"
#include "support/motion.h"
#include "support/rough_lines.h"

namespace keenline {
namespace {

using test::LineScene;
using test::roughened;
using test::shape_options;

FeatureGraph snapped(const LineScene& scene, const FeatureGraph& lines) {
  FeatureGraph result = snap_lines(lines, scene.synth.cloud, scene.search, scene.spacing);
  validate(result);
  return result;
}

GraphComparison compared(const LineScene& scene, const FeatureGraph& found) {
  return compare_graphs(found, scene.truth, {scene.spacing});
}

TEST(Snap, RoughLinesOfExactPlanesBecomeNearlyExact) {
  const LineScene scene(shape_options("cube", 6000));
  const FeatureGraph rough = roughened(scene.truth, scene.spacing);
  ASSERT_GT(compared(scene, rough).chamfer(), 0.1 * scene.spacing);
  const GraphComparison comparison = compared(scene, snapped(scene, rough));
  EXPECT_LT(comparison.hausdorff(), 0.02 * scene.spacing);
  EXPECT_LT(comparison.corners.largest, 0.02 * scene.spacing);
  EXPECT_EQ(comparison.found.polylines, 12U);
}

TEST(Snap, NoiseAndBentSidesLeaveATenthOfASpacing) {
  for (const char* const shape : {"cube", "cylinder", "cone", "icosahedron", "through-hole"}) {
    const LineScene scene(shape_options(shape, 5000, 0.05));
    const GraphComparison comparison = compared(scene, snapped(scene, roughened(scene.truth, scene.spacing)));
    EXPECT_LT(comparison.chamfer(), 0.1 * scene.spacing) << shape;
    EXPECT_NEAR(comparison.length_ratio, 1, 0.01) << shape;
    if (std::string(shape) != "cone") {  // the apex ends no line
      EXPECT_LT(comparison.corners.mean, 0.15 * scene.spacing) << shape;
    }
  }
}

TEST(Snap, RoundedEdgesYieldTheOnesThatWereDrawn) {
  // The radius is two spacings; what a tracer sees is inside the edge.
  const LineScene scene(shape_options("rounded-cube", 12000, 0.05));
  FeatureGraph rough = roughened(scene.truth, scene.spacing);
  const auto inward = [&](const Point& p) { return sum(p, scaled(-0.8 * scene.spacing, unit(p))); };
  for (GraphCorner& corner : rough.corners) corner.position = inward(corner.position);
  for (Polyline& line : rough.polylines)
    for (Point& p : line.vertices) p = inward(p);
  ASSERT_GT(compared(scene, rough).chamfer(), 0.6 * scene.spacing);
  const GraphComparison comparison = compared(scene, snapped(scene, rough));
  EXPECT_LT(comparison.hausdorff(), 0.3 * scene.spacing);
  EXPECT_LT(comparison.corners.largest, 0.3 * scene.spacing);
}

TEST(Snap, CornersAndTheEndsOfTheirLinesAreOnePlace) {
  const LineScene scene(shape_options("icosahedron", 6000, 0.05));
  const FeatureGraph graph = snapped(scene, roughened(scene.truth, scene.spacing));
  for (const Polyline& line : graph.polylines) {
    EXPECT_EQ(line.vertices.front(), graph.corners[*line.start_corner].position);
    EXPECT_EQ(line.vertices.back(), graph.corners[*line.end_corner].position);
  }
  for (const GraphCorner& corner : graph.corners) EXPECT_TRUE(corner.residual.has_value());
}

TEST(Snap, LinesRunForward) {
  const LineScene scene(shape_options("cube", 6000));
  for (const Polyline& line : snapped(scene, roughened(scene.truth, scene.spacing)).polylines) {
    const Point along = difference(line.vertices.back(), line.vertices.front());
    for (std::size_t i = 0; i + 1 < line.vertices.size(); ++i)
      EXPECT_GT(dot(difference(line.vertices[i + 1], line.vertices[i]), along), 0);
  }
}

TEST(Snap, EveryVertexIsDescribed) {
  const LineScene scene(shape_options("cube", 6000, 0.05));
  for (const Polyline& line : snapped(scene, roughened(scene.truth, scene.spacing)).polylines) {
    ASSERT_EQ(line.dihedral_deg.size(), line.vertices.size());
    ASSERT_EQ(line.normals.size(), line.vertices.size());
    ASSERT_EQ(line.residual.size(), line.vertices.size());
    const double mean = std::accumulate(line.residual.begin(), line.residual.end(), 0.0) /
                        static_cast<double>(line.residual.size());
    EXPECT_NEAR(mean, 0.05 * scene.spacing, 0.03 * scene.spacing);
  }
}

TEST(Snap, NothingMovesFartherThanItMay) {
  const LineScene scene(shape_options("cube", 6000));
  const double h = scene.spacing;
  const SnapOptions narrow{.largest_move = 0.2, .largest_corner_move = 0.4};
  const FeatureGraph rough = roughened(scene.truth, h);
  const FeatureGraph graph = snap_lines(rough, scene.synth.cloud, scene.search, h, narrow);
  validate(graph);
  for (std::size_t c = 0; c < graph.corners.size(); ++c)
    EXPECT_LE(distance(graph.corners[c].position, rough.corners[c].position), 0.4 * h);
  for (std::size_t l = 0; l < graph.polylines.size(); ++l) {
    for (std::size_t i = 1; i + 1 < graph.polylines[l].vertices.size(); ++i) {
      double nearest = 1;
      for (const Point& p : rough.polylines[l].vertices)
        nearest = std::min(nearest, distance(p, graph.polylines[l].vertices[i]));
      EXPECT_LE(nearest, 0.2 * h);
    }
  }
}

TEST(Snap, WhatHasNoSidesStays) {
  const LineScene scene(shape_options("sphere", 3000));
  FeatureGraph graph;
  graph.corners = {{{1, 0, 0}, {}}, {{0, 1, 0}, 0.25}};
  graph.polylines.push_back({.vertices = {{1, 0, 0}, {0.8, 0.6, 0}, {0, 0, 9}}, .start_corner = 0U});
  const FeatureGraph same = snapped(scene, graph);
  EXPECT_EQ(same.polylines[0].vertices, graph.polylines[0].vertices);
  EXPECT_EQ(same.corners[0].position, graph.corners[0].position);
  EXPECT_EQ(same.corners[1].residual, graph.corners[1].residual);
}

TEST(Snap, ACornerOfTwoSurfacesMovesAcrossThemOnly) {
  const LineScene scene(shape_options("crease", 4000));
  const double h = scene.spacing;
  FeatureGraph graph;
  graph.corners = {{{0.4 * h, 0.1, -h}, {}}};
  graph.polylines.push_back(
      {.vertices = {{0, -0.3, 0}, {0, -0.1, 0}, graph.corners[0].position}, .end_corner = 0U});
  const Point corner = snapped(scene, graph).corners[0].position;
  EXPECT_NEAR(distance(corner, {0, 0.1, 0}), 0, 1e-9);
}

TEST(Snap, BordersComeNearTheRim) {
  const LineScene scene(shape_options("plane", 6000));
  const FeatureGraph rough = roughened(scene.truth, scene.spacing);
  const GraphComparison comparison = compared(scene, snapped(scene, rough));
  EXPECT_LT(comparison.chamfer(), 0.4 * scene.spacing);
}

TEST(Snap, FollowsRigidMotionAndScale) {
  const LineScene scene(shape_options("through-hole", 2000, 0.05));
  const FeatureGraph rough = roughened(scene.truth, scene.spacing);
  const FeatureGraph graph = snapped(scene, rough);
  constexpr double scale = 0.125;
  const Point shift{4e6, -5e5, 300};
  const auto map = [&](const Point& p) { return sum(shift, scaled(scale, test::turned(p))); };
  const PointCloud cloud = test::moved(scene.synth.cloud, scale, shift);
  FeatureGraph elsewhere = rough;
  for (GraphCorner& corner : elsewhere.corners) corner.position = map(corner.position);
  for (Polyline& line : elsewhere.polylines)
    for (Point& p : line.vertices) p = map(p);
  const NeighborSearch search(cloud.positions);
  const FeatureGraph moved = snap_lines(elsewhere, cloud, search, scale * scene.spacing);
  ASSERT_EQ(moved.polylines.size(), graph.polylines.size());
  // Coordinates of 4e6 are rounded to 1e-9: a point may come to lie within a tolerance or not.
  double squares = 0;
  double count = 0;
  for (std::size_t c = 0; c < graph.corners.size(); ++c) {
    const double miss = distance(moved.corners[c].position, map(graph.corners[c].position));
    squares += miss * miss;
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.01 * scale * scene.spacing);
}

TEST(Snap, IsTheSameForAnyNumberOfThreads) {
  const LineScene scene(shape_options("through-hole", 2000, 0.05));
  const FeatureGraph rough = roughened(scene.truth, scene.spacing);
  const FeatureGraph first = snapped(scene, rough);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const FeatureGraph second = snapped(scene, rough);
  for (std::size_t l = 0; l < first.polylines.size(); ++l) {
    EXPECT_EQ(first.polylines[l].vertices, second.polylines[l].vertices);
    EXPECT_EQ(first.polylines[l].dihedral_deg, second.polylines[l].dihedral_deg);
  }
}

TEST(Snap, MayHaveNothingToDo) {
  const LineScene scene(shape_options("sphere", 500));
  EXPECT_TRUE(snapped(scene, {}).polylines.empty());
  const PointCloud none;
  const NeighborSearch search(none.positions);
  const FeatureGraph graph = snap_lines(scene.truth, none, search, 1);
  EXPECT_TRUE(graph.polylines.empty());
}

TEST(Snap, RefusesWhatIsOutOfRange) {
  const LineScene scene(shape_options("cube", 500));
  const auto snap = [&](double spacing, const SnapOptions& options) {
    (void)snap_lines(scene.truth, scene.synth.cloud, scene.search, spacing, options);
  };
  EXPECT_THROW(snap(0, {}), InvalidArgument);
  EXPECT_THROW(snap(1, {.largest_move = 0}), InvalidArgument);
  EXPECT_THROW(snap(1, {.largest_corner_move = -1}), InvalidArgument);
  EXPECT_THROW(snap(1, {.rounds = 0}), InvalidArgument);
  EXPECT_THROW(snap(1, {.sides = {.rim = 7}}), InvalidArgument);
  EXPECT_THROW(snap(1, {.sides = {.stretch = 0}}), InvalidArgument);
}

TEST(Snap, CanBeCancelled) {
  const LineScene scene(shape_options("cube", 500));
  test::CancelledProgress progress;
  EXPECT_THROW((void)snap_lines(scene.truth, scene.synth.cloud, scene.search, scene.spacing, {}, progress),
               Cancelled);
}

/// Cancels when all units of the stage are done.
class StoppedLate : public Progress {
 public:
  void begin(std::string_view /*stage*/, std::uint64_t total) override { left_ = total; }
  void advance(std::uint64_t units) override { left_ -= units; }
  [[nodiscard]] bool cancelled() const override { return left_ == 0; }

 private:
  std::atomic<std::uint64_t> left_{1};
};

TEST(Snap, CanBeCancelledWhileLinesMove) {
  const LineScene scene(shape_options("cube", 500));
  StoppedLate progress;
  SnapOptions options;
  options.rounds = 1;
  EXPECT_THROW(
      (void)snap_lines(scene.truth, scene.synth.cloud, scene.search, scene.spacing, options, progress),
      Cancelled);
}

}  // namespace
}  // namespace keenline
