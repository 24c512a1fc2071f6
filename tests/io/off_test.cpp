#include "keenline/io/off.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using test::expect_error;

Reading read(std::string_view text) { return read_off({"a.off", text}, no_progress()); }

template <typename... Parts>
void expect_refusal(std::string_view text, const Parts&... parts) {
  expect_error<InputError>([&] { (void)read(text); }, "a.off: ", parts...);
}

template <typename T>
std::vector<T> values_of(const PointCloud& cloud, std::string_view name) {
  const Column* const column = cloud.attribute(name);
  if (column == nullptr || column->type() != scalar_type_of<T>()) {
    ADD_FAILURE() << "no attribute " << name << " of that type";
    return {};
  }
  return {column->values<T>().begin(), column->values<T>().end()};
}

std::vector<std::vector<std::int32_t>> faces_of(const PointCloud& cloud) {
  std::vector<std::vector<std::int32_t>> faces;
  const Column& column = cloud.tables.at(0).columns.at(0);
  const auto values = column.values<std::int32_t>();
  for (std::size_t i = 0; i < column.rows(); ++i)
    faces.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(column.offsets()[i]),
                       values.begin() + static_cast<std::ptrdiff_t>(column.offsets()[i + 1]));
  return faces;
}

constexpr std::string_view triangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1.5 -2e3\n3 0 1 2\n";
const std::vector<Point> triangle_points{{0, 0, 0}, {1, 0, 0}, {0, 1.5, -2000}};

TEST(Off, ReadsVerticesAndFaces) {
  const Reading reading = read(triangle);
  EXPECT_EQ(reading.format, "off");
  EXPECT_EQ(reading.encoding, "ascii OFF");
  EXPECT_TRUE(reading.notes.empty());
  EXPECT_EQ(reading.cloud.positions, triangle_points);
  EXPECT_EQ(reading.cloud.position_types[0], ScalarType::Float64);
  EXPECT_TRUE(reading.cloud.attributes.empty());
  ASSERT_EQ(reading.cloud.tables.size(), 1U);
  EXPECT_EQ(reading.cloud.tables[0].name, "face");
  EXPECT_EQ(faces_of(reading.cloud), (std::vector<std::vector<std::int32_t>>{{0, 1, 2}}));
}

TEST(Off, ReadsEveryWayToWriteTheHeader) {
  const std::string body = "0 0 0\n1 0 0\n0 1.5 -2e3\n3 0 1 2\n";
  for (const char* const header :
       {"OFF 3 1 0\n", "OFF3 1 0\n", "OFF\n3 1\n", "OFF # a\n#b\n\n 3\t1 0 # c\n", "3 1 0\n"}) {
    const Reading reading = read(header + body);
    EXPECT_EQ(reading.cloud.positions, triangle_points) << header;
    EXPECT_EQ(faces_of(reading.cloud).size(), 1U) << header;
  }
  EXPECT_EQ(read("3 1 0\n" + body).notes, std::vector<std::string>{"the header word OFF is missing"});
  EXPECT_EQ(read("# made by\n#\nOFF #hand\n3 1\n" + body).cloud.comments,
            (std::vector<std::string>{"made by", "hand"}));
}

TEST(Off, ReadsOddButValidText) {
  const std::string_view windows =
      "\xEF\xBB\xBFOFF\r\n\r\n# comment\r\n3 1 0\r\n0 0 0 # zero\r\n\r\n1 0 0\r\n# more\r\n0 1.5 "
      "-2e3\r\n#\r\n3 0 1 2";
  EXPECT_EQ(read(windows).cloud.positions, triangle_points);
  EXPECT_EQ(faces_of(read(windows).cloud).size(), 1U);
  EXPECT_EQ(read("OFF\r3 1 0\r0 0 0\r1 0 0\r0 1.5 -2e3\r3 0 1 2\r").cloud.positions, triangle_points);
}

TEST(Off, ReadsNoPointsAndPointsThatAreNotFinite) {
  EXPECT_EQ(read("OFF\n0 0 0\n").cloud.size(), 0U);
  EXPECT_TRUE(read("OFF\n0 0 0").cloud.tables.empty());
  const PointCloud cloud = read("OFF 1 0 0\nnan inf -INF").cloud;
  EXPECT_TRUE(std::isnan(cloud.positions.at(0)[0]));
  EXPECT_EQ(cloud.positions.at(0)[1], HUGE_VAL);
  EXPECT_EQ(cloud.positions.at(0)[2], -HUGE_VAL);
}

