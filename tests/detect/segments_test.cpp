#include "keenline/detect/segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"
#include "keenline/vectors.h"

#include "support/motion.h"

namespace keenline {
namespace {

SynthCloud shape(const std::string& name, std::uint64_t points = 12000, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

Segments segments_of(const PointCloud& cloud, const SegmentOptions& options = {}) {
  return segment_by_normals(cloud.positions, NeighborSearch(cloud.positions), options);
}

/// Segments of at least so many points.
std::size_t large(const Segments& segments, std::size_t size) {
  std::vector<std::size_t> sizes(segments.interior.size());
  for (const std::uint32_t s : segments.segment) ++sizes[s];
  return static_cast<std::size_t>(
      std::count_if(sizes.begin(), sizes.end(), [&](std::size_t s) { return s >= size; }));
}

TEST(Segments, ANormalIsTheAxisOfLeastVariance) {
  const std::vector<Point> positions{{0, 0, 0}, {1, 0, 0.001}, {0, 1, -0.001}, {-1, 0, 0.001}, {0, -2, 0}};
  LocalOffsets workspace;
  const std::vector<std::uint32_t> neighbors{1, 2, 3, 4};
  const Point normal = plane_normal(positions, 0, neighbors, workspace);
  EXPECT_NEAR(std::abs(normal[2]), 1, 1e-5);
  EXPECT_NEAR(length(normal), 1, 1e-14);
  EXPECT_EQ(plane_normal(positions, 0, std::span(neighbors).first(2), workspace), (Point{0, 0, 0}));
  const std::vector<Point> row{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_EQ(plane_normal(row, 0, std::vector<std::uint32_t>{1, 2, 3}, workspace), (Point{0, 0, 0}));
}

TEST(Segments, AreTheFacesOfAShape) {
  struct Case {
    const char* name;
    double noise_h;
    double angle_deg;
    std::size_t faces;
  };
  for (const Case& c :
       {Case{"cube", 0, 5, 6}, Case{"cube", 0.05, 5, 6}, Case{"cylinder", 0, 5, 3},
        Case{"icosahedron", 0, 5, 20}, Case{"icosahedron", 0, 4, 20}, Case{"sphere", 0, 5, 1}}) {
    SegmentOptions options;
    options.angle_deg = c.angle_deg;
    EXPECT_EQ(large(segments_of(shape(c.name, 12000, c.noise_h).cloud, options), 60), c.faces)
        << c.name << ' ' << c.noise_h << ' ' << c.angle_deg;
  }
}

TEST(Segments, LeakOverObtuseEdgesWhenTheAngleIsTooLarge) {
  SegmentOptions options;
  options.angle_deg = 10;
  const Segments segments = segments_of(shape("icosahedron").cloud, options);
  EXPECT_GT(*std::max_element(segments.interior.begin(), segments.interior.end()), 4000U)
      << "nearly half of all points, where a face has a twentieth";
}

TEST(Segments, TheirNeighborsAreWithinTheAngle) {
  const PointCloud cloud = shape("fandisk", 3000).cloud;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 10);
  const Segments segments = segments_of(cloud, {.angle_deg = 5});
  std::vector<std::size_t> interior(segments.interior.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    double bend = 0;
    bool alone = true;
    bool inside = true;
    for (const std::uint32_t j : neighborhoods.of(i).first(8)) {
      const double cosine = std::min(1.0, std::abs(dot(segments.normals[i], segments.normals[j])));
      const double angle = std::acos(cosine) * 180 / std::numbers::pi;
      bend = std::max(bend, angle);
      alone = alone && (segments.segment[j] != segments.segment[i] || angle > 5);
      inside = inside && segments.segment[j] == segments.segment[i];
    }
    EXPECT_NEAR(segments.bend_deg[i], bend, 2e-6 * 180);
    interior[segments.segment[i]] += inside ? 1U : 0U;
  }
  EXPECT_TRUE(std::equal(interior.begin(), interior.end(), segments.interior.begin()));
}

TEST(Segments, TwoPlanesThatAFewDegreesSeparateAreOneOnlyAboveThatAngle) {
  // Two half planes of a lattice meet under 7 degrees; no normal lies between those of the planes but at x =
  // 0.
  PointCloud cloud;
  const double tilt = std::tan(7 * std::numbers::pi / 180);
  for (int x = -10; x <= 10; ++x)
    for (int y = 0; y < 20; ++y) cloud.positions.push_back({1.0 * x, 1.0 * y, x > 0 ? x * tilt : 0.0});
  SegmentOptions options;
  options.normal_neighbors = 8;
  options.angle_deg = 1;
  EXPECT_EQ(large(segments_of(cloud, options), 100), 2U);
  options.angle_deg = 8;
  EXPECT_EQ(large(segments_of(cloud, options), 400), 1U);
}

TEST(Segments, TheAngleFollowsTheTurnOfMostNormals) {
  EXPECT_EQ(segments_of(shape("cube").cloud).angle_deg, 5);
  EXPECT_EQ(segments_of(shape("cube", 3000, 0.3).cloud).angle_deg, 10);
  const Segments noisy = segments_of(shape("cube", 3000, 0.03).cloud);
  std::vector<float> bends = noisy.bend_deg;
  std::sort(bends.begin(), bends.end());
  EXPECT_GT(noisy.angle_deg, 5);
  EXPECT_LT(noisy.angle_deg, 10);
  EXPECT_NEAR(noisy.angle_deg, 3.0 * static_cast<double>(bends[1500]), 1e-5);
  EXPECT_EQ(segments_of({}).angle_deg, 5);
}

TEST(Segments, APointWithoutNormalIsAlone) {
  PointCloud cloud;
  for (int i = 0; i < 40; ++i) cloud.positions.push_back({1.0 * i, 0, 0});
  const Segments segments = segments_of(cloud);
  EXPECT_EQ(segments.interior, std::vector<std::uint32_t>(40, 0));
  EXPECT_EQ(std::set<std::uint32_t>(segments.segment.begin(), segments.segment.end()).size(), 40U);
  EXPECT_EQ(segments_of({}).interior.size(), 0U);
}

TEST(Segments, DoNotDependOnPlaceScaleOrThreads) {
  const PointCloud cloud = shape("fandisk", 3000).cloud;
  const Segments expected = segments_of(cloud);
  EXPECT_EQ(segments_of(test::moved(cloud, 1e-100, {0, 0, 0})).segment.size(), expected.segment.size());
  EXPECT_EQ(large(segments_of(test::moved(cloud, 3, {1e6, -1e6, 5})), 30), large(expected, 30));
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const Segments alone = segments_of(cloud);
  EXPECT_EQ(alone.segment, expected.segment);
  EXPECT_EQ(alone.normals, expected.normals);
}

}  // namespace
}  // namespace keenline
