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
