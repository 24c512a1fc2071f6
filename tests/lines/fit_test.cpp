#include "keenline/lines/fit.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/lines/fit_spline.h"
#include "keenline/vectors.h"

#include "support/cancelled_progress.h"
#include "support/rough_lines.h"
#include "support/uneven_clouds.h"

namespace keenline {
namespace {

FeatureGraph graph_of(const Polyline& line) {
  FeatureGraph graph;
  graph.polylines.push_back(line);
  return graph;
}

Polyline fitted(const Polyline& line, double tolerance) {
  const FeatureGraph graph = fit_lines(graph_of(line), tolerance);
  validate(graph);
  return graph.polylines[0];
}

/// y = f(x) for x from 0 to 10, with some unrest.
template <typename Function>
Polyline plotted(const Function& f, double unrest = 0.01) {
  Polyline line;
  for (const Point& p : test::random_points(101, 5)) {
    const double x = 0.1 * static_cast<double>(line.vertices.size());
    line.vertices.push_back({x, f(x) + unrest * (p[0] - 0.5), unrest * (p[1] - 0.5)});
  }
  return line;
}

double largest_move(const Polyline& a, const Polyline& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    largest = std::max(largest, distance(a.vertices[i], b.vertices[i]));
  return largest;
}

TEST(FitLines, TheSimplestCurveWithinTheToleranceIsTaken) {
  const Polyline straight = plotted([](double x) { return 0.5 * x; });
  EXPECT_TRUE(std::holds_alternative<FittedLine>(fitted(straight, 0.02).fitted));
  const Polyline bent = plotted([](double x) { return std::sqrt(900 - (x - 5) * (x - 5)); });
  EXPECT_TRUE(std::holds_alternative<FittedArc>(fitted(bent, 0.02).fitted));
  EXPECT_TRUE(std::holds_alternative<FittedLine>(fitted(bent, 1).fitted));
  const Polyline winding = plotted([](double x) { return std::sin(x); });
  EXPECT_TRUE(std::holds_alternative<FittedSpline>(fitted(winding, 0.02).fitted));
}

TEST(FitLines, NoVertexMovesFartherThanTheTolerance) {
  const Polyline winding = plotted([](double x) { return std::sin(x); });
  for (const double tolerance : {0.3, 0.1, 0.02}) {
    const Polyline line = fitted(winding, tolerance);
    EXPECT_LE(largest_move(line, winding), tolerance);
    EXPECT_EQ(line.vertices.front(), winding.vertices.front());
    EXPECT_EQ(line.vertices.back(), winding.vertices.back());
  }
}

TEST(FitLines, ASplineHasAsFewControlPointsAsTheToleranceAllows) {
  const Polyline winding = plotted([](double x) { return std::sin(x); });
  const auto controls = [&](double tolerance) {
    return std::get<FittedSpline>(fitted(winding, tolerance).fitted).control_points.size();
  };
  const std::size_t many = controls(0.02);
  EXPECT_LT(controls(0.1), many);
  EXPECT_LT(many, 20U);
  // One fewer would not do.
  const auto fewer = fit_spline(winding.vertices, false, many - 1);
  ASSERT_TRUE(fewer);
  double largest = 0;
  for (std::size_t i = 0; i < winding.vertices.size(); ++i) {
    const Point on_curve = point_on(fewer->spline, fewer->parameters[i]);
    largest = std::max(largest, distance(on_curve, winding.vertices[i]));
  }
  EXPECT_GT(largest, 0.02);
}

TEST(FitLines, WithoutToleranceALineIsInterpolated) {
  Polyline zigzag;
  for (int i = 0; i < 9; ++i) zigzag.vertices.push_back({double(i), double(i % 2), double(i % 3)});
  const Polyline line = fitted(zigzag, 1e-9);
  ASSERT_TRUE(std::holds_alternative<FittedSpline>(line.fitted));
  EXPECT_EQ(std::get<FittedSpline>(line.fitted).control_points.size(), 9U);
}

TEST(FitLines, EdgesOfShapesAreLinesAndCircles) {
  for (const char* const shape : {"cube", "through-hole", "cylinder", "fandisk"}) {
    const test::LineScene scene(test::shape_options(shape, 3000));
    const FeatureGraph rough =
        test::roughened(scene.truth, scene.spacing, {.vertices = 0.05, .corners = 0, .gap = 0});
    const FeatureGraph graph = fit_lines(rough, 0.15 * scene.spacing);
    validate(graph);
    for (std::size_t l = 0; l < graph.polylines.size(); ++l) {
      const Polyline& line = graph.polylines[l];
      const bool is_straight = scene.truth.polylines[l].vertices.size() == 2;
      if (is_straight) {
        EXPECT_TRUE(std::holds_alternative<FittedLine>(line.fitted)) << shape << l;
      } else if (line.closed && std::string(shape) != "fandisk") {
        ASSERT_TRUE(std::holds_alternative<FittedArc>(line.fitted)) << shape << l;
        EXPECT_EQ(std::get<FittedArc>(line.fitted).sweep_deg, 360);
        EXPECT_NEAR(std::get<FittedArc>(line.fitted).radius, std::string(shape) == "cylinder" ? 1 : 0.5,
                    0.02 * scene.spacing);
      }
      EXPECT_FALSE(std::holds_alternative<std::monostate>(line.fitted)) << shape << l;
    }
  }
}

TEST(FitLines, AClosedLineWithACornerIsNoCircle) {
  FeatureGraph graph;
  Polyline ring{.closed = true};
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * std::acos(-1.0) * i / 40;
    ring.vertices.push_back({std::cos(angle), std::sin(angle), 0});
  }
  graph.polylines.push_back(ring);
  EXPECT_TRUE(std::holds_alternative<FittedArc>(fit_lines(graph, 0.01).polylines[0].fitted));
  graph.corners.push_back({ring.vertices[0], {}});
  graph.polylines[0].start_corner = graph.polylines[0].end_corner = 0U;
  const Polyline line = fit_lines(graph, 0.01).polylines[0];
  EXPECT_TRUE(std::holds_alternative<FittedSpline>(line.fitted));
  EXPECT_EQ(line.vertices[0], ring.vertices[0]);
}

TEST(FitLines, LinesOfOnePlaceAreStraight) {
  const Polyline dot{.vertices = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}};
  EXPECT_EQ(fitted(dot, 0).vertices, dot.vertices);
  Polyline closed = dot;
  closed.closed = true;
  EXPECT_TRUE(std::holds_alternative<std::monostate>(fitted(closed, 0.1).fitted));
  EXPECT_TRUE(fit_lines({}, 1).polylines.empty());
}

TEST(FitLines, RefusesWhatIsOutOfRange) {
  EXPECT_THROW((void)fit_lines({}, -1), InvalidArgument);
  EXPECT_THROW((void)fit_lines({}, std::numeric_limits<double>::quiet_NaN()), InvalidArgument);
}

TEST(FitLines, CanBeCancelled) {
  test::CancelledProgress progress;
  EXPECT_THROW((void)fit_lines(graph_of({.vertices = {{0, 0, 0}, {1, 0, 0}}}), 1, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
