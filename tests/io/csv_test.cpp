#include "keenline/io/csv.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/io/sink.h"
#include "keenline/io/source.h"
#include "keenline/io/xyz.h"
#include "keenline/progress.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"

namespace keenline {
namespace {

using Strings = std::vector<std::string>;

struct Written {
  std::string text;
  Strings notes;
};

Written write(const PointCloud& cloud) {
  StringSink sink;
  Strings notes = write_csv(cloud, sink, no_progress());
  return {sink.text, std::move(notes)};
}

PointCloud cloud_of(std::vector<Point> positions) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  return cloud;
}

template <typename T>
Column list_column(const std::string& name, std::vector<std::uint64_t> offsets,
                   const std::vector<T>& values) {
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return {name, scalar_type_of<T>(), ScalarType::UInt8, std::move(offsets), std::move(bytes)};
}

TEST(Csv, WritesAHeaderAndRows) {
  PointCloud cloud = cloud_of({{1, 2.5, -3}, {0.1, 1e-200, 1e308}});
  cloud.set_attribute(Column("feature", std::vector<std::uint8_t>{0, 255}));
  cloud.set_attribute(Column("score", std::vector<float>{0.1F, 3.4028235e38F}));
  EXPECT_EQ(write(cloud).text, "x,y,z,feature,score\n1,2.5,-3,0,0.1\n0.1,1e-200,1e+308,255,3.4028235e+38\n");
  EXPECT_TRUE(write(cloud).notes.empty());
}

TEST(Csv, NoPointsAreAHeader) { EXPECT_EQ(write(PointCloud{}).text, "x,y,z\n"); }

TEST(Csv, SpellsWhatIsNotFinite) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(write(cloud_of({{-nan, infinity, -infinity}})).text, "x,y,z\nnan,inf,-inf\n");
}

