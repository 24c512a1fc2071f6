#include "keenline/detect/tensor_voting.h"

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

SynthCloud shape(const std::string& name, std::uint64_t points = 6000, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

FeatureLabels detect(const PointCloud& cloud, const TensorVotingOptions& options = {}) {
  return detect_tensor_voting(cloud, NeighborSearch(cloud.positions), options);
}

std::size_t count(const FeatureLabels& labels, Kind kind) {
  return static_cast<std::size_t>(std::count(labels.kind.begin(), labels.kind.end(), kind));
}

/// The scores of the points that are so far from the nearest sharp feature, in spacings, sorted.
std::vector<float> scores_between(const SynthCloud& synth, const FeatureLabels& labels, double from,
                                  double to) {
  const Column& distance = *synth.cloud.attribute("truth_distance");
  std::vector<float> scores;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double d = distance.value(i) / synth.spacing;
    if (d >= from && d < to) scores.push_back(labels.score[i]);
  }
  std::sort(scores.begin(), scores.end());
  return scores;
}

double quantile(const std::vector<float>& sorted, double share) {
  EXPECT_FALSE(sorted.empty());
  return static_cast<double>(
      sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))]);
}

TEST(TensorVoting, FindsTheEdgesOfACubeAndNothingElse) {
  const SynthCloud cube = shape("cube", 12000);
  const FeatureLabels labels = detect(cube.cloud);
  const Column& distance = *cube.cloud.attribute("truth_distance");
  std::size_t near = 0;
  std::size_t found = 0;
  std::size_t far = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double d = distance.value(i) / cube.spacing;
    near += d < 0.5 ? 1U : 0U;
    found += d < 0.5 && is_feature(labels.kind[i]) ? 1U : 0U;
    far += d > 3 && is_feature(labels.kind[i]) ? 1U : 0U;
    EXPECT_EQ(is_feature(labels.kind[i]), labels.score[i] > static_cast<float>(labels.threshold));
  }
  EXPECT_GT(found, near * 9 / 10);
  EXPECT_EQ(far, 0U);
  EXPECT_GT(count(labels, Kind::Corner), 0U);
}

TEST(TensorVoting, CurveSaliencyIsThatOfThePrototype) {
  // 12,000 points, sigma = 2.5 spacings: medians .00 on faces and .50 within half a spacing of an edge of a
  // cube, with 5 to 95 % of those in .33 to .76; .00 and .07 of an icosahedron.
  TensorVotingOptions options;
  options.voting_scale = 2.5;
  const SynthCloud cube = shape("cube", 12000);
  const FeatureLabels of_cube = detect(cube.cloud, options);
  EXPECT_LT(quantile(scores_between(cube, of_cube, 6, 1e9), 0.5), 0.005);
  const std::vector<float> edge = scores_between(cube, of_cube, 0, 0.5);
  EXPECT_NEAR(quantile(edge, 0.5), 0.50, 0.04);
  // The prototype had one sigma for the whole cloud; that of each point's own spacing spreads them a little.
  EXPECT_NEAR(quantile(edge, 0.05), 0.33, 0.08);
  EXPECT_NEAR(quantile(edge, 0.95), 0.76, 0.08);
  const SynthCloud icosahedron = shape("icosahedron", 12000);
  const FeatureLabels of_icosahedron = detect(icosahedron.cloud, options);
  EXPECT_LT(quantile(scores_between(icosahedron, of_icosahedron, 6, 1e9), 0.5), 0.005);
  EXPECT_NEAR(quantile(scores_between(icosahedron, of_icosahedron, 0, 0.5), 0.5), 0.07, 0.02);
}

TEST(TensorVoting, SmoothSurfacesHaveNoSharpPoint) {
  for (const char* const name : {"sphere", "torus"}) {
    const FeatureLabels labels = detect(shape(name).cloud);
    EXPECT_EQ(count(labels, Kind::Edge) + count(labels, Kind::Corner), 0U) << name;
    EXPECT_DOUBLE_EQ(labels.threshold, 0.2) << name;
  }
}

