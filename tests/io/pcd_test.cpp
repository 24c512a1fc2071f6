#include "keenline/io/pcd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using namespace std::string_literals;
using Points = std::vector<Point>;
using Strings = std::vector<std::string>;

Reading read(std::string_view text) { return read_pcd({"cloud.pcd", text}, no_progress()); }

template <typename... Parts>
void expect_refused(std::string_view text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "cloud.pcd: ", parts...);
}

std::string header(std::string_view fields, std::string_view size, std::string_view type,
                   std::string_view count, std::size_t points, std::string_view data) {
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {}\nSIZE {}\nTYPE {}\nCOUNT {}\nWIDTH "
      "{}\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA {}\n",
      fields, size, type, count, points, points, data);
}

std::string xyz_header(std::size_t points, std::string_view data) {
  return header("x y z", "4 4 4", "F F F", "1 1 1", points, data);
}

template <typename... T>
std::string packed(T... values) {
  std::string bytes;
  const auto append = [&](auto value) {
    char buffer[sizeof value];
    std::memcpy(buffer, &value, sizeof value);
    bytes.append(buffer, sizeof value);
  };
  (append(values), ...);
  return bytes;
}

/// LZF that repeats nothing.
std::string compressed(std::string_view bytes) {
  std::string result;
  for (; !bytes.empty(); bytes.remove_prefix(std::min<std::size_t>(32, bytes.size()))) {
    const std::string_view run = bytes.substr(0, 32);
    result += static_cast<char>(run.size() - 1);
    result += run;
  }
  return packed(static_cast<std::uint32_t>(result.size())) + result;
}

/// The body of a compressed file: sizes, data.
std::string compressed_body(std::string_view bytes) {
  std::string body = compressed(bytes);
  return body.insert(4, packed(static_cast<std::uint32_t>(bytes.size())));
}

// Two points with everything a record can hold: padding, a list, an unaligned double.
const std::string mixed_fields = "x _ y n z i";
const std::string mixed_sizes = "4 1 8 2 4 8";
const std::string mixed_types = "F U F I I U";
const std::string mixed_counts = "1 3 1 2 1 1";
constexpr std::uint8_t pad = 0xAA;
constexpr std::uint64_t big = std::numeric_limits<std::uint64_t>::max();

std::string mixed(std::string_view data) {
  return header(mixed_fields, mixed_sizes, mixed_types, mixed_counts, 2, data);
}

std::string mixed_records() {
  return packed(0.1F, pad, pad, pad, 0.1, std::int16_t{-1}, std::int16_t{2}, std::int32_t{-3}, big) +
         packed(4.0F, pad, pad, pad, 5.5, std::int16_t{3}, std::int16_t{-4}, std::int32_t{6},
                std::uint64_t{0});
}

std::string mixed_by_field() {
  return packed(0.1F, 4.0F) + std::string(6, '\xAA') + packed(0.1, 5.5) +
         packed(std::int16_t{-1}, std::int16_t{2}, std::int16_t{3}, std::int16_t{-4}) +
         packed(std::int32_t{-3}, std::int32_t{6}) + packed(big, std::uint64_t{0});
}

void expect_mixed(const Reading& reading) {
  const PointCloud& cloud = reading.cloud;
  EXPECT_EQ(cloud.positions, (Points{{static_cast<double>(0.1F), 0.1, -3}, {4, 5.5, 6}}));
  EXPECT_EQ(cloud.position_types, (std::array{ScalarType::Float32, ScalarType::Float64, ScalarType::Int32}));
  ASSERT_EQ(cloud.attributes.size(), 2U);
  const Column& list = cloud.attributes[0];
  EXPECT_EQ(list.name(), "n");
  ASSERT_TRUE(list.is_list());
  EXPECT_EQ(list.count_type(), ScalarType::UInt8);
  EXPECT_EQ(std::vector<std::uint64_t>(list.offsets().begin(), list.offsets().end()),
            (std::vector<std::uint64_t>{0, 2, 4}));
  const auto values = list.values<std::int16_t>();
  EXPECT_EQ(std::vector<std::int16_t>(values.begin(), values.end()),
            (std::vector<std::int16_t>{-1, 2, 3, -4}));
  EXPECT_EQ(cloud.attributes[1].name(), "i");
  EXPECT_EQ(cloud.attributes[1].values<std::uint64_t>()[0], big);
}

TEST(Pcd, ReadsAscii) {
  const Reading reading =
      read(mixed("ascii") + "0.1 0 0 0 0.1 -1 2 -3 18446744073709551615\n\n4 0 0 0 5.5 3 -4 6 0\n");
  expect_mixed(reading);
  EXPECT_EQ(reading.encoding, "ascii 0.7");
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Pcd, ReadsBinary) {
  const Reading reading = read(mixed("binary") + mixed_records());
  expect_mixed(reading);
  EXPECT_EQ(reading.encoding, "binary 0.7");
}

TEST(Pcd, ReadsBinaryCompressed) {
  const Reading reading = read(mixed("binary_compressed") + compressed_body(mixed_by_field()));
  expect_mixed(reading);
  EXPECT_EQ(reading.encoding, "binary compressed 0.7");
}

