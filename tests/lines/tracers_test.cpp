#include "keenline/lines/tracers.h"

#include <cstdint>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/detect/registry.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/spacing.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"
#include "support/motion.h"
#include "support/traced_shapes.h"

namespace keenline {
namespace {

using test::labelled_shape;
using test::LabelledShape;

TEST(Tracers, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const LineTracer& tracer : line_tracers()) {
    EXPECT_TRUE(names.insert(tracer.name).second);
    EXPECT_FALSE(tracer.summary.empty());
    EXPECT_EQ(&find_tracer(tracer.name), &tracer);
  }
  EXPECT_EQ(line_tracers().front().name, "walk");
}

TEST(Tracers, OfOtherNamesAreRefused) {
  test::expect_error<InvalidArgument>([] { (void)find_tracer("magic"); }, "--trace", "magic", "walk",
                                      "gumhold");
}

TEST(Tracers, EveryOneDrawsACube) {
  const LabelledShape cube = labelled_shape("cube", 6000);
  const NeighborSearch search(cube.synth.cloud.positions);
  for (const LineTracer& tracer : line_tracers()) {
    const FeatureGraph graph =
        tracer.trace(cube.synth.cloud, search, cube.labels, cube.spacing, no_progress());
    EXPECT_NO_THROW(validate(graph)) << tracer.name;
    const GraphCounts counts = counts_of(graph);
    EXPECT_NEAR(counts.length, 12, 2) << tracer.name;
    // The figures of the others are those of their own tests.
    if (tracer.name != "walk") continue;
    EXPECT_EQ(counts.corners, 8U);
    EXPECT_EQ(counts.polylines, 12U);
    EXPECT_EQ(counts.loose_ends, 0U);
  }
}

TEST(Tracers, EveryGraphIsValidWhateverWasLabelled) {
  LabelledShape cone = labelled_shape("cone", 2000);
  std::vector<Point>& positions = cone.synth.cloud.positions;
  // Peaks and edges that no graph may hold, a heap of copies, and labels without scores.
  for (const Kind kind : {Kind::Peak, Kind::Edge, Kind::Border, Kind::Corner}) {
    for (const double far : {1e20, 1e152, 1e300}) {
      positions.push_back({far, -far, 0.5 * far});
      cone.labels.kind.push_back(kind);
    }
    for (int copy = 0; copy < 60; ++copy) {
      positions.push_back(positions[static_cast<std::size_t>(kind)]);
      cone.labels.kind.push_back(kind);
    }
  }
  cone.labels.score.clear();
  const NeighborSearch search(positions);
  for (const LineTracer& tracer : line_tracers()) {
    for (const double spacing : {cone.spacing, 1e-310, 1e300}) {
      EXPECT_NO_THROW(validate(tracer.trace(cone.synth.cloud, search, cone.labels, spacing, no_progress())))
          << tracer.name << ", " << spacing;
    }
  }
}

/// What the method says to whose lines the tracer belongs.
FeatureLabels labels_for(const LineTracer& tracer, const PointCloud& cloud, const NeighborSearch& search) {
  const Method& method = find_method(tracer.name == "walk" ? "gauss" : tracer.name);
  OptionValues values = resolve_options(method, {});
  method.adapt(values, 0, cloud.size());
  return method.detect(cloud, search, values, no_progress());
}

FeatureGraph traced(const LineTracer& tracer, const PointCloud& cloud) {
  const NeighborSearch search(cloud.positions);
  const FeatureLabels labels = labels_for(tracer, cloud, search);
  return tracer.trace(cloud, search, labels, estimate_spacing(cloud, search), no_progress());
}

TEST(Tracers, SmoothSurfacesHaveNoLines) {
  for (const char* const name : {"sphere", "torus"}) {
    const PointCloud cloud = labelled_shape(name, 6000).synth.cloud;
    for (const LineTracer& tracer : line_tracers()) {
      const FeatureGraph graph = traced(tracer, cloud);
      EXPECT_TRUE(graph.polylines.empty()) << tracer.name << ' ' << name;
      EXPECT_TRUE(graph.corners.empty()) << tracer.name << ' ' << name;
    }
  }
}

TEST(Tracers, LinesMoveWithTheCloud) {
  const LabelledShape cube = labelled_shape("cube", 6000);
  const PointCloud moved = test::moved(cube.synth.cloud, 100, {4e6, -5e6, 3e6});
  const NeighborSearch search(cube.synth.cloud.positions);
  const NeighborSearch search_moved(moved.positions);
  for (const LineTracer& tracer : line_tracers()) {
    const FeatureLabels labels = labels_for(tracer, cube.synth.cloud, search);
    const GraphCounts here =
        counts_of(tracer.trace(cube.synth.cloud, search, labels, cube.spacing, no_progress()));
    const GraphCounts there =
        counts_of(tracer.trace(moved, search_moved, labels, 100 * cube.spacing, no_progress()));
    EXPECT_EQ(there.corners, here.corners) << tracer.name;
    EXPECT_EQ(there.polylines, here.polylines) << tracer.name;
    EXPECT_NEAR(there.length, 100 * here.length, 0.005 * 100 * here.length) << tracer.name;
  }
}

TEST(Tracers, DrawTheSameWithAnyNumberOfThreads) {
  SynthOptions options;
  options.shape = "fandisk";
  options.points = 4000;
  options.noise.amount = 0.05;
  const PointCloud cloud = synthesize(options).cloud;
  for (const LineTracer& tracer : line_tracers()) {
    const FeatureGraph graph = traced(tracer, cloud);
    EXPECT_FALSE(graph.polylines.empty());
    for (const std::size_t threads : {1U, 4U}) {
      const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
      const FeatureGraph again = traced(tracer, cloud);
      ASSERT_EQ(again.polylines.size(), graph.polylines.size()) << tracer.name;
      for (std::size_t i = 0; i < graph.polylines.size(); ++i) {
        EXPECT_EQ(again.polylines[i].vertices, graph.polylines[i].vertices) << tracer.name;
        EXPECT_EQ(again.polylines[i].support, graph.polylines[i].support) << tracer.name;
      }
    }
  }
}

TEST(Tracers, WhereThereIsNothingToTraceTheyDrawNothing) {
  PointCloud cloud;
  const auto expect_nothing = [&](Kind kind, double spacing) {
    FeatureLabels labels;
    labels.kind.assign(cloud.size(), kind);
    labels.score.assign(cloud.size(), 0);
    const NeighborSearch search(cloud.positions);
    for (const LineTracer& tracer : line_tracers()) {
      const FeatureGraph graph = tracer.trace(cloud, search, labels, spacing, no_progress());
      EXPECT_TRUE(graph.polylines.empty() && graph.corners.empty()) << tracer.name << ' ' << cloud.size();
    }
  };
  expect_nothing(Kind::Edge, 1);
  cloud.positions.assign(1, {1, 2, 3});
  expect_nothing(Kind::Edge, 1);
  cloud.positions.assign(200, {1, 2, 3});
  expect_nothing(Kind::Edge, 1);
  expect_nothing(Kind::Edge, 0);
  cloud.positions.push_back({std::numeric_limits<double>::quiet_NaN(), 0, 0});
  cloud.positions.push_back({1e300, 0, 0});
  expect_nothing(Kind::Border, 1);
  cloud = labelled_shape("cube", 1000).synth.cloud;
  expect_nothing(Kind::Flat, 0.1);
}

TEST(Tracers, StopWheneverTheyAreTold) {
  const LabelledShape cube = labelled_shape("cube", 1500);
  const NeighborSearch search(cube.synth.cloud.positions);
  // In one thread they ask as often every time.
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  for (const LineTracer& tracer : line_tracers()) {
    const auto trace = [&](Progress& progress) {
      (void)tracer.trace(cube.synth.cloud, search, cube.labels, cube.spacing, progress);
    };
    test::CancelledProgress never(std::numeric_limits<std::uint64_t>::max());
    trace(never);
    EXPECT_GT(never.asked(), 5U) << tracer.name;
    for (const std::uint64_t at : test::some_up_to(never.asked())) {
      test::CancelledProgress progress(at);
      EXPECT_THROW(trace(progress), Cancelled) << tracer.name << ", " << at << " of " << never.asked();
    }
  }
}

}  // namespace
}  // namespace keenline