TEST(TensorVoting, FlatIsWhereTheVotedNormalsAgree) {
  PointCloud plane;
  for (int i = 0; i < 900; ++i) plane.positions.push_back({1.0 * (i % 30), 1.0 * (i / 30), 0});
  EXPECT_EQ(count(detect(plane), Kind::Flat), 900U);
  const SynthCloud cube = shape("cube");
  const FeatureLabels labels = detect(cube.cloud);
  const Column& distance = *cube.cloud.attribute("truth_distance");
  std::size_t beside = 0;
  std::size_t flat_beside = 0;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double d = distance.value(i) / cube.spacing;
    if (d > 6) {
      EXPECT_EQ(labels.kind[i], Kind::Flat);
    }
    // Votes of the other face arrive here.
    beside += d > 0.8 && d < 1.2 ? 1U : 0U;
    flat_beside += d > 0.8 && d < 1.2 && labels.kind[i] == Kind::Flat ? 1U : 0U;
  }
  EXPECT_LT(flat_beside, beside / 20);
}

TEST(TensorVoting, ALowerThresholdFindsMore) {
  const PointCloud cloud = shape("cube").cloud;
  const NeighborSearch search(cloud.positions);
  std::size_t before = 0;
  for (const double min_curve : {0.5, 0.15, 0.05}) {
    TensorVotingOptions options;
    options.min_curve = min_curve;
    const FeatureLabels labels = detect_tensor_voting(cloud, search, options);
    EXPECT_EQ(labels.threshold, min_curve);
    const std::size_t found = count(labels, Kind::Edge) + count(labels, Kind::Corner);
    EXPECT_GT(found, before);
    before = found;
    options.min_junction = 1;
    EXPECT_EQ(count(detect_tensor_voting(cloud, search, options), Kind::Corner), 0U);
  }
}

TEST(TensorVoting, APointBesideTheSurfaceIsNotSharp) {
  PointCloud cloud;
  for (int i = 0; i < 900; ++i) cloud.positions.push_back({1.0 * (i % 30), 1.0 * (i / 30), 0});
  cloud.positions.push_back({15.2, 14.7, 2.5});
  const FeatureLabels labels = detect(cloud);
  EXPECT_EQ(labels.kind.back(), Kind::Curved);
}

TEST(TensorVoting, SeesTheSameHoweverTheCloudLies) {
  const PointCloud cloud = shape("fandisk").cloud;
  const FeatureLabels expected = detect(cloud);
  const auto differing = [&](const FeatureLabels& labels) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < labels.size(); ++i) differ += labels.kind[i] != expected.kind[i] ? 1U : 0U;
    return differ;
  };
  EXPECT_LE(differing(detect(test::moved(cloud, 1, {0, 0, 0}))), 2U);
  EXPECT_LE(differing(detect(test::moved(cloud, 1e-150, {0, 0, 0}))), 2U);
  EXPECT_LE(differing(detect(test::moved(cloud, 1, {4e6, 5e6, 100}))), 2U);
}

TEST(TensorVoting, DegenerateCloudsAreAnswered) {
  EXPECT_EQ(detect({}).size(), 0U);
  PointCloud cloud;
  cloud.positions.assign(100, {1, 2, 3});
  EXPECT_EQ(count(detect(cloud), Kind::Undecided), 100U);
  cloud.positions.assign(16, {});
  for (std::size_t i = 0; i < 16; ++i) cloud.positions[i][0] = static_cast<double>(i);
  EXPECT_EQ(count(detect(cloud), Kind::Undecided), 16U) << "15 neighbours are too few";
  for (int i = 16; i < 60; ++i) cloud.positions.push_back({1.0 * i, 0, 0});
  const FeatureLabels line = detect(cloud);
  EXPECT_EQ(count(line, Kind::Edge), 0U) << "on a line any normal is as good as any other";
  cloud = shape("cube", 2000).cloud;
  const FeatureLabels clean = detect(cloud);
  cloud.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  FeatureLabels with_nan = detect(cloud);
  EXPECT_EQ(with_nan.kind.back(), Kind::Undecided);
  EXPECT_EQ(with_nan.score.back(), 0);
  with_nan.kind.pop_back();
  EXPECT_EQ(with_nan.kind, clean.kind);
}

TEST(TensorVoting, RefusesOptionsOutOfRange) {
  const PointCloud cloud = shape("cube", 100).cloud;
  const NeighborSearch search(cloud.positions);
  const auto refuses = [&](const TensorVotingOptions& options, const char* name) {
    expect_error<InvalidArgument>([&] { (void)detect_tensor_voting(cloud, search, options); }, name);
  };
  refuses({.voting_scale = 0.9}, "voting_scale");
  refuses({.voting_scale = std::numeric_limits<double>::quiet_NaN()}, "voting_scale");
  refuses({.curvature_weight = -1}, "curvature_weight");
  refuses({.min_curve = 1.5}, "min_curve");
  refuses({.min_junction = -0.1}, "min_junction");
}

}  // namespace
}  // namespace keenline