TEST(Pcd, ReadsCompressedRepetitions) {
  // Twelve zero bytes: one literal, then 11 bytes from 1 back.
  const std::string data = "\0\0\xe0\2\0"s;
  const std::string body = packed(static_cast<std::uint32_t>(data.size()), std::uint32_t{12}) + data;
  EXPECT_EQ(read(xyz_header(1, "binary_compressed") + body).cloud.positions, (Points{{0, 0, 0}}));
}

TEST(Pcd, NoPointsInAnyEncoding) {
  for (const std::string& body :
       {mixed("ascii"), mixed("ascii") + "\n", mixed("binary"), mixed("binary_compressed"),
        mixed("binary_compressed") + std::string(8, '\0')}) {
    std::string text = body;
    text.replace(text.find("WIDTH 2"), 7, "WIDTH 0");
    text.replace(text.find("POINTS 2"), 8, "POINTS 0");
    const PointCloud cloud = read(text).cloud;
    EXPECT_EQ(cloud.size(), 0U);
    ASSERT_EQ(cloud.attributes.size(), 2U);
    EXPECT_EQ(cloud.attributes[0].rows(), 0U);
  }
}

TEST(Pcd, KeepsRgbAndNotFiniteCoordinatesAsTheyAre) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const float rgb = 2.34e-38F;
  const Reading reading = read(header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, "binary") +
                               packed(nan, std::numeric_limits<float>::infinity(), 0.0F, rgb));
  EXPECT_TRUE(std::isnan(reading.cloud.positions[0][0]));
  EXPECT_TRUE(std::isinf(reading.cloud.positions[0][1]));
  EXPECT_EQ(reading.cloud.attribute("rgb")->values<float>()[0], rgb);
  EXPECT_TRUE(std::isnan(read(xyz_header(1, "ascii") + "nan NaN inf\n").cloud.positions[0][1]));
}

