#include "keenline/evaluate/compare_graphs.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/synth/true_lines.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One straight line between two corners.
FeatureGraph segment(const Point& a, const Point& b) {
  FeatureGraph graph;
  graph.corners = {{a, {}}, {b, {}}};
  graph.polylines = {{.vertices = {a, b}, .start_corner = 0, .end_corner = 1}};
  return graph;
}

FeatureGraph synth_lines(const char* shape) {
  SynthOptions options;
  options.shape = shape;
  options.points = 500;
  return true_lines(synthesize(options));
}

TEST(CompareGraphs, AGraphIsItself) {
  const FeatureGraph graph = synth_lines("fandisk");
  const GraphComparison result = compare_graphs(graph, graph, {.spacing = 0.1});
  EXPECT_EQ(result.length_ratio, 1);
  EXPECT_NEAR(result.hausdorff(), 0, 1e-15);
  EXPECT_NEAR(result.chamfer(), 0, 1e-16);
  EXPECT_EQ(result.corners.largest, 0);
  EXPECT_EQ(result.missed_corners + result.invented_corners, 0U);
}

TEST(CompareGraphs, CountsWhatIsThere) {
  FeatureGraph graph = synth_lines("through-hole");
  graph.polylines[0].start_corner.reset();
  const GraphCounts counts = compare_graphs(graph, graph).found;
  EXPECT_EQ(counts.corners, 8U);
  EXPECT_EQ(counts.polylines, 14U);
  EXPECT_EQ(counts.loops, 2U);
  EXPECT_EQ(counts.loose_ends, 1U);
  EXPECT_NEAR(counts.length, 8 * 2 + 4 * 1 + 2 * std::acos(-1), 0.01);
}

TEST(CompareGraphs, ParallelLinesAreEquallyFarBothWays) {
  const GraphComparison result =
      compare_graphs(segment({0, 3, 4}, {10, 3, 4}), segment({0, 0, 0}, {10, 0, 0}), {.spacing = 1});
  EXPECT_NEAR(result.found_to_truth.mean, 5, 1e-14);
  EXPECT_NEAR(result.truth_to_found.mean, 5, 1e-14);
  EXPECT_EQ(result.hausdorff(), 5);
  EXPECT_EQ(result.corners.mean, 5);
  EXPECT_EQ(result.missed_corners, 2U);
  EXPECT_EQ(result.invented_corners, 2U);
  EXPECT_EQ(result.diagonal, 10);
}

TEST(CompareGraphs, WhatIsMissedShowsInOneDirectionOnly) {
  // Of a line from 0 to 10 only 0 to 4 was found: the mean over the rest is 3, over all 6/10 of that.
  const GraphComparison result =
      compare_graphs(segment({0, 0, 0}, {4, 0, 0}), segment({0, 0, 0}, {10, 0, 0}), {.spacing = 0.1});
  EXPECT_LT(result.found_to_truth.largest, 1e-14);
  EXPECT_LT(result.found_to_truth.mean, 1e-14);
  EXPECT_NEAR(result.truth_to_found.mean, 1.8, 1e-12);
  EXPECT_EQ(result.truth_to_found.largest, 6);
  EXPECT_EQ(result.length_ratio, 0.4);
  EXPECT_EQ(result.missed_corners, 1U);
  EXPECT_EQ(result.invented_corners, 1U);
}

TEST(CompareGraphs, TheLargestDistanceIsThatOfAVertexBetweenSamples) {
  FeatureGraph found = segment({0, 0, 0}, {10, 0, 0});
  found.polylines[0].vertices.insert(found.polylines[0].vertices.begin() + 1, {5, 2, 0});
  const GraphComparison result =
      compare_graphs(found, segment({0, 0, 0}, {10, 0, 0}), {.spacing = 20});  // samples far apart
  EXPECT_EQ(result.found_to_truth.largest, 2);
}

