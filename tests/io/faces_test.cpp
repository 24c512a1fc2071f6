#include "keenline/io/faces.h"

#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

FaceBuilder with_rows(const std::vector<std::vector<std::uint32_t>>& rows) {
  FaceBuilder faces;
  for (const auto& row : rows) faces.add(row);
  return faces;
}

TEST(Faces, KeepsRowsInOrderAlsoEmptyOnes) {
  FaceBuilder faces = with_rows({{0, 1, 2}, {}, {2, 1, 3, 4}});
  EXPECT_EQ(faces.rows(), 3U);
  const Table table = faces.finish();
  EXPECT_EQ(table.name, "face");
  EXPECT_EQ(table.rows, 3U);
  ASSERT_EQ(table.columns.size(), 1U);
  const Column& column = table.columns.front();
  EXPECT_EQ(column.name(), "vertex_indices");
  EXPECT_EQ(column.type(), ScalarType::Int32);
  EXPECT_EQ(column.count_type(), ScalarType::UInt8);
  EXPECT_EQ(std::vector<std::uint64_t>(column.offsets().begin(), column.offsets().end()),
            (std::vector<std::uint64_t>{0, 3, 3, 7}));
  const auto values = column.values<std::int32_t>();
  EXPECT_EQ(std::vector<std::int32_t>(values.begin(), values.end()),
            (std::vector<std::int32_t>{0, 1, 2, 2, 1, 3, 4}));
}

TEST(Faces, IsEmptyAfterFinish) {
  FaceBuilder faces = with_rows({{5, 6, 7}});
  (void)faces.finish();
  EXPECT_EQ(faces.rows(), 0U);
  const Table table = faces.finish("line");
  EXPECT_EQ(table.name, "line");
  EXPECT_EQ(table.rows, 0U);
  EXPECT_EQ(table.columns.front().rows(), 0U);
}

TEST(Faces, TakesUnsignedNumbersOnlyWhereSignedOnesEnd) {
  EXPECT_EQ(with_rows({{0x7FFF'FFFFU}}).finish().columns.front().type(), ScalarType::Int32);
  const Table table = with_rows({{0x8000'0000U}}).finish();
  EXPECT_EQ(table.columns.front().type(), ScalarType::UInt32);
  EXPECT_EQ(table.columns.front().value(0), 2147483648.0);
}

TEST(Faces, TakesByteLengthsUpTo255) {
  EXPECT_EQ(with_rows({std::vector<std::uint32_t>(255)}).finish().columns.front().count_type(),
            ScalarType::UInt8);
  EXPECT_EQ(with_rows({std::vector<std::uint32_t>(256)}).finish().columns.front().count_type(),
            ScalarType::Int32);
}

TEST(Faces, SaysWhichVertexNumbersThereAre) {
  EXPECT_EQ(expected_vertex_number(0, 8), "a vertex number from 0 to 7");
  EXPECT_EQ(expected_vertex_number(1, 8), "a vertex number from 1 to 8");
  EXPECT_EQ(expected_vertex_number(0, 0), "no vertex number: there are no vertices");
}

}  // namespace
}  // namespace keenline
