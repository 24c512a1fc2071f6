#include "keenline/cloud.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

TEST(Cloud, EveryScalarTypeHasItsSizeAndName) {
  const std::array sizes{1U, 1U, 2U, 2U, 4U, 4U, 8U, 8U, 4U, 8U};
  const std::array names{"int8",   "uint8", "int16",  "uint16",  "int32",
                         "uint32", "int64", "uint64", "float32", "float64"};
  for (std::size_t t = 0; t < sizes.size(); ++t) {
    EXPECT_EQ(size_of(static_cast<ScalarType>(t)), sizes[t]);
    EXPECT_EQ(name_of(static_cast<ScalarType>(t)), names[t]);
    visit_type(static_cast<ScalarType>(t),
               [&](auto zero) { EXPECT_EQ(scalar_type_of<decltype(zero)>(), static_cast<ScalarType>(t)); });
  }
}

TEST(Cloud, ColumnKeepsValuesAndType) {
  const Column column("n", std::vector<std::int16_t>{-3, 7});
  EXPECT_EQ(column.type(), ScalarType::Int16);
  EXPECT_EQ(column.rows(), 2U);
  EXPECT_EQ(column.values<std::int16_t>()[0], -3);
  EXPECT_EQ(column.value(1), 7.0);
  EXPECT_FALSE(column.is_list());
}

TEST(Cloud, ListColumnCountsRowsAndValues) {
  std::vector<std::byte> bytes(3 * 4);
  const Column column("faces", ScalarType::Int32, ScalarType::UInt8, {0, 3, 3}, bytes);
  EXPECT_TRUE(column.is_list());
  EXPECT_EQ(column.rows(), 2U);
  EXPECT_EQ(column.value_count(), 3U);
}

TEST(Cloud, ListColumnRefusesOffsetsThatDoNotMatch) {
  const std::vector<std::byte> bytes(8);
  for (const std::vector<std::uint64_t>& offsets :
       {std::vector<std::uint64_t>{}, {0, 3}, {1, 2}, {0, 2, 1, 2}})
    EXPECT_THROW(Column("l", ScalarType::Int32, ScalarType::UInt8, offsets, bytes), InvalidArgument);
}

TEST(Cloud, SetAttributeAddsOrReplacesAndChecksTheLength) {
  PointCloud cloud;
  cloud.positions.resize(2);
  cloud.set_attribute(Column("a", std::vector<float>{1, 2}));
  cloud.set_attribute(Column("b", std::vector<float>{3, 4}));
  cloud.set_attribute(Column("a", std::vector<double>{5, 6}));
  ASSERT_EQ(cloud.attributes.size(), 2U);
  EXPECT_EQ(cloud.attributes[0].type(), ScalarType::Float64);
  EXPECT_EQ(cloud.attribute("b")->value(1), 4);
  EXPECT_EQ(cloud.attribute("c"), nullptr);
  test::expect_error<InvalidArgument>([&] { cloud.set_attribute(Column("a", std::vector<float>{1})); }, "'a'",
                                      "1 rows", "2 points");
}

TEST(Cloud, CountsFinitePoints) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double largest = std::numeric_limits<double>::max();
  PointCloud cloud;
  cloud.positions = {
      {0, 0, 0}, {nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}, {largest, -largest, largest}};
  EXPECT_EQ(count_finite(cloud), 2U);
}

}  // namespace
}  // namespace keenline
