#include "keenline/detect/voters.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/kernels/tensor_votes.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/vectors.h"

#include "support/motion.h"

namespace keenline {
namespace {

/// A square lattice in the xy plane, folded up by a right angle at x = 0 if wanted. Its points but those at
/// x = 0 are moved a little within the surface, so that no two are equally far from anything.
PointCloud lattice(bool folded) {
  std::mt19937 generator(6);
  const auto little = [&] { return 0.2 * (static_cast<double>(generator()) / 4294967296.0 - 0.5); };
  PointCloud cloud;
  for (int x = -10; x <= 10; ++x)
    for (int y = -10; y <= 10; ++y) {
      const double away = x == 0 ? 0 : x + little();
      const bool up = folded && x < 0;
      cloud.positions.push_back({up ? 0 : away, y + little(), up ? -away : 0});
    }
  return cloud;
}

constexpr std::size_t middle = 10 * 21 + 10;  // of a lattice: x = y = 0

struct Votes {
  Stick stick;
  kernels::Eigen3 sum;
};

/// Both passes at the middle of a lattice.
Votes votes_at_middle(const PointCloud& cloud, double sigma = 1.5) {
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, voters_within(sigma));
  Voters voters;
  std::vector<Stick> sticks(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (voters.gather(cloud.positions, i, neighborhoods.of(i), sigma)) sticks[i] = voters.stick_from_balls();
  EXPECT_TRUE(voters.gather(cloud.positions, middle, neighborhoods.of(middle), sigma));
  return {sticks[middle], kernels::eigen_decomposition(voters.stick_votes(sticks, 1))};
}

TEST(Voters, TheirNumberGrowsWithTheAreaAndHasAnEnd) {
  EXPECT_EQ(voters_within(1.5), 41);  // pi 3.6²
  EXPECT_EQ(voters_within(3), 163);   // pi 7.2²
  EXPECT_EQ(voters_within(largest_voting_scale), 248);
  EXPECT_EQ(voters_within(100), max_neighbors);
}

TEST(Voters, OnAPlaneAgreeOnItsNormal) {
  const Votes votes = votes_at_middle(lattice(false));
  EXPECT_NEAR(std::abs(votes.stick.normal[2]), 1, 1e-12);
  // A quarter where points are dense; the point's own ball makes it a little less.
  EXPECT_GT(votes.stick.saliency, 0.2);
  EXPECT_LT(votes.stick.saliency, 0.25);
  EXPECT_NEAR(std::abs(votes.sum.vectors[0][2]), 1, 1e-12);
  EXPECT_NEAR(votes.sum.values[1], 0, 1e-12);
}

TEST(Voters, OnAnEdgeVoteForBothFaces) {
  const Votes votes = votes_at_middle(lattice(true));
  const kernels::Saliency saliency = kernels::saliency_of(votes.sum);
  EXPECT_GT(saliency.curve, 0.5);
  EXPECT_LT(saliency.junction, 0.1);
  EXPECT_NEAR(std::abs(votes.sum.vectors[2][1]), 1, 1e-3) << "the edge runs along y";
}

TEST(Voters, SeeTheSameAtAnyScaleAndPlace) {
  const PointCloud cloud = lattice(true);
  const kernels::Saliency expected = kernels::saliency_of(votes_at_middle(cloud).sum);
  struct Case {
    double scale, shift;
  };
  for (const Case& c : {Case{1e-200, 0}, Case{1e-3, 0}, Case{1, 1e7}, Case{1e200, 0}}) {
    const PointCloud moved = test::moved(cloud, c.scale, {c.shift, c.shift, c.shift});
    const kernels::Saliency found = kernels::saliency_of(votes_at_middle(moved).sum);
    EXPECT_NEAR(found.curve, expected.curve, 1e-6) << c.scale;
    EXPECT_NEAR(found.junction, expected.junction, 1e-6) << c.scale;
  }
}

TEST(Voters, AreThereWhereSixteenNeighborsAre) {
  PointCloud cloud = lattice(false);
  Voters voters;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 41);
  EXPECT_FALSE(voters.gather(cloud.positions, middle, neighborhoods.of(middle).first(15), 1.5));
  EXPECT_TRUE(voters.gather(cloud.positions, middle, neighborhoods.of(middle).first(16), 1.5));
  EXPECT_FALSE(voters.gather(cloud.positions, middle, {}, 1.5));
}

TEST(Voters, ACoincidentVoterIsNoVoter) {
  // So near that the square of its distance is 0 beside the others.
  PointCloud cloud = lattice(false);
  cloud.positions.push_back({1e-200, 0, 1e-200});
  const Votes votes = votes_at_middle(cloud);
  EXPECT_NEAR(std::abs(votes.sum.vectors[0][2]), 1, 1e-12);
  EXPECT_TRUE(std::isfinite(votes.sum.values[0]));
}

TEST(Voters, WithoutSticksNobodyVotes) {
  const PointCloud cloud = lattice(false);
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 41);
  Voters voters;
  ASSERT_TRUE(voters.gather(cloud.positions, middle, neighborhoods.of(middle), 1.5));
  const std::vector<Stick> none(cloud.size());
  EXPECT_EQ(kernels::eigen_decomposition(voters.stick_votes(none, 1)).values[0], 0);
}

}  // namespace
}  // namespace keenline
