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

/// Follows the rim from the first foot there is until it ends, as walks do: over two steps without a foot.
std::optional<Foot> last_foot(const RimTracker& tracker, const Point& direction) {
  std::optional<Foot> foot;
  for (std::uint32_t i = 0; !foot && i < tracker.size(); ++i) foot = tracker.find(i);
  if (!foot) return foot;
  if (dot(foot->tangent, direction) < 0) foot->tangent = scaled(-1, foot->tangent);
  for (int missed = 0; missed <= 2;) {
    const double way = (1 + missed) * foot->scale;
    const auto next = tracker.follow(*foot, sum(foot->position, scaled(way, foot->tangent)));
    const bool goes_on = next && dot(next->tangent, foot->tangent) > 0.82 &&
                         dot(difference(next->position, foot->position), foot->tangent) > 0.3 * foot->scale;
    missed = goes_on ? 0 : missed + 1;
    if (goes_on) foot = next;
  }
  return foot;
}

TEST(Rim, GoesOnWhereLabelsAreMissingUpToTheCorner) {
  auto shape = labelled_shape("plane", 4000, 0.05);
  const auto& positions = shape.synth.cloud.positions;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!(positions[i][1] < -0.4 && std::abs(positions[i][0]) < 0.1)) shape.labels.kind[i] = Kind::Flat;
  const NeighborSearch search(positions);
  const TraceFrame frame{{0, 0, 0}, shape.spacing};
  const RimTracker tracker(shape.synth.cloud, search, shape.labels, frame, no_progress());
  for (const double way : {-1.0, 1.0}) {
    const auto foot = last_foot(tracker, {way, 0, 0});
    ASSERT_TRUE(foot);
    const Point end = frame.global(foot->position);
    EXPECT_NEAR(end[0], 0.5 * way, 4 * shape.spacing);
    EXPECT_NEAR(end[1], -0.5, 0.8 * shape.spacing);
    EXPECT_LT(foot->normals[1][1], -0.8) << "out of the surface";
  }
}

TEST(Rim, EndsWhereTheSurfaceGoesOn) {
  // An L: the rim of its short leg ends in the middle of the surface.
  const SynthCloud plane = test::labelled_shape("plane", 4000).synth;
  PointCloud cloud;
  FeatureLabels labels;
  for (const Point& p : plane.cloud.positions) {
    if (p[0] < 0 && p[1] < 0) continue;
    cloud.positions.push_back(p);
    labels.kind.push_back(p[0] < -0.2 && p[1] < plane.spacing ? Kind::Border : Kind::Flat);
  }
  const NeighborSearch search(cloud.positions);
  const TraceFrame frame{{0, 0, 0}, plane.spacing};
  const RimTracker tracker(cloud, search, labels, frame, no_progress());
  const auto foot = last_foot(tracker, {1, 0, 0});
  ASSERT_TRUE(foot);
  EXPECT_NEAR(frame.global(foot->position)[0], 0, 4 * plane.spacing);
}

TEST(Rim, IsFoundAroundSmallHoles) {
  const auto shape = labelled_shape("plane", 4000);
  const double radius = 5 * shape.spacing;
  PointCloud cloud;
  FeatureLabels labels;
  for (const Point& p : shape.synth.cloud.positions) {
    const double r = std::hypot(p[0], p[1]);
    if (r < radius) continue;
    cloud.positions.push_back(p);
    labels.kind.push_back(r < radius + shape.spacing ? Kind::Border : Kind::Flat);
  }
  const NeighborSearch search(cloud.positions);
  const TraceFrame frame{{0, 0, 0}, shape.spacing};
  const RimTracker tracker(cloud, search, labels, frame, no_progress());
  int found = 0;
  for (std::uint32_t i = 0; i < tracker.size(); ++i) {
    const auto foot = tracker.find(i);
    if (!foot) continue;
    ++found;
    EXPECT_NEAR(length(foot->position), radius / shape.spacing, 1);
  }
  EXPECT_GT(found, 3 * static_cast<int>(tracker.size()) / 4);
}

}  // namespace
}  // namespace keenline
