#include "keenline/lines/rim_tracker.h"

#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "support/traced_shapes.h"

namespace keenline {
namespace {

using test::labelled_shape;

TEST(Rim, LiesAlongTheSidesOfASquare) {
  const auto shape = labelled_shape("plane", 4000, 0.05);
  const NeighborSearch search(shape.synth.cloud.positions);
  const TraceFrame frame{{0, 0, 0}, shape.spacing};
  const RimTracker tracker(shape.synth.cloud, search, shape.labels, frame, no_progress());
  int found = 0;
  ASSERT_GT(tracker.size(), 80U);
  for (std::uint32_t i = 0; i < tracker.size(); ++i) {
    const auto foot = tracker.find(i);
    if (!foot) continue;
    const Point p = frame.global(foot->position);
    const double from_middle = std::max(std::abs(p[0]), std::abs(p[1]));
    EXPECT_LT(std::abs(p[2]), 0.2 * shape.spacing);
    EXPECT_NEAR(length(foot->tangent), 1, 1e-12);
    EXPECT_NEAR(dot(foot->normals[0], foot->tangent), 0, 1e-12);
    EXPECT_NEAR(dot(foot->normals[1], foot->tangent), 0, 1e-12);
    EXPECT_GT(std::abs(foot->normals[0][2]), 0.9);
    if (std::min(std::abs(p[0]), std::abs(p[1])) > 0.5 - 5 * shape.spacing) continue;  // a corner
    ++found;
    EXPECT_NEAR(from_middle, 0.5, 0.6 * shape.spacing);
    EXPECT_GT(std::max(std::abs(foot->tangent[0]), std::abs(foot->tangent[1])), 0.8);
  }
  EXPECT_GT(found, 60);
}

TEST(Rim, EndsWhereBorderPointsEnd) {
  SynthOptions options;
  options.shape = "plane";
  options.points = 4000;
  options.feature_band = 1;  // a border point every spacing
  const auto shape = labelled_shape(options);
  FeatureLabels labels = shape.labels;
  const auto& positions = shape.synth.cloud.positions;
  for (std::size_t i = 0; i < labels.size(); ++i)
    if (labels.kind[i] == Kind::Border && !(positions[i][1] < -0.4 && std::abs(positions[i][0]) < 0.2))
      labels.kind[i] = Kind::Flat;
  const NeighborSearch search(positions);
  const TraceFrame frame{{0, 0, 0}, shape.spacing};
  const RimTracker tracker(shape.synth.cloud, search, labels, frame, no_progress());
  std::optional<Foot> foot;
  for (std::uint32_t i = 0; !foot && i < tracker.size(); ++i) foot = tracker.find(i);
  ASSERT_TRUE(foot);
  for (int step = 0; step < 100; ++step) {
    const auto next = tracker.follow(*foot, sum(foot->position, scaled(foot->scale, foot->tangent)));
    if (!next) break;
    foot = next;
  }
  EXPECT_NEAR(std::abs(frame.global(foot->position)[0]), 0.2, 2.5 * shape.spacing);
}

}  // namespace
}  // namespace keenline
