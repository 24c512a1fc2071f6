#include "keenline/lines/candidates.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// A band 4 wide and 60 long of random points, one per unit of area, at the given place and scale.
PointCloud band(double scale = 1, double shift = 0) {
  std::mt19937 generator(8);
  const auto number = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  PointCloud cloud;
  for (int i = 0; i < 240; ++i) {
    const double x = 60 * number();
    cloud.positions.push_back({scale * x + shift, scale * (4 * number() - 2) + shift, shift});
  }
  return cloud;
}

FeatureLabels all_edges(const PointCloud& cloud) {
  FeatureLabels labels;
  labels.kind.assign(cloud.size(), Kind::Edge);
  labels.score.assign(cloud.size(), 1);
  return labels;
}

Candidates candidates_of(const PointCloud& cloud, const FeatureLabels& labels, double spacing) {
  return {cloud, NeighborSearch(cloud.positions), labels, spacing, no_progress()};
}

TEST(Candidates, AreEdgesAndCornersInSpacings) {
  PointCloud cloud = band(0.01, 1e7);
  FeatureLabels labels = all_edges(cloud);
  labels.kind[0] = Kind::Flat;
  labels.kind[1] = Kind::Border;
  labels.kind[2] = Kind::Corner;
  const Candidates candidates = candidates_of(cloud, labels, 0.01);
  ASSERT_EQ(candidates.size(), 238U);
  EXPECT_EQ(candidates.points()[0], 2U);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    EXPECT_LT(
        distance(candidates.in_cloud(candidates.positions()[i]), cloud.positions[candidates.points()[i]]),
        1e-8);
}

TEST(Candidates, KnowWhichOthersAreNear) {
  const PointCloud cloud = band();
  FeatureLabels labels = all_edges(cloud);
  for (std::size_t i = 0; i < cloud.size(); i += 2) labels.kind[i] = Kind::Curved;
  const NeighborSearch search(cloud.positions);
  const Candidates candidates(cloud, search, labels, 1, no_progress());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    std::vector<std::uint32_t> expected;
    for (const std::uint32_t point : search.nearest(candidates.points()[i], 64))
      if (point % 2 == 1) expected.push_back(point / 2);
    EXPECT_EQ(std::vector<std::uint32_t>(candidates.near(i).begin(), candidates.near(i).end()), expected);
  }
}

TEST(Candidates, PointsThatCoincideAreOne) {
  PointCloud cloud = band();
  cloud.positions.insert(cloud.positions.end(), 20000, cloud.positions[7]);
  const FeatureLabels labels = all_edges(cloud);
  const Candidates candidates = candidates_of(cloud, labels, 1);
  ASSERT_EQ(candidates.size(), 240U);
  EXPECT_EQ(candidates.copies()[7], 20001U);
  std::size_t near = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) near += candidates.near(i).size();
  EXPECT_LE(near, 240U * 64);
  const CandidateClusters clusters =
      cluster(candidates, candidates.positions(), std::vector<float>(240, 1), 1.5);
  EXPECT_EQ(std::accumulate(clusters.sizes.begin(), clusters.sizes.end(), 0U), cloud.size());
}

TEST(Candidates, ThereAreNoneWithoutASpacing) {
  const PointCloud cloud = band();
  for (const double spacing :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(candidates_of(cloud, all_edges(cloud), spacing).size(), 0U);
  PointCloud far;
  far.positions = {{1e200, 0, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
  EXPECT_EQ(candidates_of(far, all_edges(far), 1).size(), 0U);
  EXPECT_THROW((void)candidates_of(cloud, FeatureLabels{}, 1), InvalidArgument);
}

TEST(Candidates, ABandIsDrawnTogetherAcross) {
  const PointCloud cloud = band();
  const Candidates candidates = candidates_of(cloud, all_edges(cloud), 1);
  double middle = 0;
  for (const Point& p : candidates.positions()) middle += p[1] / 240;
  const std::vector<Point> drawn = contracted(candidates, 3, 1);
  double before = 0;
  double after = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    before += std::abs(candidates.positions()[i][1] - middle) / 240;
    after += std::abs(drawn[i][1] - middle) / 240;
  }
  EXPECT_NEAR(before, 1, 0.1);
  EXPECT_LT(after, 0.6);
  EXPECT_EQ(contracted(candidates, 3, 0), candidates.positions());
  EXPECT_EQ(contracted(candidates, 1e-9, 5), candidates.positions()) << "nothing is near";
}

TEST(Candidates, ClustersAreWithinTheRadiusOfTheSharpest) {
  const PointCloud cloud = band();
  const Candidates candidates = candidates_of(cloud, all_edges(cloud), 1);
  std::vector<float> scores(cloud.size(), 1);
  scores[77] = 2;
  const CandidateClusters clusters = cluster(candidates, candidates.positions(), scores, 1.5);
  EXPECT_EQ(clusters.cluster[77], 0U);
  std::vector<Point> totals(clusters.sizes.size());
  std::vector<std::uint32_t> sizes(clusters.sizes.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const std::uint32_t name = clusters.cluster[i];
    totals[name] = sum(totals[name], candidates.positions()[i]);
    ++sizes[name];
    if (distance(candidates.positions()[i], candidates.positions()[77]) <= 1.5) {
      EXPECT_EQ(name, 0U);
    }
  }
  EXPECT_EQ(sizes, clusters.sizes);
  for (std::size_t c = 0; c < sizes.size(); ++c)
    EXPECT_LT(distance(clusters.centroids[c], scaled(1.0 / sizes[c], totals[c])), 1e-12);
}

}  // namespace
}  // namespace keenline
