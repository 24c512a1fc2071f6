#include "keenline/io/graph_ply.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/ply.h"
#include "keenline/io/source.h"

#include "support/cancelled_progress.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

std::vector<double> column(const PointCloud& cloud, std::string_view name) {
  const std::vector<Column>& columns = cloud.tables.at(0).columns;
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const Column& c) { return c.name() == name; });
  std::vector<double> values;
  if (found != columns.end())
    for (std::size_t i = 0; i < found->rows(); ++i) values.push_back(found->value(i));
  return values;
}

TEST(GraphPly, HasVerticesAndEdges) {
  const std::string bytes = test::written(write_graph_ply, test::sample_graph());
  const PointCloud cloud = read_ply({"a.ply", bytes}, no_progress()).cloud;
  ASSERT_EQ(cloud.size(), 7U);
  EXPECT_EQ(cloud.positions[0], test::sample_graph().corners[0].position);
  EXPECT_EQ(cloud.attribute("corner")->value(1), 1);
  EXPECT_EQ(cloud.attribute("corner")->value(2), -1);
  ASSERT_EQ(cloud.tables.size(), 1U);
  EXPECT_EQ(cloud.tables[0].name, "edge");
  using Values = std::vector<double>;
  EXPECT_EQ(column(cloud, "vertex1"), (Values{0, 2, 3, 4, 5, 1}));
  EXPECT_EQ(column(cloud, "vertex2"), (Values{2, 1, 4, 5, 3, 6}));
  EXPECT_EQ(column(cloud, "line"), (Values{0, 0, 1, 1, 1, 2}));
  EXPECT_EQ(column(cloud, "kind"), (Values{0, 0, 1, 1, 1, 0}));
}

TEST(GraphPly, AnEmptyGraphIsAFile) {
  const std::string bytes = test::written(write_graph_ply, {});
  const PointCloud cloud = read_ply({"a.ply", bytes}, no_progress()).cloud;
  EXPECT_EQ(cloud.size(), 0U);
  ASSERT_EQ(cloud.tables.size(), 1U);
  EXPECT_EQ(cloud.tables[0].rows, 0U);
}

TEST(GraphPly, CanBeCancelled) {
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW(write_graph_ply(test::sample_graph(), sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
