#include "keenline/lines/wedge.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"
#include "keenline/lines/ends.h"

#include "support/traced_shapes.h"

namespace keenline {
namespace {

using test::labelled_shape;
using test::LabelledShape;

struct Tracked {
  explicit Tracked(LabelledShape&& labelled, double noise = 0)
      : shape(std::move(labelled)),
        search(shape.synth.cloud.positions),
        frame{{0, 0, 0}, shape.spacing},
        tracker(shape.synth.cloud, search, shape.labels, frame, view_of(noise)) {}

  LabelledShape shape;
  NeighborSearch search;
  TraceFrame frame;
  WedgeTracker tracker;
};

Tracked crease(double angle_deg, double noise = 0) {
  SynthOptions options;
  options.shape = "crease";
  options.points = 4000;
  options.angle_deg = angle_deg;
  options.noise.amount = noise;
  return Tracked(labelled_shape(options), noise);
}

const TruthCurve& crease_of(const Tracked& t) {
  const std::vector<TruthCurve>& curves = t.shape.synth.curves;
  return *std::find_if(curves.begin(), curves.end(), [](const TruthCurve& curve) { return !curve.border; });
}

double distance_to_line(const Point& p, const TruthCurve& line) {
  const Point along = unit(difference(line.vertices[1], line.vertices[0]));
  return length(cross(difference(p, line.vertices[0]), along));
}

class WedgeAt : public testing::TestWithParam<double> {};

TEST_P(WedgeAt, TheFootLiesOnTheCreaseOfTwoPlanes) {
  const Tracked t = crease(GetParam());
  const TruthCurve& truth = crease_of(t);
  const Point along = unit(difference(truth.vertices[1], truth.vertices[0]));
  std::size_t found = 0;
  std::size_t candidates = 0;
  for (std::uint32_t i = 0; i < t.shape.labels.size(); ++i) {
    if (t.shape.labels.kind[i] != Kind::Edge) continue;
    ++candidates;
    const auto foot = t.tracker.find(i);
    if (!foot) continue;
    ++found;
    EXPECT_LT(distance_to_line(t.frame.global(foot->position), truth), 1e-6 * t.shape.spacing);
    EXPECT_NEAR(std::abs(dot(foot->tangent, along)), 1, 1e-9);
    const double cosine = std::abs(dot(foot->normals[0], foot->normals[1]));
    EXPECT_NEAR(cosine, std::abs(kernels::sin_cos(kernels::radians(GetParam() - 90)).sin), 1e-6);
    EXPECT_GT(foot->quality, 0.9);
    EXPECT_TRUE(foot->is_backed);
  }
  EXPECT_GT(candidates, 30U);
  EXPECT_GT(found, 0.95 * static_cast<double>(candidates));
}

INSTANTIATE_TEST_SUITE_P(Dihedral, WedgeAt, testing::Values(60.0, 90.0, 120.0, 150.0, 160.0, 270.0));

TEST(Wedge, FollowsTheCreaseToItsEndAndNoFarther) {
  const Tracked t = crease(90);
  std::optional<Foot> foot;
  for (std::uint32_t i = 0; !foot && i < t.shape.labels.size(); ++i)
    if (t.shape.labels.kind[i] == Kind::Edge) foot = t.tracker.find(i);
  ASSERT_TRUE(foot);
  int steps = 0;
  for (; steps < 100; ++steps) {
    const auto next = t.tracker.follow(*foot, sum(foot->position, scaled(foot->scale, foot->tangent)));
    if (!next) break;
    EXPECT_GT(dot(next->tangent, foot->tangent), 0.999);
    foot = next;
  }
  EXPECT_LT(steps, 60);  // the crease is 45 spacings long
  const Point end = t.frame.global(foot->position);
  double nearest = 1e300;
  for (const TruthCurve& curve : t.shape.synth.curves)
    if (!curve.border)
      for (const Point& vertex : curve.vertices) nearest = std::min(nearest, distance(vertex, end));
  EXPECT_LT(nearest, line_overrun * t.shape.spacing);  // by which ends may be taken back
}

TEST(Wedge, SeesNoCreaseInSmoothSurfaces) {
  for (const char* name : {"plane", "sphere", "torus", "cylinder"}) {
    const Tracked t(labelled_shape(name, 3000, 0.05));
    const auto distances = t.shape.synth.cloud.attribute("truth_distance")->values<double>();
    int found = 0;
    int asked = 0;
    for (std::uint32_t i = 0; i < t.shape.labels.size(); i += 7) {
      if (distances[i] < 5 * t.shape.spacing) continue;
      ++asked;
      found += t.tracker.find(i) ? 1 : 0;
    }
    EXPECT_GT(asked, 100) << name;
    EXPECT_LT(found, 0.1 * asked) << name;
  }
}

TEST(Wedge, LittleNoiseChangesNothingInTheView) {
  const WedgeView usual;
  const WedgeView view = view_of(0.06);
  EXPECT_EQ(view.points, usual.points);
  EXPECT_EQ(view.points_of_hypothesis, usual.points_of_hypothesis);
  EXPECT_EQ(view.unit, 1);
  EXPECT_EQ(view.tolerance, usual.tolerance);
}

TEST(Wedge, MoreNoiseIsSeenFromFartherAwayUpToALimit) {
  const WedgeView view = view_of(0.09);
  EXPECT_EQ(view.points, 61);
  EXPECT_EQ(view.points_of_hypothesis, 12);
  EXPECT_NEAR(view.unit, std::sqrt(1.5), 1e-12);
  EXPECT_NEAR(view.noise * view.unit, 0.09, 1e-12);
  EXPECT_EQ(view_of(0.2).points, 82);
  EXPECT_EQ(view_of(10).points, 82);
}

TEST(Wedge, FindsABluntCreaseInNoiseAndEvidenceForIt) {
  for (const double noise : {0.05, 0.1, 0.2}) {
    const Tracked t = crease(145, noise);
    const TruthCurve& truth = crease_of(t);
    int found = 0;
    int asked = 0;
    double evidence = 0;
    for (std::uint32_t i = 0; i < t.shape.labels.size(); ++i) {
      if (t.shape.labels.kind[i] != Kind::Edge) continue;
      ++asked;
      const auto foot = t.tracker.find(i);
      if (!foot) continue;
      ++found;
      evidence += foot->evidence;
      EXPECT_LT(distance_to_line(t.frame.global(foot->position), truth), 1.5 * t.shape.spacing) << noise;
    }
    EXPECT_GT(found, 0.9 * asked) << noise;
    EXPECT_GT(evidence, 10 * found) << noise;
  }
}

TEST(Wedge, EvidenceAgainstACreaseWhereANoisySurfaceBends) {
  const Tracked t(labelled_shape("torus", 4000, 0.1), 0.1);
  // A line along the surface with the normals that a blunt wedge might have there.
  double evidence = 0;
  int feet = 0;
  for (std::uint32_t i = 0; i < t.shape.labels.size(); i += 10) {
    const Point middle = t.frame.local(t.shape.synth.cloud.positions[i]);
    const Point out = unit({middle[0], middle[1], 0});
    Foot from;
    from.position = middle;
    from.tangent = {-out[1], out[0], 0};
    const Point up{0, 0, 1};
    from.normals = {unit(sum(out, scaled(0.2, up))), unit(sum(out, scaled(-0.2, up)))};
    const auto foot = t.tracker.follow(from, middle);
    if (!foot || foot->evidence == 25) continue;
    ++feet;
    evidence += foot->evidence;
  }
  EXPECT_GT(feet, 30);
  EXPECT_LT(evidence, -2 * feet);
}

TEST(Wedge, TooFewPointsAreNoWindow) {
  const Tracked t(labelled_shape("cube", 30));
  for (std::uint32_t i = 0; i < 30; ++i) EXPECT_FALSE(t.tracker.find(i));
}

}  // namespace
}  // namespace keenline
