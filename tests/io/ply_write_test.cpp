#include <algorithm>
#include <bit>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/io/ply.h"
#include "keenline/io/ply_header.h"
#include "keenline/io/sink.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/bytes.h"
#include "support/cancelled_progress.h"
#include "support/expect_error.h"

namespace keenline {
namespace {

struct Written {
  std::string bytes;
  std::vector<std::string> notes;
};

Written write(const PointCloud& cloud) {
  StringSink sink;
  std::vector<std::string> notes = write_ply(cloud, sink, no_progress());
  return {std::move(sink.text), std::move(notes)};
}

PointCloud read(const std::string& bytes) { return read_ply({"a.ply", bytes}, no_progress()).cloud; }

/// A list column. `values` are strung together; `offsets` say where each row's begin.
template <typename T>
Column list(std::string name, ScalarType count_type, std::vector<std::uint64_t> offsets,
            const std::vector<T>& values) {
  const auto* const bytes = reinterpret_cast<const std::byte*>(values.data());
  return {std::move(name),
          scalar_type_of<T>(),
          count_type,
          std::move(offsets),
          {bytes, bytes + values.size() * sizeof(T)}};
}

void expect_same(const Column& a, const Column& b) {
  EXPECT_EQ(a.name(), b.name());
  EXPECT_EQ(a.type(), b.type()) << a.name();
  EXPECT_TRUE(std::equal(a.bytes().begin(), a.bytes().end(), b.bytes().begin(), b.bytes().end())) << a.name();
  EXPECT_TRUE(std::equal(a.offsets().begin(), a.offsets().end(), b.offsets().begin(), b.offsets().end()))
      << a.name();
  EXPECT_TRUE(!a.is_list() || a.count_type() == b.count_type()) << a.name();
}

void expect_same(const PointCloud& a, const PointCloud& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_EQ(std::bit_cast<std::uint64_t>(a.positions[i][d]),
                std::bit_cast<std::uint64_t>(b.positions[i][d]));
  EXPECT_EQ(a.position_types, b.position_types);
  EXPECT_EQ(a.comments, b.comments);
  ASSERT_EQ(a.attributes.size(), b.attributes.size());
  for (std::size_t i = 0; i < a.attributes.size(); ++i) expect_same(a.attributes[i], b.attributes[i]);
  ASSERT_EQ(a.tables.size(), b.tables.size());
  for (std::size_t t = 0; t < a.tables.size(); ++t) {
    EXPECT_EQ(a.tables[t].name, b.tables[t].name);
    EXPECT_EQ(a.tables[t].rows, b.tables[t].rows);
    ASSERT_EQ(a.tables[t].columns.size(), b.tables[t].columns.size());
    for (std::size_t i = 0; i < a.tables[t].columns.size(); ++i)
      expect_same(a.tables[t].columns[i], b.tables[t].columns[i]);
  }
}

template <typename T>
std::vector<T> extremes() {
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_floating_point_v<T>)
    return {Limits::quiet_NaN(), T{-0.0}, Limits::denorm_min(), -Limits::infinity(), Limits::max()};
  else return {Limits::min(), Limits::max(), T{0}, T{1}, T{2}};
}

PointCloud awkward_cloud() {
  PointCloud cloud;
  cloud.position_types = {ScalarType::Float64, ScalarType::Float32, ScalarType::Int16};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double denormal = std::numeric_limits<double>::denorm_min();
  cloud.positions = {
      {0.1, 0.5, -32768}, {-0.0, -0.0, 32767}, {denormal, nan, 0}, {1e308, -infinity, 1}, {nan, 1.5, 2}};
  cloud.attributes.emplace_back("a", extremes<std::int8_t>());
  cloud.attributes.emplace_back("b", extremes<std::uint8_t>());
  cloud.attributes.emplace_back("c", extremes<std::int16_t>());
  cloud.attributes.emplace_back("d", extremes<std::uint16_t>());
  cloud.attributes.push_back(list<float>("rings", ScalarType::UInt8, {0, 2, 2, 5, 5, 5}, extremes<float>()));
  cloud.attributes.emplace_back("e", extremes<std::int32_t>());
  cloud.attributes.emplace_back("f", extremes<std::uint32_t>());
  cloud.attributes.emplace_back("g", extremes<float>());
  cloud.attributes.emplace_back("h", extremes<double>());
  cloud.comments = {"by hand", "", " obj_info is a word", "obj_info num_cols 5", "tabs\tand  blanks "};
  Table faces{"face", 2, {}};
  faces.columns.push_back(
      list<std::int32_t>("vertex_indices", ScalarType::Int32, {0, 3, 7}, {0, 1, 2, 4, 3, 2, 1}));
  faces.columns.emplace_back("mark", std::vector<std::uint8_t>{7, 8});
  cloud.tables.push_back(faces);
  cloud.tables.push_back({"nothing", 0, {}});
  return cloud;
}

TEST(PlyWrite, ReadsBackToTheLastBit) {
  const PointCloud cloud = awkward_cloud();
  const Written written = write(cloud);
  EXPECT_TRUE(written.notes.empty());
  const PointCloud again = read(written.bytes);
  expect_same(cloud, again);
  EXPECT_EQ(write(again).bytes, written.bytes);
}

TEST(PlyWrite, WritesTheseBytes) {
  PointCloud cloud;
  cloud.position_types.fill(ScalarType::Float32);
  cloud.positions = {{1, 2, 3}};
  cloud.attributes.emplace_back("kind", std::vector<std::uint8_t>{2});
  cloud.comments = {"hello"};
  cloud.tables.push_back({"face", 1, {list<std::int32_t>("vertex_indices", ScalarType::UInt8, {0, 1}, {0})}});
  const std::string expected = test::Bytes(
                                   "ply\nformat binary_little_endian 1.0\ncomment hello\nelement vertex "
                                   "1\nproperty float x\nproperty float y\n"
                                   "property float z\nproperty uchar kind\nelement face 1\nproperty list "
                                   "uchar int vertex_indices\nend_header\n")
                                   .add(1.0F, 2.0F, 3.0F, std::uint8_t{2}, std::uint8_t{1}, 0)
                                   .str();
  EXPECT_EQ(write(cloud).bytes, expected);
}

TEST(PlyWrite, WritesAnEmptyCloud) {
  const PointCloud again = read(write(PointCloud()).bytes);
  EXPECT_EQ(again.size(), 0U);
  EXPECT_EQ(again.position_types[0], ScalarType::Float64);
}

TEST(PlyWrite, StoresLongIntegersInTheSmallestTypeThatHoldsThem) {
  PointCloud cloud;
  cloud.positions.resize(2);
  constexpr std::int64_t two_to_53 = std::int64_t{1} << 53;
  cloud.attributes.emplace_back("small", std::vector<std::int64_t>{-2147483648LL, 2147483647});
  cloud.attributes.emplace_back("positive", std::vector<std::int64_t>{0, 4294967295});
  cloud.attributes.emplace_back("large", std::vector<std::int64_t>{-1, 4294967295});
  cloud.attributes.emplace_back("exact", std::vector<std::uint64_t>{1, std::uint64_t{1} << 63});
  cloud.attributes.emplace_back("rounded", std::vector<std::int64_t>{1, two_to_53 + 1});
  const Written written = write(cloud);
  const PointCloud again = read(written.bytes);
  EXPECT_EQ(again.attributes[0].type(), ScalarType::Int32);
  EXPECT_EQ(again.attributes[0].value(0), -2147483648.0);
  EXPECT_EQ(again.attributes[1].type(), ScalarType::UInt32);
  EXPECT_EQ(again.attributes[1].value(1), 4294967295.0);
  EXPECT_EQ(again.attributes[2].type(), ScalarType::Float64);
  EXPECT_EQ(again.attributes[2].value(0), -1.0);
  EXPECT_EQ(again.attributes[3].type(), ScalarType::Float64);
  EXPECT_EQ(again.attributes[3].value(1), 9223372036854775808.0);
  EXPECT_EQ(again.attributes[4].value(1), 9007199254740992.0);
  ASSERT_EQ(written.notes.size(), 1U);
  EXPECT_NE(written.notes[0].find("'rounded': 1 of 2"), std::string::npos) << written.notes[0];
  EXPECT_NE(written.notes[0].find("CSV"), std::string::npos);
}

TEST(PlyWrite, StoresCoordinatesInATypeThatHoldsThem) {
  PointCloud cloud;
  cloud.positions = {{1, 0.5, 300}, {4294967295.0, 1e300, -1}};
  cloud.position_types = {ScalarType::UInt64, ScalarType::Float32, ScalarType::UInt8};
  const Written written = write(cloud);
  const PointCloud again = read(written.bytes);
  EXPECT_EQ(again.positions, cloud.positions);
  EXPECT_EQ(again.position_types, (std::array{ScalarType::UInt32, ScalarType::Float64, ScalarType::Float64}));
  EXPECT_EQ(written.notes.size(), 2U);  // the 64-bit integers are all there
}

TEST(PlyWrite, MakesNamesThatAHeaderCanHold) {
  PointCloud cloud;
  cloud.positions.resize(1);
  for (const char* name : {"my name", "x", "my_name", "", "a\nb"})
    cloud.attributes.emplace_back(name, std::vector<std::uint8_t>{1});
  cloud.tables.push_back({"vertex", 0, {}});
  const Written written = write(cloud);
  const PointCloud again = read(written.bytes);
  std::vector<std::string> names;
  for (const Column& column : again.attributes) names.push_back(column.name());
  EXPECT_EQ(names, (std::vector<std::string>{"my_name", "x_2", "my_name_2", "column", "a_b"}));
  EXPECT_EQ(again.tables[0].name, "vertex_2");
  ASSERT_EQ(written.notes.size(), 6U);
  EXPECT_EQ(written.notes[0], "'my name' is written as 'my_name'");
  EXPECT_EQ(written.notes[4], "'a\\x0ab' is written as 'a_b'");
}

TEST(PlyWrite, WidensListLengths) {
  PointCloud cloud;
  cloud.positions.resize(1);
  const auto type_for = [&](ScalarType count_type, std::size_t length) {
    cloud.attributes = {
        list<std::uint8_t>("l", count_type, {0, length}, std::vector<std::uint8_t>(length, 1))};
    const PointCloud again = read(write(cloud).bytes);
    EXPECT_EQ(again.attributes[0].value_count(), length);
    return again.attributes[0].count_type();
  };
  EXPECT_EQ(type_for(ScalarType::UInt8, 255), ScalarType::UInt8);
  EXPECT_EQ(type_for(ScalarType::UInt8, 256), ScalarType::UInt32);
  EXPECT_EQ(type_for(ScalarType::Int8, 127), ScalarType::Int8);
  EXPECT_EQ(type_for(ScalarType::Int8, 128), ScalarType::UInt32);
  EXPECT_EQ(type_for(ScalarType::UInt16, 300), ScalarType::UInt16);
  EXPECT_EQ(type_for(ScalarType::Int64, 3), ScalarType::UInt32);
}

TEST(PlyWrite, CleansComments) {
  PointCloud cloud;
  cloud.comments = {"two\nend_header\r\nlines", std::string("zero\0byte", 9)};
  EXPECT_EQ(read(write(cloud).bytes).comments,
            (std::vector<std::string>{"two end_header  lines", "zero byte"}));
}

TEST(PlyWrite, LeavesOutWhatItCannotHoldAndSaysSo) {
  PointCloud cloud;
  cloud.tables.push_back({"odd", 3, {}});
  cloud.comments.assign(3, std::string(longest_ply_header / 4 + 1, 'c'));
  const Written written = write(cloud);
  const PointCloud again = read(written.bytes);
  EXPECT_TRUE(again.tables.empty());
  EXPECT_EQ(again.comments.size(), 1U);
  ASSERT_EQ(written.notes.size(), 2U);
  EXPECT_NE(written.notes[0].find("'odd'"), std::string::npos);
  EXPECT_NE(written.notes[1].find("2 comments"), std::string::npos);
}

TEST(PlyWrite, RefusesColumnsOfTheWrongLength) {
  PointCloud cloud;
  cloud.positions.resize(2);
  cloud.attributes.emplace_back("a", std::vector<int>{1});
  test::expect_error<InvalidArgument>([&] { (void)write(cloud); }, "'a' has 1 rows", "'vertex' has 2");
  cloud.attributes.clear();
  cloud.tables.push_back({"t", 1, {Column("b", std::vector<int>{1, 2})}});
  test::expect_error<InvalidArgument>([&] { (void)write(cloud); }, "'b' has 2 rows", "'t' has 1");
}

/// Several blocks of rows, with lists, so that the order of blocks and the place of each row matter.
TEST(PlyWrite, WritesTheSameWithAnyNumberOfThreads) {
  constexpr std::size_t rows = 150000;
  PointCloud cloud;
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint32_t> values;
  for (std::size_t i = 0; i < rows; ++i) {
    cloud.positions.push_back({static_cast<double>(i), 0.5, -static_cast<double>(i)});
    for (std::size_t k = 0; k < i % 5; ++k) values.push_back(static_cast<std::uint32_t>(i + k));
    offsets.push_back(values.size());
  }
  cloud.attributes.push_back(list<std::uint32_t>("l", ScalarType::UInt8, offsets, values));
  const auto write_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return write(cloud).bytes;
  };
  const std::string one = write_with(1);
  EXPECT_TRUE(one == write_with(8));
  const PointCloud again = read(one);
  EXPECT_EQ(again.positions, cloud.positions);
  expect_same(again.attributes[0], cloud.attributes[0]);
}

TEST(PlyWrite, CanBeCancelled) {
  PointCloud cloud;
  cloud.positions.resize(10);
  StringSink sink;
  test::CancelledProgress progress;
  EXPECT_THROW((void)write_ply(cloud, sink, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
