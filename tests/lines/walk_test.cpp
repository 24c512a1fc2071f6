#include "keenline/lines/walk.h"

#include <cmath>
#include <functional>
#include <utility>

#include <gtest/gtest.h>

namespace keenline {
namespace {

/// A circle of this radius about the origin.
class Circle : public Tracker {
 public:
  explicit Circle(double radius, double end_x = 1e9) : radius_(radius), end_x_(end_x) {}
  [[nodiscard]] Foot at(const Point& p) const {
    const Point out = unit({p[0], p[1], 0});
    Foot foot;
    foot.position = scaled(radius_, out);
    foot.tangent = {-out[1], out[0], 0};
    foot.normals = {Point{0, 0, 1}, out};
    foot.quality = 1;
    foot.is_backed = true;
    return foot;
  }
  [[nodiscard]] std::optional<Foot> find(std::uint32_t /*point*/) const override { return at({1, 0, 0}); }
  [[nodiscard]] std::optional<Foot> follow(const Foot& from, const Point& expected) const override {
    Foot foot = at(expected);
    if (foot.position[0] > end_x_) return std::nullopt;
    if (dot(foot.tangent, from.tangent) < 0) foot.tangent = scaled(-1, foot.tangent);
    return foot;
  }

 private:
  double radius_;
  double end_x_;
};

/// The x axis as far as x = 40, with evidence that depends on x.
class Axis : public Tracker {
 public:
  explicit Axis(std::function<double(double)> evidence) : evidence_(std::move(evidence)) {}
  [[nodiscard]] Foot at(double x) const {
    Foot foot;
    foot.position = {x, 0, 0};
    foot.tangent = {1, 0, 0};
    foot.normals = {Point{0, 1, 0}, Point{0, 0, 1}};
    foot.quality = 1;
    foot.evidence = evidence_(x);
    return foot;
  }
  [[nodiscard]] std::optional<Foot> find(std::uint32_t /*point*/) const override { return at(0); }
  [[nodiscard]] std::optional<Foot> follow(const Foot& from, const Point& expected) const override {
    Foot foot = at(expected[0]);
    if (std::abs(expected[0]) > 40) return std::nullopt;
    if (from.tangent[0] < 0) foot.tangent = {-1, 0, 0};
    return foot;
  }

 private:
  std::function<double(double)> evidence_;
};

std::vector<Path> walked(const Axis& axis) {
  LineWalker walker(LineKind::Crease);
  walker.walk(axis, std::vector{axis.at(0)}, no_progress());
  return walker.paths();
}

TEST(LineWalker, EndsWhereTheEvidenceBeginsToFall) {
  const auto paths = walked(Axis([](double x) { return x < 20.5 ? 10 : -3; }));
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].feet.front().position[0], -40);
  EXPECT_EQ(paths[0].feet.back().position[0], 20);
}

TEST(LineWalker, GoesOnWhereAFewFeetSpeakAgainstTheLine) {
  const auto paths = walked(Axis([](double x) { return std::abs(x - 21) < 1.5 ? -3 : 10; }));
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].feet.size(), 81U);
}

TEST(LineWalker, StepsOverAFootThatSpeaksStronglyAgainstTheLine) {
  const auto paths = walked(Axis([](double x) { return x == 21 ? -1000 : 10; }));
  ASSERT_EQ(paths.size(), 1U);
  EXPECT_EQ(paths[0].feet.size(), 80U);
}

TEST(LineWalker, TooLittleEvidenceInAllIsNoLine) {
  EXPECT_TRUE(walked(Axis([](double) { return 0.6; })).empty());
  EXPECT_EQ(walked(Axis([](double) { return 0.65; })).size(), 1U);
}

TEST(LineWalker, WhatProvedNoLineDoesNotStopOthers) {
  bool is_weak = true;
  const Axis axis([&](double) { return is_weak ? 0.1 : 10; });
  LineWalker walker(LineKind::Crease);
  walker.walk(axis, std::vector{axis.at(0)}, no_progress());
  EXPECT_TRUE(walker.paths().empty());
  is_weak = false;
  walker.walk(axis, std::vector{axis.at(0)}, no_progress());
  ASSERT_EQ(walker.paths().size(), 1U);
  EXPECT_EQ(walker.paths()[0].feet.size(), 81U);
}

TEST(LineWalker, ClosesALoop) {
  const Circle circle(10);
  LineWalker walker(LineKind::Border);
  // All seeds lie on one line: only the best starts it.
  const std::vector<Foot> seeds{circle.at({1, 0, 0}), circle.at({0, 1, 0}), circle.at({-1, 0.5, 0})};
  walker.walk(circle, seeds, no_progress());
  ASSERT_EQ(walker.paths().size(), 1U);
  const Path& path = walker.paths()[0];
  EXPECT_TRUE(path.closed);
  EXPECT_EQ(path.kind, LineKind::Border);
  EXPECT_NEAR(static_cast<double>(path.feet.size()), 63, 2);
  double turn = 0;
  for (std::size_t i = 0; i + 1 < path.feet.size(); ++i) {
    const double step = distance(path.feet[i].position, path.feet[i + 1].position);
    EXPECT_NEAR(step, 1, 0.05);
    turn += step;
  }
  EXPECT_NEAR(turn, 62.8, 1.5);
}

TEST(LineWalker, WalksToBothEnds) {
  const Circle arc(10, 8.0);
  LineWalker walker(LineKind::Crease);
  walker.walk(arc, std::vector{arc.at({0.1, 1, 0})}, no_progress());
  ASSERT_EQ(walker.paths().size(), 1U);
  const Path& path = walker.paths()[0];
  EXPECT_FALSE(path.closed);
  EXPECT_GT(path.feet.front().position[0], 7);
  EXPECT_GT(path.feet.back().position[0], 7);
  EXPECT_LT(path.feet.front().position[1] * path.feet.back().position[1], 0);
  for (std::size_t i = 0; i + 1 < path.feet.size(); ++i)
    EXPECT_GT(dot(difference(path.feet[i + 1].position, path.feet[i].position), path.feet[i].tangent), 0);
}

}  // namespace
}  // namespace keenline
