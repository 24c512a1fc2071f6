#include "keenline/detect/demarsin.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"
#include "support/motion.h"

namespace keenline {
namespace {

using test::expect_error;

SynthCloud shape(const std::string& name, std::uint64_t points = 12000, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

FeatureLabels detect(const PointCloud& cloud, const DemarsinOptions& options = {}) {
  return detect_demarsin(cloud, NeighborSearch(cloud.positions), options);
}

DemarsinOptions at_angle(double segment_angle_deg) {
  DemarsinOptions options;
  options.segment_angle_deg = segment_angle_deg;
  return options;
}

std::size_t count(const FeatureLabels& labels, Kind kind) {
  return static_cast<std::size_t>(std::count(labels.kind.begin(), labels.kind.end(), kind));
}

/// Share of the points so far from the nearest sharp feature, in spacings, that are sharp.
double share_found(const SynthCloud& synth, const FeatureLabels& labels, double from, double to) {
  const Column& distance = *synth.cloud.attribute("truth_distance");
  double all = 0;
  double found = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double d = distance.value(i) / synth.spacing;
    if (d < from || d >= to) continue;
    ++all;
    found += is_feature(labels.kind[i]) ? 1 : 0;
  }
  return found / all;
}

TEST(Demarsin, FindsWhatThePrototypeFinds) {
  // Shares of the points within half a spacing of an edge, and beyond three, at 5 degrees.
  struct Case {
    const char* name;
    double noise_h, angle_deg, near, far;
  };
  for (const Case& c :
       {Case{"cube", 0, 5, 0.98, 0}, Case{"cube", 0.05, 5, 0.97, 0}, Case{"cylinder", 0, 5, 0.99, 0.0003},
        Case{"icosahedron", 0, 5, 0.88, 0}, Case{"icosahedron", 0, 4, 0.93, 0}}) {
    const SynthCloud synth = shape(c.name, 12000, c.noise_h);
    const FeatureLabels labels = detect(synth.cloud, at_angle(c.angle_deg));
    EXPECT_NEAR(share_found(synth, labels, 0, 0.5), c.near, 0.04) << c.name << ' ' << c.angle_deg;
    EXPECT_NEAR(share_found(synth, labels, 3, 1e9), c.far, 0.003) << c.name << ' ' << c.angle_deg;
  }
}

TEST(Demarsin, ASphereHasNoSharpPoint) {
  const FeatureLabels labels = detect(shape("sphere").cloud);
  EXPECT_EQ(count(labels, Kind::Edge) + count(labels, Kind::Corner), 0U);
}

TEST(Demarsin, CornersSeeThreeFaces) {
  const SynthCloud cube = shape("cube");
  const FeatureLabels labels = detect(cube.cloud);
  EXPECT_GT(count(labels, Kind::Corner), 8U);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels.kind[i] != Kind::Corner) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& corner : cube.corners) {
      const Point& p = cube.cloud.positions[i];
      nearest = std::min(nearest, std::hypot(p[0] - corner[0], p[1] - corner[1], p[2] - corner[2]));
    }
    EXPECT_LT(nearest, 6 * cube.spacing);
  }
  EXPECT_EQ(count(detect(shape("cylinder").cloud), Kind::Corner), 0U) << "two faces only";
}

TEST(Demarsin, SmallFacesAreNoPatches) {
  const SynthCloud cube = shape("cube", 3000);
  DemarsinOptions options;
  options.min_patch = 100000;
  const FeatureLabels labels = detect(cube.cloud, options);
  EXPECT_EQ(count(labels, Kind::Curved), labels.size()) << "no patch to see, so nothing is sharp";
}

TEST(Demarsin, TheScoreIsTheTurnOfTheNormals) {
  const SynthCloud cube = shape("cube");
  const FeatureLabels labels = detect(cube.cloud);
  const Column& distance = *cube.cloud.attribute("truth_distance");
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (distance.value(i) < 6 * cube.spacing) continue;
    EXPECT_LT(labels.score[i], 1e-5F);
    EXPECT_EQ(labels.kind[i], Kind::Flat);
  }
  EXPECT_GT(*std::max_element(labels.score.begin(), labels.score.end()), 45);
}

TEST(Demarsin, SeesTheSameHoweverTheCloudLies) {
  const PointCloud cloud = shape("fandisk", 6000).cloud;
  const FeatureLabels expected = detect(cloud);
  const auto differing = [&](const FeatureLabels& labels) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) differ += labels.kind[i] != expected.kind[i] ? 1U : 0U;
    return differ;
  };
  EXPECT_LE(differing(detect(test::moved(cloud, 1, {0, 0, 0}))), 10U);
  EXPECT_LE(differing(detect(test::moved(cloud, 1e-150, {0, 0, 0}))), 10U);
  EXPECT_LE(differing(detect(test::moved(cloud, 1, {4e6, 5e6, 100}))), 10U);
}

TEST(Demarsin, DegenerateCloudsAreAnswered) {
  EXPECT_EQ(detect({}).size(), 0U);
  PointCloud cloud;
  cloud.positions.assign(50, {1, 2, 3});
  EXPECT_EQ(count(detect(cloud), Kind::Undecided), 50U);
  cloud.positions.clear();
  for (int i = 0; i < 50; ++i) cloud.positions.push_back({1.0 * i, 0, 0});
  const FeatureLabels row = detect(cloud);
  EXPECT_EQ(count(row, Kind::Undecided), 50U);
  EXPECT_EQ(row.score, std::vector<float>(50, 0));
  cloud = shape("cube", 2000).cloud;
  const FeatureLabels clean = detect(cloud);
  cloud.positions.push_back({0, std::numeric_limits<double>::infinity(), 0});
  FeatureLabels with_infinity = detect(cloud);
  EXPECT_EQ(with_infinity.kind.back(), Kind::Undecided);
  with_infinity.kind.pop_back();
  EXPECT_EQ(with_infinity.kind, clean.kind);
}

TEST(Demarsin, RefusesOptionsOutOfRange) {
  const PointCloud cloud = shape("cube", 100).cloud;
  const auto refuses = [&](const DemarsinOptions& options, const char* name) {
    expect_error<InvalidArgument>([&] { (void)detect(cloud, options); }, name);
  };
  refuses({.normal_neighbors = 2}, "normal_neighbors");
  refuses({.region_neighbors = 256}, "region_neighbors");
  refuses(at_angle(0.9), "segment_angle_deg");
  refuses(at_angle(std::numeric_limits<double>::quiet_NaN()), "segment_angle_deg");
  refuses({.min_patch = 0}, "min_patch");
}

}  // namespace
}  // namespace keenline
