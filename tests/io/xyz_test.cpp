#include "keenline/io/xyz.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using namespace std::string_literals;

Reading read(std::string_view text) { return read_xyz({"cloud.xyz", text}, no_progress()); }

template <typename... Parts>
void expect_refused(std::string_view text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "cloud.xyz: ", parts...);
}

std::vector<std::string> names_of(const PointCloud& cloud) {
  std::vector<std::string> names;
  for (const Column& column : cloud.attributes) names.push_back(column.name());
  return names;
}

using Points = std::vector<Point>;
using Strings = std::vector<std::string>;
const Points two_points{{1, 2, 3}, {4, 5, 6.5}};

TEST(Xyz, ReadsEveryDelimiter) {
  for (const char* text :
       {"1 2 3\n4 5 6.5\n", "1\t2\t3\n4\t5\t6.5\n", "1,2,3\n4,5,6.5\n", "1, 2 ,3\n4 ,5 ,6.5\n",
        "1 ,2 ,3\n4,5,6.5\n", "1,2 ,3\n4,5,6.5\n", "1;2;3\n4 ; 5;6.5\n", "1 2\t3\n  4\t 5 6.5 \n"})
    EXPECT_EQ(read(text).cloud.positions, two_points) << text;
}

TEST(Xyz, ReadsWhatIsOddButValid) {
  for (const std::string& text :
       {"1 2 3\r\n4 5 6.5\r\n"s, "1 2 3\r4 5 6.5"s, "\xEF\xBB\xBF"s + "1 2 3\n4 5 6.5"s,
        "\n\n1 2 3\n \t\n4 5 6.5\n\n"s, "# a\n1 2 3 # b\n// c\n4 5 6.5//d\n"s, "1,2,3,\n4,5,6.5,\n"s,
        "x,y,z,\n1,2,3,\n4,5,6.5,\n"s, "x,y,z\n1,2,3,\n4,5,6.5,\n"s, "x,y,z,\n1,2,3\n4,5,6.5\n"s,
        "\"1\",\"2\",\"3\"\n4,5,\"6.5\"\n"s, "\xEF\xBB\xBF\"x\",\"y\",\"z\"\r\n1,2,3\r\n4,5,6.5\r\n"s,
        "x;y;z\n1;2;3\n4;5;6.5\n"s, "x, y, z\n1 2 3\n4 5 6.5\n"s, "+1 2.0 3e0\n4 5 .65e1\n"s})
    EXPECT_EQ(read(text).cloud.positions, two_points) << text;
}

TEST(Xyz, ReadsNotFiniteCoordinates) {
  const Reading reading = read("nan NaN -nan\ninf -INF Infinity\n");
  ASSERT_EQ(reading.cloud.size(), 2U);
  for (const double value : reading.cloud.positions[0]) EXPECT_TRUE(std::isnan(value));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(reading.cloud.positions[1], (Point{infinity, -infinity, infinity}));
}

TEST(Xyz, NumbersColumnsWithoutAHeader) {
  const Reading reading = read("1 2 3 7 0.5\n4 5 6.5 8 9\n");
  EXPECT_EQ(names_of(reading.cloud), (Strings{"column_4", "column_5"}));
  EXPECT_EQ(reading.cloud.attributes[0].type(), ScalarType::Int32);
  EXPECT_EQ(reading.cloud.attributes[0].value(1), 8);
  EXPECT_EQ(reading.cloud.attributes[1].type(), ScalarType::Float64);
  EXPECT_EQ(reading.cloud.attributes[1].value(0), 0.5);
  EXPECT_EQ(reading.encoding, "blank-separated text");
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Xyz, FindsCoordinatesByName) {
  const Reading reading = read("id,Z,\"Y\",note \"\"2\"\",X\n10,3,2,0.5,1\n11,6.5,5,1,4\n");
  EXPECT_EQ(reading.cloud.positions, two_points);
  EXPECT_EQ(names_of(reading.cloud), (Strings{"id", "note \"\"2\"\""}));
  EXPECT_EQ(reading.cloud.attribute("id")->type(), ScalarType::Int32);
  EXPECT_EQ(reading.encoding, "comma-separated text with a header line");
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Xyz, NamesInQuotesMayHoldAnything) {
  const Reading reading = read("x,y,z,\"a,b;c\",\"# // d\",\"say \"\"e\"\"\"\n1,2,3,4,5,6\n");
  EXPECT_EQ(names_of(reading.cloud), (Strings{"a,b;c", "# // d", "say \"e\""}));
}

TEST(Xyz, NamesWithBlanksBetweenTabs) {
  const Reading reading = read("point id\tx\ty\tz\n7\t1\t2\t3\n8\t4\t5\t6.5\n");
  EXPECT_EQ(reading.cloud.positions, two_points);
  EXPECT_EQ(names_of(reading.cloud), Strings{"point id"});
}

