#include "keenline/lines/tracers.h"

#include <set>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"
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

TEST(Tracers, OfNoPointsDrawNothing) {
  const PointCloud cloud;
  const NeighborSearch search(cloud.positions);
  for (const LineTracer& tracer : line_tracers()) {
    const FeatureGraph graph = tracer.trace(cloud, search, {}, 1, no_progress());
    EXPECT_TRUE(graph.polylines.empty()) << tracer.name;
    EXPECT_TRUE(graph.corners.empty()) << tracer.name;
  }
}

}  // namespace
}  // namespace keenline
