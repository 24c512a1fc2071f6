#include "keenline/io/graph_attributes.h"

#include <gtest/gtest.h>

#include "support/sample_graph.h"

namespace keenline {
namespace {

TEST(GraphAttributes, AreOneNumberPerLine) {
  const FeatureGraph graph = test::sample_graph();
  const LineAttributes crease = attributes_of(graph.polylines[0]);
  EXPECT_EQ(crease.kind, "crease");
  EXPECT_FALSE(crease.closed);
  EXPECT_EQ(crease.length, length_of(graph.polylines[0]));
  EXPECT_EQ(crease.start_corner, 0U);
  EXPECT_EQ(crease.end_corner, 1U);
  EXPECT_EQ(crease.support, 12U);
  EXPECT_EQ(crease.dihedral_deg, 92);  // mean of 90, 91, 95
  EXPECT_EQ(crease.residual, 0.5);     // largest
}

TEST(GraphAttributes, WhatIsNotKnownIsNotZero) {
  const LineAttributes border = attributes_of(test::sample_graph().polylines[1]);
  EXPECT_EQ(border.kind, "border");
  EXPECT_TRUE(border.closed);
  EXPECT_FALSE(border.start_corner || border.end_corner || border.dihedral_deg || border.residual);
}

}  // namespace
}  // namespace keenline