TEST(Xyz, AnEmptyNameGetsANumber) {
  EXPECT_EQ(names_of(read(",x,y,z\n0,1,2,3\n").cloud), Strings{"column_1"});
}

TEST(Xyz, KnowsTheWordsOfSurveyors) {
  const Reading reading = read("Easting Northing Height\n1 2 3\n4 5 6.5\n");
  EXPECT_EQ(reading.cloud.positions, two_points);
  EXPECT_EQ(reading.notes, (Strings{"column 'Easting' is read as x", "column 'Northing' is read as y",
                                    "column 'Height' is read as z"}));
  EXPECT_EQ(names_of(read("elevation x y z\n9 1 2 3\n").cloud), Strings{"elevation"});
  expect_refused("x y height altitude\n1 2 3 4\n", "line 1", "'height' and 'altitude'", "one column for z");
}

TEST(Xyz, ReadsNamesFromACommentBeforeTheData) {
  for (const char* text :
       {"//X Y Z R\n1 2 3 255\n4 5 6.5 0\n", "# by hand\n# x,y,z,R\n1 2 3 255\n4 5 6.5 0\n",
        "//R X Y Z\n2\n255 1 2 3\n0 4 5 6.5\n"}) {
    const Reading reading = read(text);
    EXPECT_EQ(reading.cloud.positions, two_points) << text;
    EXPECT_EQ(names_of(reading.cloud), Strings{"R"}) << text;
    EXPECT_EQ(reading.encoding, "blank-separated text with names in a comment");
  }
  EXPECT_EQ(read("# by hand\n# x y z\n1 2 3\n").cloud.comments, Strings{"by hand"});
}

TEST(Xyz, ACommentWithOtherNamesIsAComment) {
  const Reading reading = read("# x y z of the scan\n1 2 3 7\n");
  EXPECT_EQ(names_of(reading.cloud), Strings{"column_4"});
  EXPECT_EQ(reading.cloud.comments, Strings{"x y z of the scan"});
}

TEST(Xyz, ReadsACountOfPoints) {
  const Reading reading = read("2\n1 2 3 -5\n4 5 6.5 7\n");
  EXPECT_EQ(reading.cloud.positions, two_points);
  EXPECT_EQ(reading.notes, Strings{"line 1 is read as the number of points"});
  EXPECT_EQ(read("0\n").cloud.size(), 0U);
  expect_refused("3\n1 2 3\n4 5 6\n", "line 1", "a count of 3 points", "2,");
  expect_refused("1\n1 2 3\n4 5 6\n", "line 1", "a count of 1 points", "2,");
  expect_refused("18446744073709551616\n1 2 3\n", "line 1", "a count of 18446744073709551616 points");
  expect_refused("5\n6\n7\n", "line 2", "1 value,", "at least 3");
}

