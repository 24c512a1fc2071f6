#include "keenline/lines/trace_demarsin.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/detect/demarsin.h"
#include "keenline/detect/tensor_voting.h"
#include "keenline/errors.h"
#include "keenline/evaluate/compare_graphs.h"
#include "keenline/synth/synth.h"
#include "keenline/synth/true_lines.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

SynthCloud shape(const std::string& name, std::uint64_t points = 12000, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

FeatureGraph trace(const PointCloud& cloud, const FeatureLabels& labels, double spacing,
                   const TraceDemarsinOptions& options = {}) {
  FeatureGraph graph = trace_demarsin(cloud, NeighborSearch(cloud.positions), labels, spacing, options);
  validate(graph);
  return graph;
}

FeatureLabels labels_of(const PointCloud& cloud) {
  return detect_demarsin(cloud, NeighborSearch(cloud.positions));
}

TEST(TraceDemarsin, ACubeHasEightCornersAndTwelveLines) {
  for (const double noise_h : {0.0, 0.05}) {
    const SynthCloud cube = shape("cube", 12000, noise_h);
    const NeighborSearch search(cube.cloud.positions);
    const std::vector<FeatureLabels> all{detect_demarsin(cube.cloud, search),
                                         detect_tensor_voting(cube.cloud, search)};
    for (const FeatureLabels& labels : all) {
      const GraphComparison found = compare_graphs(trace(cube.cloud, labels, cube.spacing), true_lines(cube),
                                                   {.spacing = cube.spacing});
      EXPECT_EQ(found.found.corners, 8U) << noise_h;
      EXPECT_EQ(found.found.polylines, 12U) << noise_h;
      EXPECT_EQ(found.found.loose_ends, 0U) << noise_h;
      EXPECT_NEAR(found.length_ratio, 1, 0.1) << noise_h;
      EXPECT_LT(found.chamfer(), 0.7 * cube.spacing) << noise_h;
    }
  }
}

TEST(TraceDemarsin, ACylinderHasTwoLoops) {
  const SynthCloud cylinder = shape("cylinder");
  const GraphComparison found =
      compare_graphs(trace(cylinder.cloud, labels_of(cylinder.cloud), cylinder.spacing), true_lines(cylinder),
                     {.spacing = cylinder.spacing});
  EXPECT_EQ(found.found.loops, 2U);
  EXPECT_EQ(found.found.polylines, 2U);
  EXPECT_EQ(found.found.corners, 0U);
  EXPECT_NEAR(found.length_ratio, 1, 0.05);
}

TEST(TraceDemarsin, WhatFadesOutIsKeptOnRequest) {
  // The ridge of a crease runs from border to border: it has no loop.
  const SynthCloud crease = shape("crease", 4000);
  const FeatureLabels labels = labels_of(crease.cloud);
  EXPECT_TRUE(trace(crease.cloud, labels, crease.spacing).polylines.empty());
  TraceDemarsinOptions options;
  options.closed_only = false;
  const FeatureGraph open = trace(crease.cloud, labels, crease.spacing, options);
  ASSERT_EQ(open.polylines.size(), 1U);
  EXPECT_FALSE(open.polylines[0].closed);
  EXPECT_GT(open.polylines[0].support, 30U);
}

TEST(TraceDemarsin, RefusesWhatItCannotUse) {
  const SynthCloud cube = shape("cube", 200);
  const FeatureLabels labels = labels_of(cube.cloud);
  const auto refuses = [&](const TraceDemarsinOptions& options, const char* name) {
    test::expect_error<InvalidArgument>([&] { (void)trace(cube.cloud, labels, cube.spacing, options); },
                                        name);
  };
  refuses({.extra_reach = -1}, "extra_reach");
  refuses({.close_reach = std::numeric_limits<double>::quiet_NaN()}, "close_reach");
  refuses({.close_ratio = 0.5}, "close_ratio");
  refuses({.min_branch = -1}, "min_branch");
  refuses({.smooth_rounds = 1001}, "smooth_rounds");
  test::expect_error<InvalidArgument>([&] { (void)trace(cube.cloud, {}, cube.spacing); }, "0 labels", "200");
}

}  // namespace
}  // namespace keenline
