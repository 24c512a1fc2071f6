#include "keenline/kernels/tensor_votes.h"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/vectors.h"

#include "support/motion.h"

namespace keenline::kernels {
namespace {

using std::numbers::pi;

Point random_direction(std::mt19937& generator) {
  const auto number = [&] { return static_cast<double>(generator()) / 2147483648.0 - 1; };
  Point p{};
  do p = {number(), number(), number()};
  while (dot(p, p) > 1 || dot(p, p) < 0.01);
  return unit(p);
}

Symmetric3 added(const Symmetric3& a, const Symmetric3& b, double s) {
  return {a.xx + s * b.xx, a.xy + s * b.xy, a.xz + s * b.xz,
          a.yy + s * b.yy, a.yz + s * b.yz, a.zz + s * b.zz};
}

/// nᵀ M n
double along(const Symmetric3& m, const Point& n) {
  return m.xx * n[0] * n[0] + m.yy * n[1] * n[1] + m.zz * n[2] * n[2] +
         2 * (m.xy * n[0] * n[1] + m.xz * n[0] * n[2] + m.yz * n[1] * n[2]);
}

void expect_near(const Symmetric3& a, const Symmetric3& b, double tolerance) {
  EXPECT_NEAR(a.xx, b.xx, tolerance);
  EXPECT_NEAR(a.xy, b.xy, tolerance);
  EXPECT_NEAR(a.xz, b.xz, tolerance);
  EXPECT_NEAR(a.yy, b.yy, tolerance);
  EXPECT_NEAR(a.yz, b.yz, tolerance);
  EXPECT_NEAR(a.zz, b.zz, tolerance);
}

/// A stick vote that fades as the closed form does: exp(-l²) (1 - u²), word for word.
Symmetric3 smooth_stick(const Point& normal, const Point& offset) {
  const Point r = unit(offset);
  const double u = dot(normal, r);
  const Point voted = difference(normal, scaled(2 * u, r));
  Symmetric3 m;
  add_outer_product(m, voted[0], voted[1], voted[2]);
  return added({}, m, std::exp(-dot(offset, offset)) * (1 - u * u));
}

Symmetric3 stick(const Point& normal, const Point& offset, double curvature_weight) {
  Symmetric3 m;
  add_stick_vote(m, normal, offset, curvature_weight);
  return m;
}

using Vote = std::function<Symmetric3(const Point& normal)>;

/// Mean over the whole sphere: midpoints in z, equal steps around.
Symmetric3 mean_over_sphere(const Vote& vote, int steps) {
  Symmetric3 sum;
  for (int i = 0; i < steps; ++i) {
    const double z = (i + 0.5) * 2 / steps - 1;
    const double radius = std::sqrt(1 - z * z);
    for (int k = 0; k < 32; ++k) {
      const double angle = 2 * pi * k / 32;
      sum = added(sum, vote({radius * std::cos(angle), radius * std::sin(angle), z}), 1.0 / (32 * steps));
    }
  }
  return sum;
}

TEST(TensorVotes, AStickVotesForTheCircleThatTouchesIt) {
  // Points of a circle of radius 1.5 that touches the xy plane at the origin: its normals point to its
  // middle.
  const Point middle{0, 0, 1.5};
  for (int degrees = -88; degrees <= 88; degrees += 8) {
    if (degrees == 0) continue;
    const double a = degrees * pi / 180;
    const Point receiver{1.5 * std::sin(a), 0, 1.5 - 1.5 * std::cos(a)};
    const Eigen3 voted = eigen_decomposition(stick({0, 0, 1}, receiver, 1));
    EXPECT_NEAR(length(cross(voted.vectors[0], unit(difference(middle, receiver)))), 0, 1e-12);
    EXPECT_NEAR(voted.values[1], 0, 1e-15);
    // Arc length and curvature of the circle say how much the vote counts.
    EXPECT_NEAR(voted.values[0], std::exp(-(1.5 * a * 1.5 * a + 1 / (1.5 * 1.5))), 1e-12);
  }
}

TEST(TensorVotes, NoStickVotesBeyond45Degrees) {
  const auto strength = [](double degrees) {
    const double a = degrees * pi / 180;
    const Symmetric3 m = stick({0, 0, 1}, {std::cos(a), 0, std::sin(a)}, 0);
    return m.xx + m.yy + m.zz;
  };
  EXPECT_GT(strength(44.99), 0.1);
  EXPECT_EQ(strength(45.01), 0);
  EXPECT_EQ(strength(-45.01), 0);
  EXPECT_EQ(strength(90), 0);
}

TEST(TensorVotes, TheBallOfStickVotesHasTheTabulatedValues) {
  // Three times the mean over the sphere, across and along the offset.
  struct Row {
    double distance, curvature_weight, across, along;
  };
  for (const Row& row : {Row{0.5, 1, 0.2501, 0.0160}, Row{1, 1, 0.2045, 0.0412}, Row{2, 1, 0.01198, 0.00312},
                         Row{1, 0, 0.3081, 0.1149}}) {
    const Symmetric3 mean = mean_over_sphere(
        [&](const Point& n) {
          return stick(n, {0, 0, row.distance}, row.curvature_weight);
        },
        8000);
    EXPECT_NEAR(3 * mean.xx, row.across, 1e-4);
    EXPECT_NEAR(3 * mean.yy, row.across, 1e-4);
    EXPECT_NEAR(3 * mean.zz, row.along, 1e-4);
  }
}

TEST(TensorVotes, TheClosedFormIsTheIntegral) {
  std::mt19937 generator(3);
  for (int round = 0; round < 20; ++round) {
    const double distance = 0.1 + 0.1 * round;
    const Point offset = scaled(distance, random_direction(generator));
    Symmetric3 ball;
    add_ball_vote(ball, offset);
    expect_near(ball,
                added({}, mean_over_sphere([&](const Point& n) { return smooth_stick(n, offset); }, 200), 3),
                2e-4);
  }
}

TEST(TensorVotes, WeighAndAddUp) {
  const Point normal = unit({1, 2, 3});
  const Point offset{0.5, -0.6, 0.4};
  Symmetric3 twice;
  add_stick_vote(twice, normal, offset, 1, 2);
  expect_near(twice, added({}, stick(normal, offset, 1), 2), 1e-16);
  Symmetric3 balls;
  add_ball_vote(balls, offset);
  add_ball_vote(balls, offset, 3);
  Symmetric3 ball;
  add_ball_vote(ball, offset, 4);
  expect_near(balls, ball, 1e-15);
}

TEST(TensorVotes, AreNeverNegativeAndTurnWithTheirInput) {
  std::mt19937 generator(4);
  for (int round = 0; round < 300; ++round) {
    const Point axis = random_direction(generator);
    const Point offset = scaled(0.01 * (round + 1), random_direction(generator));
    const auto all = [](const Point& direction, const Point& to) {
      std::array<Symmetric3, 2> votes{};
      add_stick_vote(votes[0], direction, to, 1);
      add_ball_vote(votes[1], to);
      return votes;
    };
    const auto votes = all(axis, offset);
    const auto turned = all(test::turned(axis), test::turned(offset));
    for (std::size_t i = 0; i < votes.size(); ++i) {
      EXPECT_GE(eigen_decomposition(votes[i]).values[2], -1e-15);
      const Point probe = random_direction(generator);
      EXPECT_NEAR(along(turned[i], test::turned(probe)), along(votes[i], probe), 1e-14);
    }
  }
}

/// Sum of ball votes over all directions in some half or quarter planes, each evenly covered: what is left
/// of the first pass where points lie densely. The fading cancels.
Eigen3 dense_ball_votes(const std::function<std::vector<Point>(double)>& directions, double from, double to) {
  Symmetric3 tensor;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i)
    for (const Point& d : directions(from + (to - from) * (i + 0.5) / steps)) add_ball_vote(tensor, d);
  return eigen_decomposition(tensor);
}

TEST(TensorVotes, BallVotesOfPlaneEdgeAndCornerHaveTheExactRatios) {
  const Saliency plane = saliency_of(dense_ball_votes(
      [](double a) {
        return std::vector<Point>{{std::cos(a), std::sin(a), 0}};
      },
      0, 2 * pi));
  EXPECT_NEAR(plane.surface, 0.25, 1e-6);
  EXPECT_NEAR(plane.curve, 0, 1e-6);
  EXPECT_NEAR(plane.junction, 0.75, 1e-6);
  const Saliency edge = saliency_of(dense_ball_votes(
      [](double a) {
        return std::vector<Point>{{std::cos(a), std::sin(a), 0}, {0, std::sin(a), std::cos(a)}};
      },
      -pi / 2, pi / 2));
  EXPECT_NEAR(edge.surface, 0, 1e-6);
  EXPECT_NEAR(edge.curve, 1.0 / 7, 1e-6);
  EXPECT_NEAR(edge.junction, 6.0 / 7, 1e-6);
  const Saliency corner = saliency_of(dense_ball_votes(
      [](double a) {
        return std::vector<Point>{
            {std::cos(a), std::sin(a), 0}, {0, std::cos(a), std::sin(a)}, {std::sin(a), 0, std::cos(a)}};
      },
      0, pi / 2));
  EXPECT_NEAR(corner.surface, 0, 1e-6);
  EXPECT_NEAR(corner.curve, 0.180, 1e-3);
  EXPECT_NEAR(corner.junction, 0.820, 1e-3);
}

TEST(TensorVotes, WhereNobodyVotesThereIsNoSaliency) {
  const Saliency none = saliency_of(eigen_decomposition({}));
  EXPECT_EQ(none.surface, 0);
  EXPECT_EQ(none.curve, 0);
  EXPECT_EQ(none.junction, 0);
}

}  // namespace
}  // namespace keenline::kernels