TEST(Off, ReadsFacesOfAnyLength) {
  EXPECT_EQ(faces_of(read("OFF 2 4 0\n0 0 0\n1 0 0\n0\n1 1\n2 1 0\n5 0 1 0 1 0\n").cloud),
            (std::vector<std::vector<std::int32_t>>{{}, {1}, {1, 0}, {0, 1, 0, 1, 0}}));
}

TEST(Off, KeepsNormalsColoursAndTextureCoordinatesInThisOrder) {
  const PointCloud cloud =
      read("STCNOFF\n2 0 0\n1 2 3  0 0 1  10 20 255  .5 .25\n4 5 6  1 0 0  0 0 0  1 0\n").cloud;
  EXPECT_EQ(cloud.positions, (std::vector<Point>{{1, 2, 3}, {4, 5, 6}}));
  ASSERT_EQ(cloud.attributes.size(), 8U);
  EXPECT_EQ(values_of<double>(cloud, "nx"), (std::vector<double>{0, 1}));
  EXPECT_EQ(values_of<double>(cloud, "nz"), (std::vector<double>{1, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(cloud, "red"), (std::vector<std::uint8_t>{10, 0}));
  EXPECT_EQ(values_of<std::uint8_t>(cloud, "blue"), (std::vector<std::uint8_t>{255, 0}));
  EXPECT_EQ(values_of<double>(cloud, "s"), (std::vector<double>{.5, 1}));
  EXPECT_EQ(values_of<double>(cloud, "t"), (std::vector<double>{.25, 0}));
  EXPECT_EQ(read("CSTOFF 1 0\n0 0 0 1 2 3 4 0 1\n").cloud.attributes.size(), 6U);
}

TEST(Off, KeepsColoursAsBytesOnlyWhenAllAreIntegers) {
  const auto type_of_red = [](std::string_view vertices) {
    return read(fmt::format("COFF 2 0 0\n{}\n", vertices)).cloud.attribute("red")->type();
  };
  EXPECT_EQ(type_of_red("0 0 0 1 2 3\n0 0 0 255 0 0"), ScalarType::UInt8);
  EXPECT_EQ(type_of_red("0 0 0 1.0 0 0\n0 0 0 1 1 1"), ScalarType::Float64);
  EXPECT_EQ(type_of_red("0 0 0 1 0 0\n0 0 0 1 1.0 1"), ScalarType::Float64);
  EXPECT_EQ(type_of_red("0 0 0 1 0 0\n0 0 0 1 1 0.5"), ScalarType::Float64);
  EXPECT_EQ(type_of_red("0 0 0 1 0 0\n0 0 0 1 1 256"), ScalarType::Float64);
  EXPECT_EQ(values_of<std::uint8_t>(read("COFF 1 0 0\n0 0 0 1 2 3 4\n").cloud, "alpha"),
            std::vector<std::uint8_t>{4});
}

TEST(Off, KeepsColumnsWithoutNamesAndTheHomogeneousCoordinate) {
  const PointCloud cloud = read("OFF 2 0 0\n0 0 0 7 8\n0 0 1 -9 .5\n").cloud;
  EXPECT_EQ(values_of<std::int32_t>(cloud, "column_4"), (std::vector<std::int32_t>{7, -9}));
  EXPECT_EQ(values_of<double>(cloud, "column_5"), (std::vector<double>{8, .5}));

  const Reading homogeneous = read("4OFF 1 0 0\n2 4 6 2\n");
  EXPECT_EQ(homogeneous.cloud.positions, (std::vector<Point>{{2, 4, 6}}));
  EXPECT_EQ(values_of<double>(homogeneous.cloud, "w"), std::vector<double>{2});
  EXPECT_EQ(homogeneous.notes.size(), 1U);
}

TEST(Off, NotesTheColoursOfFaces) {
  const Reading reading = read("OFF 1 5 0\n0 0 0\n1 0\n1 0 7\n1 0 .1 .2 .3\n1 0 1 2 3 4\n1 0 # no colour\n");
  EXPECT_EQ(reading.notes, std::vector<std::string>{"the colours of 3 faces are not kept"});
  EXPECT_EQ(faces_of(reading.cloud).size(), 5U);
}

TEST(Off, RefusesWrongHeaders) {
  expect_refusal("", "the end of the file", "OFF");
  expect_refusal("# only a comment\n", "line 1", "the end of the file");
  expect_refusal("\nPLY\n", "line 2", "'PLY'");
  expect_refusal("OFFICE\n1 0 0\n", "line 1", "'OFFICE'");
  expect_refusal("NCOFF\n", "'NCOFF'");
  expect_refusal("nOFF\n4\n", "'nOFF'", "3 coordinates");
  expect_refusal("OFF BINARY\n", "binary OFF", "ascii");
  expect_refusal("OFF\n", "line 1", "the end of the file", "numbers of vertices");
}

TEST(Off, RefusesWrongCounts) {
  expect_refusal("OFF\n-1 0 0\n", "line 2", "'-1'", "the number of vertices");
  expect_refusal("OFF\n1 x 0\n", "line 2", "'x'", "the number of faces");
  expect_refusal("OFF\n1\n0 0 0\n", "line 2", "the end of the line", "the number of faces");
  expect_refusal("OFF\n0 0 x\n", "'x'", "the number of edges");
  expect_refusal("OFF\n0 0 0 0\n", "line 2", "'0'", "the end of the line");
  for (const char* const count : {"2", "2147483648", "4294967306", "9223372036854775808", "1e30"})
    expect_refusal(fmt::format("OFF\n{} 0 0\n0 0 0\n", count), "line 2");
  for (const char* const count : {"4", "2147483648", "9223372036854775808"})
    expect_refusal(fmt::format("OFF\n1 {} 0\n0 0 0\n", count), "line 2");
  expect_refusal("OFF\n1 4 0\n0 0 0\n", "1 vertices and 4 faces", "6 bytes");
}

TEST(Off, RefusesWrongVertices) {
  expect_refusal("OFF 2 0\n0 0 0\n1 abc 0\n", "line 3", "'abc'");
  expect_refusal("OFF 2 0\n0 0 0\n1 2    \n\n\n\n", "line 3");
  expect_refusal("OFF 2 0\n0 0 0\n1 2 3 4\n", "line 3");
  expect_refusal("OFF 1 0\n0 0     \n", "line 2", "2 numbers", "3 (x y z)");
  expect_refusal("NOFF 1 0\n0 0 0\n", "line 2", "3 numbers", "6 (x y z nx ny nz)");
  expect_refusal("COFF 1 0\n0 0 0 1 2 3 4 5\n", "line 2", "8 numbers", "6 (x y z red green blue)");
  expect_refusal("OFF 3 0\n0.0 0.0 0.0\n0.0 0.0 0.0\n", "the end of the file");
}

TEST(Off, RefusesWrongFaces) {
  const std::string two = "OFF 2 1\n0 0 0\n1 0 0\n";
  expect_refusal(two + "3 0 1 2\n", "line 4", "'2'", "a vertex number from 0 to 1");
  expect_refusal(two + "2 0 -1\n", "line 4", "'-1'", "a vertex number from 0 to 1");
  expect_refusal(two + "2 0 4294967296\n", "line 4", "'4294967296'");
  expect_refusal(two + "3 0 1\n", "line 4", "the end of the line");
  expect_refusal(two + "18446744073709551615 0 1\n", "line 4", "the end of the line");
  expect_refusal(two + "-1 0 1\n", "line 4", "'-1'", "vertices");
  expect_refusal(two + "1 0 red\n", "line 4", "'red'", "colour");
  expect_refusal(two + "1 0 1 2 3 4 5\n", "line 4", "'5'", "the end of the line");
  expect_refusal(two + "# nothing\n", "line 4", "the end of the file", "face 1 of 1");
  expect_refusal(two + "1 0\n# fine\n1 1\n", "line 6", "'1 1'", "2 vertices and 1 faces");
  expect_refusal("OFF 0 1\n1 0\n", "line 2", "'0'", "no vertices");
}

TEST(Off, RefusesEveryTruncationThatLosesAWord) {
  // Cut inside the last word, a shorter number remains, which nothing gives away.
  const std::size_t last_word = triangle.rfind(' ') + 1;
  for (std::size_t size = 0; size < last_word; ++size) expect_refusal(triangle.substr(0, size), "found");
}

TEST(Off, StopsWhenCancelled) {
  struct Stopped : Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } stopped;
  EXPECT_THROW((void)read_off({"a.off", triangle}, stopped), Cancelled);
}

TEST(Off, IsRecognisedByItsHeaderWord) {
  const auto match = [](std::string_view text) { return match_off({"a", text}); };
  EXPECT_EQ(match(triangle), Format::Match::Strong);
  EXPECT_EQ(match("\xEF\xBB\xBF# x\r\n\r\nCOFF\r\n"), Format::Match::Strong);
  EXPECT_EQ(match("OFF490 518 0\n"), Format::Match::Strong);
  EXPECT_EQ(match("OFF BINARY\n"), Format::Match::Strong);
  EXPECT_EQ(match("OFFICE\n"), Format::Match::No);
  EXPECT_EQ(match("3 1 0\n"), Format::Match::No);
  EXPECT_EQ(match(""), Format::Match::No);
}

}  // namespace
}  // namespace keenline
