#include "keenline/lines/trace_tensor_voting.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

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
                   const TraceTensorVotingOptions& options = {}) {
  FeatureGraph graph = trace_tensor_voting(cloud, NeighborSearch(cloud.positions), labels, spacing, options);
  validate(graph);
  return graph;
}

FeatureLabels labels_of(const PointCloud& cloud) {
  return detect_tensor_voting(cloud, NeighborSearch(cloud.positions));
}

TEST(TraceTensorVoting, ACubeHasEightCornersAndTwelveLines) {
  for (const double noise_h : {0.0, 0.05}) {
    const SynthCloud cube = shape("cube", 12000, noise_h);
    const GraphComparison found = compare_graphs(trace(cube.cloud, labels_of(cube.cloud), cube.spacing),
                                                 true_lines(cube), {.spacing = cube.spacing});
    EXPECT_EQ(found.found.corners, 8U) << noise_h;
    EXPECT_EQ(found.found.polylines, 12U) << noise_h;
    EXPECT_EQ(found.found.loose_ends, 0U) << noise_h;
    EXPECT_NEAR(found.length_ratio, 1, 0.05) << noise_h;
    EXPECT_LT(found.chamfer(), 0.4 * cube.spacing) << noise_h;
  }
}

TEST(TraceTensorVoting, ACylinderHasTwoLoops) {
  const SynthCloud cylinder = shape("cylinder");
  const GraphComparison found =
      compare_graphs(trace(cylinder.cloud, labels_of(cylinder.cloud), cylinder.spacing), true_lines(cylinder),
                     {.spacing = cylinder.spacing});
  EXPECT_EQ(found.found.loops, 2U);
  EXPECT_EQ(found.found.polylines, 2U);
  EXPECT_EQ(found.found.corners, 0U);
  EXPECT_NEAR(found.length_ratio, 1, 0.03);
  EXPECT_LT(found.chamfer(), 0.4 * cylinder.spacing);
}

TEST(TraceTensorVoting, ARidgeIsOneOpenCurve) {
  const SynthCloud crease = shape("crease", 4000);
  const FeatureGraph graph = trace(crease.cloud, labels_of(crease.cloud), crease.spacing);
  ASSERT_EQ(graph.polylines.size(), 1U);
  EXPECT_FALSE(graph.polylines[0].closed);
  EXPECT_GT(graph.polylines[0].support, 30U);
  EXPECT_TRUE(graph.corners.empty());
}

TEST(TraceTensorVoting, RefusesWhatItCannotUse) {
  const SynthCloud cube = shape("cube", 200);
  const FeatureLabels labels = labels_of(cube.cloud);
  const auto refuses = [&](const TraceTensorVotingOptions& options, const char* name) {
    test::expect_error<InvalidArgument>([&] { (void)trace(cube.cloud, labels, cube.spacing, options); },
                                        name);
  };
  refuses({.voting_scale = 0.5}, "voting_scale");
  refuses({.curvature_weight = -1}, "curvature_weight");
  refuses({.gap = 5}, "gap");
  refuses({.close_reach = std::numeric_limits<double>::quiet_NaN()}, "close_reach");
  refuses({.min_branch = -1}, "min_branch");
  test::expect_error<InvalidArgument>([&] { (void)trace(cube.cloud, {}, cube.spacing); }, "0 labels", "200");
}

}  // namespace
}  // namespace keenline