TEST(Pcd, SaysThatAGridIsReadAsAList) {
  const Reading reading = read(
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 2\nHEIGHT 2\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\n0 0 0\n");
  EXPECT_EQ(reading.cloud.size(), 4U);
  EXPECT_EQ(reading.notes, Strings{"the grid of 2 x 2 points is read as a list of points"});
  EXPECT_EQ(reading.encoding, "ascii");
}

TEST(Pcd, CarriesCommentsAndViewpoint) {
  std::string text = "# by hand\n" + xyz_header(0, "ascii");
  text.replace(text.find("VIEWPOINT 0"), 11, "VIEWPOINT 5");
  EXPECT_EQ(read(text).cloud.comments, (Strings{"by hand", "VIEWPOINT 5 0 0 1 0 0 0"}));
}

TEST(Pcd, ToleratesPaddingAfterTheData) {
  const std::string point = packed(1.0F, 2.0F, 3.0F);
  EXPECT_EQ(read(xyz_header(1, "binary") + point + "\n").cloud.size(), 1U);
  EXPECT_EQ(read(xyz_header(1, "binary") + point + std::string(4096, '\0')).cloud.size(), 1U);
  EXPECT_EQ(read(xyz_header(1, "ascii") + "1 2 3\n \n\n").cloud.size(), 1U);
  expect_refused(xyz_header(1, "binary") + point + std::string(65537, '\0'), "65537 more bytes",
                 "after 1 points");
}

TEST(Pcd, RefusesMoreDataThanDeclared) {
  const std::string binary = xyz_header(1, "binary");
  const std::string point = packed(1.0F, 2.0F, 3.0F);
  expect_refused(binary + point + point, fmt::format("byte {}:", binary.size() + 12), "12 more bytes",
                 "after 1 points");
  expect_refused(xyz_header(1, "ascii") + "1 2 3\n\n4 5 6\n", "line 14", "'4 5 6'",
                 "the end of the file after 1 points");
  expect_refused(xyz_header(0, "ascii") + "1 2 3\n", "line 12", "'1 2 3'", "after 0 points");
  const std::string packed_twice = xyz_header(1, "binary_compressed") + compressed_body(point) + "x";
  expect_refused(packed_twice, "1 more bytes");
}

TEST(Pcd, RefusesLessDataThanDeclared) {
  const std::string binary = xyz_header(2, "binary") + packed(1.0F, 2.0F, 3.0F, 4.0F, 5.0F) + "abc";
  expect_refused(binary, fmt::format("byte {}:", binary.size()),
                 "the end of the file, with room for at most 1 points", "2 points, as line 10 declares");
  expect_refused(xyz_header(2, "ascii") + "1.25 2.25 3.25\n4 5", "line 13", "2 values", "3 (x, y, z)");
  expect_refused(xyz_header(2, "ascii") + "1.25 2.25 3.25\n", "line 12", "the end of the file after 1 rows",
                 "2 rows");
  expect_refused(xyz_header(4'000'000'000, "ascii") + "1 2 3\n", "room for at most 1 points",
                 "4000000000 points");
  expect_refused(xyz_header(4'000'000'000, "binary"), "room for at most 0 points", "4000000000 points");
}

TEST(Pcd, ALargeRecordOfASmallFileIsNotAllocated) {
  expect_refused(header("x y z a", "1 1 1 1", "U U U U", "1 1 1 1048573", 1, "ascii") + "1 2 3\n",
                 "room for at most 0 points");
}

TEST(Pcd, RefusesCompressedSizesThatLie) {
  const std::string text = xyz_header(1, "binary_compressed");
  const auto place = [&](std::size_t offset) { return fmt::format("byte {}:", text.size() + offset); };
  expect_refused(text, place(0), "the end of the file", "the sizes");
  expect_refused(text + packed(std::uint32_t{13}), place(4), "the sizes");
  expect_refused(text + packed(std::uint32_t{100}, std::uint32_t{12}) + "abc", place(11), "after 3 bytes",
                 "100 bytes");
  expect_refused(text + packed(std::uint32_t{3}, std::uint32_t{24}) + "abc", place(4),
                 "24 bytes of uncompressed data", "12 (1 points of 12 bytes)");
  expect_refused(text + packed(std::uint32_t{4}, std::uint32_t{12}) + "\3abc"s, place(8),
                 "literal bytes past the end", "12 bytes of LZF-compressed data");
  expect_refused(text + packed(std::uint32_t{2}, std::uint32_t{12}) + "\0a"s, place(10),
                 "less data than declared");
  const std::string many = xyz_header(300'000'000, "binary_compressed");
  expect_refused(many + packed(std::uint32_t{2}, std::uint32_t{0xFFFFFFFF}) + "\0a"s,
                 "4294967295 bytes of uncompressed data", "3600000000");
  expect_refused(many + packed(std::uint32_t{2}, std::uint32_t{3600000000}) + "\0a"s,
                 fmt::format("byte {}:", many.size()), "2 bytes of compressed data",
                 "enough for 3600000000 bytes");
}

TEST(Pcd, RefusesNumbersThatDoNotFitTheirField) {
  expect_refused(header("x y z r", "4 4 4 1", "F F F U", "1 1 1 1", 1, "ascii") + "1 2 3 256\n", "line 12",
                 "'256' in column 'r'", "an integer from 0 to 255");
  expect_refused(header("x y z i", "4 4 4 4", "F F F F", "1 1 1 1", 1, "ascii") + "1 2 3 1e39\n", "line 12",
                 "'1e39' in column 'i'", "32-bit float");
  expect_refused(xyz_header(1, "ascii") + "1 2 3,5\n", "line 12", "'3,5'", "a decimal point");
}

TEST(Pcd, RefusesCoordinatesThatADoubleCannotHold) {
  const std::string text = header("x y z", "8 8 8", "I I U", "1 1 1", 2, "binary");
  constexpr std::int64_t two_to_53 = std::int64_t{1} << 53U;
  const std::string good = packed(two_to_53, -two_to_53, std::uint64_t{1} << 60U);
  EXPECT_EQ(read(text + good + good).cloud.positions[1], (Point{0x1p53, -0x1p53, 0x1p60}));
  expect_refused(text + good + packed(std::int64_t{0}, two_to_53 + 1, std::uint64_t{0}),
                 "y = 9007199254740993 at point 1", "a number that a double holds exactly");
}

TEST(Pcd, EveryTruncationIsRefused) {
  for (const std::string& text :
       {mixed("ascii") + "0.1 0 0 0 0.1 -1 2 -3 18446744073709551615\n4 0 0 0 5.5 3 -4 6 0",
        mixed("binary") + mixed_records(), mixed("binary_compressed") + compressed_body(mixed_by_field())}) {
    expect_mixed(read(text));
    for (std::size_t size = 0; size < text.size(); ++size)
      EXPECT_THROW((void)read(text.substr(0, size)), InputError) << size;
  }
}

TEST(Pcd, EveryFlippedBitIsReadOrRefused) {
  const std::string text = mixed("binary_compressed") + compressed_body(mixed_by_field());
  for (std::size_t i = 0; i < 8 * text.size(); ++i) {
    std::string flipped = text;
    flipped[i / 8] = static_cast<char>(flipped[i / 8] ^ (1 << (i % 8)));
    try {
      EXPECT_EQ(read(flipped).cloud.size(), 2U);
    } catch (const InputError&) {
    }
  }
}

TEST(Pcd, MatchesItsFirstLine) {
  const auto match = [](std::string_view text) { return match_pcd({"a", text}); };
  for (const char* text : {"# .PCD v.7 - Point Cloud Data file format\n", "#.PCD", "VERSION .7\n",
                           "\n# c\nFIELDS x y z\n", "COLUMNS x y z", "\xEF\xBB\xBFVERSION 0.7\r\n"})
    EXPECT_EQ(match(text), Format::Match::Strong) << text;
  for (const char* text : {"", "# c\n", "VERSIONS\n", "1 2 3\n", "ply\nVERSION 0.7\n"})
    EXPECT_EQ(match(text), Format::Match::No) << text;
}

}  // namespace
}  // namespace keenline