TEST(Csv, CoordinatesHaveTheFormOfTheirType) {
  PointCloud cloud = cloud_of({{static_cast<double>(0.1F), 100000, 0.1}});
  cloud.position_types = {ScalarType::Float32, ScalarType::Int32, ScalarType::Float64};
  EXPECT_EQ(write(cloud).text, "x,y,z\n0.1,100000,0.1\n");
  // Moved since it was read: no longer what its type can hold.
  cloud.positions = {{0.1, 0.5, 1}};
  cloud.position_types = {ScalarType::Float32, ScalarType::Int32, ScalarType::UInt8};
  EXPECT_EQ(write(cloud).text, "x,y,z\n0.1,0.5,1\n");
  cloud.positions = {{1e300, 1e300, std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_EQ(write(cloud).text, "x,y,z\n1e+300,1e+300,nan\n");
}

TEST(Csv, QuotesNames) {
  PointCloud cloud = cloud_of({{1, 2, 3}});
  for (const char* name : {"a,b", "say \"c\"", "d;e", "#f", "plain name"})
    cloud.set_attribute(Column(name, std::vector<std::int32_t>{1}));
  EXPECT_EQ(write(cloud).text,
            "x,y,z,\"a,b\",\"say \"\"c\"\"\",\"d;e\",\"#f\",plain name\n1,2,3,1,1,1,1,1\n");
  EXPECT_TRUE(write(cloud).notes.empty());
}

TEST(Csv, ChangesNamesThatWouldNotReadBack) {
  PointCloud cloud = cloud_of({{1, 2, 3}});
  for (const char* name : {"X", "two\nlines", "", "n_0", " a"})
    cloud.set_attribute(Column(name, std::vector<std::int32_t>{1}));
  cloud.set_attribute(list_column<std::int32_t>("n", {0, 1}, {5}));
  const Written written = write(cloud);
  EXPECT_EQ(written.text.substr(0, written.text.find('\n')), "x,y,z,X_2,two_lines,column,n_0,a,n_0_2");
  EXPECT_EQ(
      written.notes,
      (Strings{"attribute 'X' is named 'X_2' in CSV", "attribute 'two\\x0alines' is named 'two_lines' in CSV",
               "attribute '' is named 'column' in CSV", "attribute ' a' is named 'a' in CSV",
               "attribute 'n_0' is named 'n_0_2' in CSV"}));
}

TEST(Csv, SpreadsListsOfOneLength) {
  PointCloud cloud = cloud_of({{1, 2, 3}, {4, 5, 6}});
  cloud.set_attribute(list_column<std::int16_t>("n", {0, 2, 4}, {7, -8, 9, 10}));
  EXPECT_EQ(write(cloud).text, "x,y,z,n_0,n_1\n1,2,3,7,-8\n4,5,6,9,10\n");
}

TEST(Csv, SaysWhatItLeavesOut) {
  PointCloud cloud = cloud_of({{1, 2, 3}, {4, 5, 6}});
  cloud.set_attribute(list_column<std::uint8_t>("ragged", {0, 1, 3}, {1, 2, 3}));
  cloud.set_attribute(list_column<std::uint8_t>("empty", {0, 0, 0}, {}));
  cloud.tables.push_back({"face", 12, {}});
  cloud.comments = {"one", "two"};
  const Written written = write(cloud);
  EXPECT_EQ(written.text, "x,y,z\n1,2,3\n4,5,6\n");
  EXPECT_EQ(written.notes,
            (Strings{"attribute 'ragged' (lists of varying length) is not in CSV",
                     "attribute 'empty' (empty lists) is not in CSV", "table 'face' (12 rows) is not in CSV",
                     "the comments (2 lines) are not in CSV"}));
}

PointCloud random_cloud(std::size_t size) {
  std::mt19937_64 random(7);
  std::vector<double> values;
  while (values.size() < 4 * size) {
    const double value = std::bit_cast<double>(random());  // any exponent, denormals too
    if (value - value == 0) values.push_back(value);
  }
  values[0] = -0.0;
  values[1] = std::numeric_limits<double>::denorm_min();
  values[2] = std::numeric_limits<double>::max();
  PointCloud cloud;
  std::vector<std::int64_t> integers;
  std::vector<std::uint64_t> naturals{std::numeric_limits<std::uint64_t>::max()};
  for (std::size_t i = 0; i < size; ++i) {
    cloud.positions.push_back({values[4 * i], values[4 * i + 1], values[4 * i + 2]});
    integers.push_back(static_cast<std::int64_t>(random()));
    if (i > 0) naturals.push_back(random());
  }
  cloud.set_attribute(
      Column("double, in quotes", std::vector<double>(values.begin(), values.begin() + size)));
  cloud.set_attribute(Column("int64", integers));
  cloud.set_attribute(Column("uint64", naturals));
  return cloud;
}

TEST(Csv, ReadsBackToTheLastBit) {
  const PointCloud cloud = random_cloud(20'000);
  const std::string text = write(cloud).text;
  const PointCloud again = read_xyz({"again.csv", text}, no_progress()).cloud;
  ASSERT_EQ(again.size(), cloud.size());
  EXPECT_EQ(std::memcmp(again.positions.data(), cloud.positions.data(), cloud.size() * sizeof(Point)), 0);
  ASSERT_EQ(again.attributes.size(), cloud.attributes.size());
  for (std::size_t c = 0; c < cloud.attributes.size(); ++c) {
    EXPECT_EQ(again.attributes[c].name(), cloud.attributes[c].name());
    EXPECT_EQ(again.attributes[c].type(), cloud.attributes[c].type());
    ASSERT_EQ(again.attributes[c].bytes().size(), cloud.attributes[c].bytes().size());
    EXPECT_EQ(std::memcmp(again.attributes[c].bytes().data(), cloud.attributes[c].bytes().data(),
                          cloud.attributes[c].bytes().size()),
              0)
        << cloud.attributes[c].name();
  }
}

TEST(Csv, FloatsReadBackAsTheSameFloats) {
  std::mt19937 random(7);
  PointCloud cloud;
  cloud.position_types.fill(ScalarType::Float32);
  std::vector<float> floats;
  while (floats.size() < 3000)
    if (const float value = std::bit_cast<float>(static_cast<std::uint32_t>(random())); value - value == 0)
      floats.push_back(value);
  cloud.positions.resize(floats.size() / 3);
  for (std::size_t i = 0; i < floats.size(); ++i)
    cloud.positions[i / 3][i % 3] = static_cast<double>(floats[i]);
  const std::string text = write(cloud).text;
  const PointCloud again = read_xyz({"again.csv", text}, no_progress()).cloud;
  ASSERT_EQ(again.size(), 1000U);
  for (std::size_t i = 0; i < floats.size(); ++i)
    EXPECT_EQ(static_cast<float>(again.positions[i / 3][i % 3]), floats[i]) << i;
}

TEST(Csv, TheSameBytesOnAnyNumberOfThreads) {
  const PointCloud cloud = random_cloud(30'000);
  const std::string text = write(cloud).text;
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(write(cloud).text, text);
}

class FullDisk : public Sink {
 public:
  void write(std::string_view /*bytes*/) override {
    if (++writes == 3) throw OutputError("a.csv", "no space left on device");
  }
  int writes = 0;
};

TEST(Csv, PassesOnWhatGoesWrong) {
  FullDisk disk;
  const PointCloud cloud = random_cloud(30'000);
  test::expect_error<OutputError>([&] { (void)write_csv(cloud, disk, no_progress()); },
                                  "a.csv: no space left");
  EXPECT_EQ(disk.writes, 3);
  StringSink sink;
  test::CancelledProgress stopped;
  EXPECT_THROW((void)write_csv(cloud, sink, stopped), Cancelled);
}

}  // namespace
}  // namespace keenline
