#include "keenline/io/graph_obj.h"

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/obj.h"
#include "keenline/io/source.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

TEST(GraphObj, WritesLinesInGroups) {
  EXPECT_EQ(test::written(write_graph_obj, test::sample_graph()),
            "v 4500000.123 5400000.001 99.875\n"
            "v 4500010.123 5400000.001 0.1\n"
            "v 4500005.5 5400000 1e-07\n"
            "v 0 0 0\n"
            "v 1 0 0\n"
            "v 0 1 0.3333333333333333\n"
            "v 1 2 3\n"
            "g creases\n"
            "l 1 3 2\n"
            "l 2 7\n"
            "g borders\n"
            "l 4 5 6 4\n"
            "g corners\n"
            "p 1\n"
            "p 2\n");
}

TEST(GraphObj, IsReadBackAsPointsAndLines) {
  const std::string text = test::written(write_graph_obj, test::sample_graph());
  const PointCloud cloud = read_obj({"a.obj", text}, no_progress()).cloud;
  EXPECT_EQ(cloud.size(), 7U);
  EXPECT_EQ(cloud.positions[0], test::sample_graph().corners[0].position);
  ASSERT_EQ(cloud.tables.size(), 1U);
  EXPECT_EQ(cloud.tables[0].rows, 3U);
}

TEST(GraphObj, AnEmptyGraphIsAFile) {
  EXPECT_EQ(test::written(write_graph_obj, {}), "g creases\ng borders\ng corners\n");
}

TEST(GraphObj, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_obj(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
