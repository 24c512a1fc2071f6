#include "keenline/detect/point_labeler.h"

#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

namespace keenline {
namespace {

/// Points of a right angle along the x axis: eight on each face, and the middle of the edge first.
PointCloud right_angle() {
  PointCloud cloud;
  cloud.positions = {{0, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
  for (const double along : {-1.5, -0.5, 0.5, 1.5}) {
    for (const double out : {0.8, 1.7}) {
      cloud.positions.push_back({along, out, 0});
      cloud.positions.push_back({along, 0, out});
    }
  }
  return cloud;
}

std::vector<std::uint32_t> all_others(const PointCloud& cloud) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t i = 1; i < cloud.size(); ++i) others.push_back(i);
  return others;
}

Kind kind_at(const PointLabeler& labeler, double sigma_deg) {
  Kind kind = Kind::Undecided;
  for (const LabelStep& step : labeler.steps())
    if (step.from <= sigma_deg * kernels::angle_units_per_degree) kind = step.kind;
  return kind;
}

TEST(PointLabeler, SeesAnEdgeAlongItsCrease) {
  const PointCloud cloud = right_angle();
  GaussOptions options;
  PointLabeler labeler(cloud, options, no_progress());
  labeler.label(0, all_others(cloud));
  EXPECT_EQ(kind_at(labeler, 20), Kind::Edge);
  EXPECT_TRUE(labeler.ever_needs_support());
  EXPECT_EQ(labeler.min_cluster(), 12);  // a tenth of 18 * 17 / 2, less the rows of points through the middle
  EXPECT_GT(labeler.score(), 45.0F);
  EXPECT_EQ(std::abs(labeler.direction().x), 127);
  EXPECT_EQ(labeler.direction().y, 0);
  EXPECT_EQ(labeler.direction().z, 0);
}

TEST(PointLabeler, StepsRiseAndDiffer) {
  SynthOptions synth;
  synth.shape = "fandisk";
  synth.points = 1500;
  synth.noise.amount = 0.1;
  const PointCloud cloud = synthesize(synth).cloud;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 23);
  for (const int scales : {1, 2}) {
    GaussOptions options;
    options.scales = scales;
    PointLabeler labeler(cloud, options, no_progress());
    std::size_t steps = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      labeler.label(i, neighborhoods.of(i));
      ASSERT_FALSE(labeler.steps().empty());
      EXPECT_EQ(labeler.steps()[0].from, 0);
      for (std::size_t s = 1; s < labeler.steps().size(); ++s) {
        const LabelStep& before = labeler.steps()[s - 1];
        const LabelStep& step = labeler.steps()[s];
        EXPECT_LT(before.from, step.from);
        EXPECT_TRUE(before.kind != step.kind || before.clusters != step.clusters);
      }
      steps += labeler.steps().size();
    }
    EXPECT_GT(steps, cloud.size());
  }
}

TEST(PointLabeler, WithTooFewNeighboursNothingIsDecided) {
  const PointCloud cloud = right_angle();
  const std::vector<std::uint32_t> others = all_others(cloud);
  GaussOptions options;
  PointLabeler labeler(cloud, options, no_progress());
  labeler.label(0, others);
  labeler.label(0, std::span(others).first(15));
  ASSERT_EQ(labeler.steps().size(), 1U);
  EXPECT_EQ(labeler.steps()[0].kind, Kind::Undecided);
  EXPECT_EQ(labeler.score(), 0.0F);
  EXPECT_FALSE(labeler.ever_needs_support());
  const CreaseDirection none = labeler.direction();
  EXPECT_EQ(std::abs(none.x) + std::abs(none.y) + std::abs(none.z), 0);
}

TEST(PointLabeler, ClustersTheMapOnRequest) {
  PointCloud cloud;
  for (int x = 0; x < 5; ++x)
    for (int y = 0; y < 5; ++y) cloud.positions.push_back({x + 0.0, y + 0.1 * x, 0});
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);
  GaussOptions options;
  PointLabeler labeler(cloud, options, no_progress());
  labeler.label(12, neighborhoods.of(12));  // flat: known without clustering
  EXPECT_EQ(kind_at(labeler, 20), Kind::Flat);
  const GaussMap& map = labeler.clustered_map();
  EXPECT_EQ(map.merges().size() + 1, static_cast<std::size_t>(map.lines().count));
}

}  // namespace
}  // namespace keenline