TEST(Xyz, IntegerColumnsGetTheTypeThatHoldsThem) {
  const PointCloud cloud = read("x,y,z,a,b,c,d\n1,2,3,-1,4294967296,18446744073709551615,1.0\n").cloud;
  EXPECT_EQ(cloud.attribute("a")->type(), ScalarType::Int32);
  EXPECT_EQ(cloud.attribute("b")->values<std::int64_t>()[0], 4294967296);
  EXPECT_EQ(cloud.attribute("c")->values<std::uint64_t>()[0], std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(cloud.attribute("d")->type(), ScalarType::Float64);
}

TEST(Xyz, SaysWhenIntegersAreRounded) {
  const Reading reading = read("1 2 3 9007199254740993\n1 2 3 0.5\n");
  EXPECT_EQ(reading.notes, Strings{"column 'column_4': 1 integers were rounded to 64-bit floats"});
}

TEST(Xyz, NoRowsAreNoPoints) {
  const Reading header_only = read("x,y,z,intensity\n");
  EXPECT_EQ(header_only.cloud.size(), 0U);
  EXPECT_EQ(names_of(header_only.cloud), Strings{"intensity"});
  const Reading comments_only = read("# nothing\n\n");
  EXPECT_EQ(comments_only.cloud.size(), 0U);
  EXPECT_EQ(comments_only.cloud.comments, Strings{"nothing"});
}

TEST(Xyz, RefusesAnEmptyFile) {
  for (const char* text : {"", "\n", " \t\r\n \n", "\xEF\xBB\xBF"})
    expect_refused(text, "found an empty file");
}

TEST(Xyz, RefusesOtherEncodings) {
  expect_refused("\xFF\xFE" + "1\0 \0002\0"s, "byte 0", "UTF-16 text", "UTF-8");
  expect_refused("\xFE\xFF"s + "\0001"s, "byte 0", "UTF-16 text");
  expect_refused("1 2 3\n4 \0 6\n"s, "line 2", "a zero byte");
  expect_refused("\0\0\0"s, "line 1", "a zero byte");
  expect_refused("# c\n1 2\0 3\n"s, "line 2", "a zero byte");
}

TEST(Xyz, RefusesDecimalCommas) {
  for (const char* text : {"1,5;2,5;3,5\n", "1,5 2,5 3,5\n", "1,5\t2\t3,5\n", "x;y;z\n1,5;2,5;3,5\n"})
    expect_refused(text, "'1,5'", "a number with a decimal point");
  expect_refused("x;y;z\n1;2;3\n1;2,5;3\n", "line 3", "'2,5' in column 'y'", "a number with a decimal point");
}

TEST(Xyz, RefusesRaggedRows) {
  expect_refused("1 2 3\n4 5\n", "line 2", "2 values", "3 (x, y, z)");
  expect_refused("1 2 3\n4 5 6 7\n", "line 2", "4 values", "3 (x, y, z)");
  expect_refused("x,y,z,i\n1,2,3\n", "line 2", "3 values", "4 (x, y, z, …)");
  expect_refused("x,y,z,i\n1,2,3,\n", "line 2", "an empty field in column 'i'");
  expect_refused("x y z\n1 2 3 4\n", "line 2", "4 values", "3");
  expect_refused("1,2,3\n4,5,6,\n", "line 2", "4 values");
  expect_refused("1,2,3,\n4,5,6\n", "line 2", "no ',' at the end");
}

TEST(Xyz, RefusesFewerThanThreeColumns) {
  expect_refused("1 2\n3 4\n", "line 1", "2 values", "at least 3 (x, y, z)");
  expect_refused("1.5\n", "line 1", "1 value,", "at least 3 (x, y, z)");
  expect_refused("1,2,\n", "line 1", "2 values");
}

TEST(Xyz, RefusesWordsAmongNumbers) {
  expect_refused("1 2 3 car\n4 5 6 bus\n", "line 1", "'car' in column 'column_4'", "a number");
  expect_refused("x,y,z,label\n1,2,3,car\n", "line 2", "'car' in column 'label'");
  expect_refused("1 2 abc\n", "line 1", "'abc' in column 'z'");
  expect_refused("1 2 3\n4 5 1e999\n", "line 2", "'1e999' in column 'z'");
  expect_refused("1e999 2 3\n", "line 1", "'1e999' in column 'x'");
}

TEST(Xyz, RefusesAHeaderWithoutCoordinates) {
  expect_refused("lon,lat,depth\n1,2,3\n", "line 1", "'lon', 'lat', 'depth'", "x, y and z");
  expect_refused("hello\n", "line 1", "'hello'");
  expect_refused("x,y\n1,2\n", "line 1", "'x', 'y'");
  expect_refused("a\x1b[31m b c\n", "line 1", "'a\\x1b[31m'");
}

TEST(Xyz, RefusesNamesThatAreThereTwice) {
  expect_refused("x,y,z,i,i\n1,2,3,4,5\n", "line 1", "two columns 'i'");
  expect_refused("x,y,z,X\n1,2,3,4\n", "line 1", "'x' and 'X'", "one column for x");
}

TEST(Xyz, RefusesALineWithoutEnd) {
  expect_refused(std::string(33U << 20U, 'a'), "line 1", "a line of more than 32 MiB");
  expect_refused("1 2 3" + std::string(33U << 20U, '\0'), "line 1", "a zero byte");
}

TEST(Xyz, MatchesWhatLooksLikeNumbers) {
  const auto match = [](std::string_view text) { return match_xyz({"a", text}); };
  for (const char* text : {"1 2 3\n", "# c\n\n1,2,3\n", "x y z\n1 2 3\n", "//X;Y;Z\n5\n1;2;3;\n", "1 2 3"})
    EXPECT_EQ(match(text), Format::Match::Weak) << text;
  for (const char* text :
       {"", "hello\n", "1 2\n3 4\n", "v 1 2 3\nv 4 5 6\nv 7 8 9\n1 2 3\n", "a\nb\nc\n1 2 3\n"})
    EXPECT_EQ(match(text), Format::Match::No) << text;
  EXPECT_EQ(match("1 2 3\n\0"s), Format::Match::No);
}

TEST(Xyz, EveryTruncationIsReadOrRefused) {
  const std::string text = "\xEF\xBB\xBF// c\r\nx;y;z;\"a;b\";\r\n1;2;3;4;\r\n5;6;7;8; # d\r\n";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    try {
      EXPECT_LE(read(text.substr(0, size)).cloud.size(), 2U);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace keenline