TEST(CompareGraphs, HowALineIsDividedDoesNotMatter) {
  FeatureGraph fine = segment({0, 1, 0}, {10, 1, 0});
  fine.polylines[0].vertices = {{0, 1, 0}, {0.1, 1, 0}, {0.1, 1, 0}, {7, 1, 0}, {10, 1, 0}};
  const FeatureGraph truth = segment({0, 0, 0}, {5, 0, 0});
  const GraphComparison coarse = compare_graphs(segment({0, 1, 0}, {10, 1, 0}), truth, {.spacing = 0.5});
  const GraphComparison result = compare_graphs(fine, truth, {.spacing = 0.5});
  EXPECT_NEAR(result.found_to_truth.mean, coarse.found_to_truth.mean, 1e-12);
  EXPECT_EQ(result.found_to_truth.largest, coarse.found_to_truth.largest);
}

TEST(CompareGraphs, NothingIsInfinitelyFarFromSomething) {
  const FeatureGraph line = segment({0, 0, 0}, {1, 0, 0});
  const GraphComparison missed = compare_graphs({}, line);
  EXPECT_EQ(missed.truth_to_found.mean, infinity);
  EXPECT_EQ(missed.hausdorff(), infinity);
  EXPECT_EQ(missed.found_to_truth.mean, 0);
  EXPECT_EQ(missed.length_ratio, 0);
  EXPECT_EQ(missed.missed_corners, 2U);
  const GraphComparison invented = compare_graphs(line, {});
  EXPECT_EQ(invented.found_to_truth.mean, infinity);
  EXPECT_EQ(invented.length_ratio, infinity);
  EXPECT_EQ(invented.invented_corners, 2U);
  const GraphComparison nothing = compare_graphs({}, {});
  EXPECT_EQ(nothing.length_ratio, 1);
  EXPECT_EQ(nothing.hausdorff(), 0);
}

TEST(CompareGraphs, LinesWithoutLengthAreMeasuredAtTheirVertices) {
  const FeatureGraph point = segment({0, 2, 0}, {0, 2, 0});
  const GraphComparison result = compare_graphs(point, segment({0, 0, 0}, {1, 0, 0}), {.spacing = 1});
  EXPECT_EQ(result.found_to_truth.mean, 2);
  EXPECT_EQ(result.found_to_truth.largest, 2);
}

TEST(CompareGraphs, ScaleAndThreadsChangeNothing) {
  const FeatureGraph truth = synth_lines("trim-star");
  const FeatureGraph found = synth_lines("cube");
  const GraphComparison result = compare_graphs(found, truth, {.spacing = 0.01});
  const auto doubled = [](FeatureGraph graph) {  // by a power of two: exactly
    for (GraphCorner& corner : graph.corners)
      for (double& x : corner.position) x *= 1024;
    for (Polyline& line : graph.polylines)
      for (Point& p : line.vertices)
        for (double& x : p) x *= 1024;
    return graph;
  };
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const GraphComparison scaled = compare_graphs(doubled(found), doubled(truth), {.spacing = 1024 * 0.01});
  EXPECT_EQ(scaled.found_to_truth.mean, 1024 * result.found_to_truth.mean);
  EXPECT_EQ(scaled.truth_to_found.largest, 1024 * result.truth_to_found.largest);
  EXPECT_EQ(scaled.corners.mean, 1024 * result.corners.mean);
  EXPECT_EQ(scaled.missed_corners, result.missed_corners);
}

TEST(CompareGraphs, ATinySpacingTakesNoMoreThanTheLimit) {
  const FeatureGraph line = segment({0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(compare_graphs(line, line, {.spacing = 1e-300}).hausdorff(), 0);
}

TEST(CompareGraphs, RefusesASpacingThatIsNone) {
  for (const double spacing : {0.0, -1.0, infinity, std::nan("")})
    test::expect_error<InvalidArgument>([&] { (void)compare_graphs({}, {}, {.spacing = spacing}); },
                                        "spacing must be");
}

}  // namespace
}  // namespace keenline
