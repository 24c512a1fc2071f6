#include "keenline/lines/trace_demarsin.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/detect/demarsin.h"
#include "keenline/detect/tensor_voting.h"
#include "keenline/errors.h"
#include "keenline/evaluate/compare_graphs.h"
#include "keenline/synth/synth.h"
#include "keenline/synth/true_lines.h"

#include "support/expect_error.h"
#include "support/motion.h"
#include "support/sample_graph.h"

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

TEST(TraceDemarsin, ACylinderHasTwoLoopsAndASphereNothing) {
  const SynthCloud cylinder = shape("cylinder");
  const GraphComparison found =
      compare_graphs(trace(cylinder.cloud, labels_of(cylinder.cloud), cylinder.spacing), true_lines(cylinder),
                     {.spacing = cylinder.spacing});
  EXPECT_EQ(found.found.loops, 2U);
  EXPECT_EQ(found.found.polylines, 2U);
  EXPECT_EQ(found.found.corners, 0U);
  EXPECT_NEAR(found.length_ratio, 1, 0.05);
  const SynthCloud sphere = shape("sphere", 6000);
  EXPECT_TRUE(trace(sphere.cloud, labels_of(sphere.cloud), sphere.spacing).polylines.empty());
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

TEST(TraceDemarsin, DrawsTheSameWhereverTheCloudLies) {
  const SynthCloud cube = shape("cube", 6000);
  const FeatureLabels labels = labels_of(cube.cloud);
  const FeatureGraph here = trace(cube.cloud, labels, cube.spacing);
  const PointCloud moved = test::moved(cube.cloud, 100, {4e6, 5e6, 100});
  const FeatureGraph there = trace(moved, labels, 100 * cube.spacing);
  ASSERT_EQ(there.polylines.size(), here.polylines.size());
  double length_here = 0;
  double length_there = 0;
  for (std::size_t i = 0; i < here.polylines.size(); ++i) {
    length_here += length_of(here.polylines[i]);
    length_there += length_of(there.polylines[i]);
  }
  EXPECT_NEAR(length_there, 100 * length_here, 0.5);
}

TEST(TraceDemarsin, ThreadsChangeNothing) {
  const SynthCloud star = shape("trim-star", 8000);
  const FeatureLabels labels = labels_of(star.cloud);
  const FeatureGraph expected = trace(star.cloud, labels, star.spacing);
  ASSERT_FALSE(expected.polylines.empty());
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const FeatureGraph alone = trace(star.cloud, labels, star.spacing);
  ASSERT_EQ(alone.polylines.size(), expected.polylines.size());
  for (std::size_t i = 0; i < alone.polylines.size(); ++i)
    EXPECT_EQ(alone.polylines[i].vertices, expected.polylines[i].vertices);
}

TEST(TraceDemarsin, DegenerateInputIsAnswered) {
  EXPECT_TRUE(trace({}, {}, 1).polylines.empty());
  PointCloud cloud;
  FeatureLabels labels;
  for (int i = 0; i < 40; ++i) {
    cloud.positions.push_back({1, 2, 3});
    labels.kind.push_back(Kind::Edge);
  }
  EXPECT_TRUE(trace(cloud, labels, 1).polylines.empty());
  EXPECT_TRUE(trace(cloud, labels, 0).polylines.empty());
  cloud.positions[0] = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
  cloud.positions[1] = {1e300, 0, 0};
  EXPECT_TRUE(trace(cloud, labels, 1).polylines.empty());
  labels.kind.assign(40, Kind::Flat);
  EXPECT_TRUE(trace(cloud, labels, 1).polylines.empty());
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
  test::CancelledProgress progress;
  EXPECT_THROW((void)trace_demarsin(cube.cloud, NeighborSearch(cube.cloud.positions), labels, cube.spacing,
                                    {}, progress),
               Cancelled);
}

}  // namespace
}  // namespace keenline
