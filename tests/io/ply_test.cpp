#include "keenline/io/ply.h"

#include <atomic>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/bytes.h"
#include "support/expect_error.h"

namespace keenline {
namespace {

Reading read(std::string_view text) { return read_ply({"a.ply", text}, no_progress()); }

template <typename... Parts>
void expect_refused(std::string_view text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "a.ply: ", parts...);
}

const std::string ascii_start = "ply\nformat ascii 1.0\n";
const std::string binary_start = "ply\nformat binary_little_endian 1.0\n";
const std::string xyz = "property float x\nproperty float y\nproperty float z\n";

TEST(Ply, ReadsPointsAttributesAndTables) {
  const Reading reading =
      read(ascii_start +
           "comment by hand\nelement face 2\nproperty list uchar int vertex_index\nproperty uchar mark\n"
           "element vertex 3\nproperty uchar red\nproperty double z\nproperty short x\n"
           "property list uchar float more\nproperty float y\nelement edge 1\nproperty int a\n"
           "end_header\n3 0 1 2 7\n3 2 1 0 8\n1 3 1 0 2\n4 6 4 2 8 9 5\n255 -9 7 1 3 -8\n42\n");
  EXPECT_EQ(reading.encoding, "ascii 1.0");
  const PointCloud& cloud = reading.cloud;
  EXPECT_EQ(cloud.comments, std::vector<std::string>{"by hand"});
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_EQ(cloud.positions[0], (Point{1, 2, 3}));
  EXPECT_EQ(cloud.positions[1], (Point{4, 5, 6}));
  EXPECT_EQ(cloud.positions[2], (Point{7, -8, -9}));
  EXPECT_EQ(cloud.position_types, (std::array{ScalarType::Int16, ScalarType::Float32, ScalarType::Float64}));
  ASSERT_EQ(cloud.attributes.size(), 2U);
  EXPECT_EQ(cloud.attributes[0].name(), "red");
  EXPECT_EQ(cloud.attributes[0].type(), ScalarType::UInt8);
  EXPECT_EQ(cloud.attributes[0].value(1), 4.0);
  EXPECT_EQ(cloud.attributes[1].name(), "more");
  EXPECT_EQ(cloud.attributes[1].value_count(), 3U);
  ASSERT_EQ(cloud.tables.size(), 2U);
  EXPECT_EQ(cloud.tables[0].name, "face");
  EXPECT_EQ(cloud.tables[0].rows, 2U);
  EXPECT_EQ(cloud.tables[0].columns[0].name(), "vertex_index");
  EXPECT_EQ(cloud.tables[0].columns[1].value(1), 8.0);
  EXPECT_EQ(cloud.tables[1].name, "edge");
  EXPECT_EQ(cloud.tables[1].columns[0].value(0), 42.0);
}

TEST(Ply, ReadsCoordinatesOfEveryTypeAsDoubles) {
  test::Bytes bytes(binary_start +
                    "element vertex 2\nproperty int64 x\nproperty double y\nproperty uchar z\nend_header\n");
  bytes.add(std::int64_t{1} << 53, 12345678.001, std::uint8_t{255});
  bytes.add(std::int64_t{-3}, std::numeric_limits<double>::infinity(), std::uint8_t{0});
  const Reading reading = read(bytes.str());
  EXPECT_EQ(reading.encoding, "binary little endian 1.0");
  EXPECT_EQ(reading.cloud.positions[0], (Point{9007199254740992.0, 12345678.001, 255}));
  EXPECT_EQ(reading.cloud.positions[1], (Point{-3, std::numeric_limits<double>::infinity(), 0}));
  EXPECT_TRUE(reading.cloud.attributes.empty());
}

TEST(Ply, RefusesCoordinatesThatADoubleCannotHold) {
  test::Bytes bytes(binary_start +
                    "element vertex 2\nproperty uchar y\nproperty uchar z\nproperty uint64 x\nend_header\n");
  const std::size_t start = bytes.size();
  bytes.add(std::uint8_t{0}, std::uint8_t{0}, std::uint64_t{5});
  bytes.add(std::uint8_t{0}, std::uint8_t{0}, (std::uint64_t{1} << 53) + 1);
  expect_refused(bytes.str(), "byte " + std::to_string(start + 10), "9007199254740993", "exactly");
}

TEST(Ply, ReadsFilesWithoutPoints) {
  EXPECT_EQ(read(ascii_start + "element vertex 0\n" + xyz + "end_header\n").cloud.size(), 0U);
  EXPECT_EQ(read(binary_start + "element vertex 0\n" + xyz + "end_header").cloud.size(), 0U);
}

TEST(Ply, KeepsNotANumberAndInfinity) {
  const PointCloud cloud =
      read(ascii_start + "element vertex 2\n" + xyz + "end_header\nnan -inf 1\nInf NAN -0\n").cloud;
  EXPECT_TRUE(std::isnan(cloud.positions[0][0]));
  EXPECT_EQ(cloud.positions[0][1], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(count_finite(cloud), 0U);
  EXPECT_TRUE(std::signbit(cloud.positions[1][2]));
}

TEST(Ply, ReadsTextWithReturnsOnly) {
  std::string text = ascii_start + "element vertex 2\n" + xyz + "end_header\n1 2 3\n4 5 6\n";
  for (char& c : text)
    if (c == '\n') c = '\r';
  EXPECT_EQ(read(text).cloud.positions[1], (Point{4, 5, 6}));
}

TEST(Ply, RefusesHeadersWithoutPoints) {
  expect_refused(ascii_start + "element vertices 0\n" + xyz + "end_header\n", "line 7", "'vertex'");
  expect_refused(ascii_start + "element vertex 0\nproperty float x\nproperty float y\nend_header\n", "line 3",
                 "'z'");
  expect_refused(
      ascii_start +
          "element vertex 0\nproperty float x\nproperty list uchar float y\nproperty float z\nend_header\n",
      "line 5", "'y' as a list");
  expect_refused(binary_start + "element vertex 4294967295\n" + xyz + "end_header\n", "line 3",
                 "4294967295 vertices", "at most 4294967294");
}

TEST(Ply, RefusesFacesOfPointsThatAreNotThere) {
  const std::string start = ascii_start +
                            "element face 2\nproperty list uchar int vertex_indices\nelement vertex 2\n" +
                            xyz + "end_header\n";  // 9 lines
  const std::string points = "1 2 3\n4 5 6\n";
  EXPECT_EQ(read(start + "3 0 1 1\n0\n" + points).cloud.tables[0].rows, 2U);
  expect_refused(start + "3 0 1 1\n3 0 1 2\n" + points, "line 11", "vertex number 2 in face 1",
                 "from 0 to 1");
  expect_refused(start + "0\n1 -1\n" + points, "line 11", "vertex number -1 in face 1");

  test::Bytes bytes(binary_start + "element vertex 1\n" + xyz +
                    "element face 2\nproperty list uchar uint vertex_index\nend_header\n");
  bytes.add(1.0F, 2.0F, 3.0F, std::uint8_t{1}, 0U);
  const std::size_t second = bytes.size();
  bytes.add(std::uint8_t{2}, 0U, 4294967295U);
  expect_refused(bytes.str(), "byte " + std::to_string(second), "vertex number 4294967295 in face 1",
                 "from 0 to 0");

  expect_refused(ascii_start + "element vertex 0\n" + xyz +
                     "element face 0\nproperty list uchar float vertex_indices\nend_header\n",
                 "line 8", "floating-point", "integer");
}

TEST(Ply, CarriesOtherListsUnchecked) {
  const Reading reading =
      read(ascii_start + "element vertex 1\n" + xyz +
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n1 2 3\n3 0 -1 9\n");
  EXPECT_EQ(reading.cloud.tables[0].columns[0].value(1), -1.0);
}

/// Everything that is not the whole file is refused, and nothing is read beyond its end.
TEST(Ply, RefusesAFileCutOffAnywhere) {
  const std::string properties =
      "element vertex 2\n" + xyz +
      "property list uchar short more\nelement face 1\nproperty list int int vertex_indices\nend_header\n";
  const std::string ascii = ascii_start + properties + "1 2 3 1 5\n4 5 6 0\n3 0 1 1";
  const std::string binary = test::Bytes(binary_start + properties)
                                 .add(1.0F, 2.0F, 3.0F, std::uint8_t{1}, std::int16_t{5})
                                 .add(4.0F, 5.0F, 6.0F, std::uint8_t{0}, 3, 0, 1, 1)
                                 .str();
  for (const std::string& whole : {ascii, binary}) {
    EXPECT_EQ(read(whole).cloud.size(), 2U);
    for (std::size_t size = 0; size < whole.size(); ++size) {
      // A copy of its own, so that a sanitizer sees every byte beyond.
      const std::vector<char> part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_THROW((void)read({part.data(), part.size()}), InputError) << size;
    }
  }
}

TEST(Ply, ReadsTheSameWithAnyNumberOfThreads) {
  test::Bytes bytes(binary_start + "element vertex 200000\n" + xyz + "property uchar mark\nend_header\n");
  for (int i = 0; i < 200000; ++i)
    bytes.add(static_cast<float>(i), static_cast<float>(-i), 0.5F, static_cast<std::uint8_t>(i));
  const auto read_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return read(bytes.str()).cloud;
  };
  const PointCloud one = read_with(1);
  const PointCloud many = read_with(8);
  EXPECT_EQ(one.positions, many.positions);
  EXPECT_EQ(one.positions[199999], (Point{199999, -199999, 0.5}));
  EXPECT_EQ(many.attributes[0].value(257), 1.0);
}

class Counter : public Progress {
 public:
  void advance(std::uint64_t units) override { done += units; }
  std::atomic<std::uint64_t> done = 0;
};

TEST(Ply, ReportsEveryByte) {
  const std::string properties =
      "element vertex 1\n" + xyz + "element face 1\nproperty list uchar int p\nend_header\n";
  const std::string ascii = ascii_start + properties + "1 2 3\n1 5\n";
  const std::string binary =
      test::Bytes(binary_start + properties).add(1.0F, 2.0F, 3.0F, std::uint8_t{1}, 5).str();
  for (const std::string& text : {ascii, binary}) {
    Counter counter;
    (void)read_ply({"a.ply", text}, counter);
    EXPECT_EQ(counter.done, text.size());
  }
}

TEST(Ply, IsRecognised) {
  const auto match = [](std::string_view bytes) { return match_ply({"a", bytes}); };
  EXPECT_EQ(match("ply\nformat"), Format::Match::Strong);
  EXPECT_EQ(match("\xEF\xBB\xBFply \r\nformat"), Format::Match::Strong);
  EXPECT_EQ(match("ply\r"), Format::Match::Strong);
  EXPECT_EQ(match("plywood"), Format::Match::No);
  EXPECT_EQ(match("ply 1 2"), Format::Match::No);
  EXPECT_EQ(match(""), Format::Match::No);
}

}  // namespace
}  // namespace keenline
