#include "keenline/io/pcd_header.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using namespace std::string_literals;

const std::string usual =
    "# .PCD v0.7 - Point Cloud Data file format\n"  // line 1
    "VERSION 0.7\n"
    "FIELDS x y z rgb\n"
    "SIZE 4 8 2 4\n"
    "TYPE F F I U\n"  // line 5
    "COUNT 1 1 1 3\n"
    "WIDTH 5\n"
    "HEIGHT 2\n"
    "VIEWPOINT 0 0 0 1 0 0 0\n"
    "POINTS 10\n"  // line 10
    "DATA ascii\n";

PcdHeader read(std::string_view text) { return read_pcd_header({"cloud.pcd", text}); }

/// `usual` with one line (without its end) replaced; an empty replacement leaves it out.
std::string with(std::string_view line, const std::string& replacement) {
  std::string text = usual;
  const std::size_t start = text.find(std::string(line) + '\n');
  EXPECT_NE(start, std::string::npos) << line;
  return text.replace(start, line.size() + 1, replacement.empty() ? "" : replacement + '\n');
}

template <typename... Parts>
void expect_refused(std::string_view text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "cloud.pcd: ", parts...);
}

TEST(PcdHeader, ReadsEveryLine) {
  const PcdHeader header = read(usual + "1 2 3");
  EXPECT_EQ(header.version, "0.7");
  ASSERT_EQ(header.fields.size(), 4U);
  EXPECT_EQ(header.fields[0].name, "x");
  EXPECT_EQ(header.fields[0].type, ScalarType::Float32);
  EXPECT_EQ(header.fields[1].type, ScalarType::Float64);
  EXPECT_EQ(header.fields[2].type, ScalarType::Int16);
  EXPECT_EQ(header.fields[3].type, ScalarType::UInt32);
  EXPECT_EQ(header.fields[3].count, 3U);
  EXPECT_EQ(header.record_bytes, 26U);
  EXPECT_EQ(header.record_values, 6U);
  EXPECT_EQ(header.points, 10U);
  EXPECT_EQ(header.points_line, 10U);
  EXPECT_EQ(header.width, 5U);
  EXPECT_EQ(header.height, 2U);
  EXPECT_EQ(header.encoding, PcdEncoding::Ascii);
  EXPECT_TRUE(header.comments.empty());
  EXPECT_EQ(header.body_offset, usual.size());
  EXPECT_EQ(header.body_line, 12U);
}

TEST(PcdHeader, ReadsWhatIsOddButValid) {
  EXPECT_EQ(read(with("VERSION 0.7", "VERSION .5")).version, "0.5");
  EXPECT_EQ(read(with("VERSION 0.7", "")).version, "");
  EXPECT_EQ(read(with("FIELDS x y z rgb", "COLUMNS x y z rgb")).fields[3].name, "rgb");
  EXPECT_EQ(read(with("COUNT 1 1 1 3", "")).fields[3].count, 1U);
  EXPECT_EQ(read(with("POINTS 10", "")).points, 10U);
  EXPECT_EQ(read(with("HEIGHT 2", "HEIGHT 2\n\n \t\n# a comment ")).comments,
            std::vector<std::string>{"a comment"});
  EXPECT_EQ(read(with("DATA ascii", "  DATA \t binary ")).encoding, PcdEncoding::Binary);
  EXPECT_EQ(read(with("DATA ascii", "DATA binary_compressed")).encoding, PcdEncoding::BinaryCompressed);
  EXPECT_EQ(read("\xEF\xBB\xBF" + usual).body_offset, usual.size() + 3);
  EXPECT_EQ(read(with("VIEWPOINT 0 0 0 1 0 0 0", "")).points, 10U);
}

TEST(PcdHeader, ReadsEveryLineEnd) {
  for (const std::string& end : {"\r\n"s, "\r"s}) {
    std::string text;
    for (const char c : usual) text += c == '\n' ? end : std::string(1, c);
    const PcdHeader header = read(text + "data");
    EXPECT_EQ(header.body_offset, text.size());
    EXPECT_EQ(header.points, 10U);
  }
}

TEST(PcdHeader, KeepsAnUnusualViewpoint) {
  EXPECT_EQ(read(with("VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 1.50  0 0 1 0 0 0")).comments,
            std::vector<std::string>{"VIEWPOINT 1.50 0 0 1 0 0 0"});
  EXPECT_TRUE(read(with("VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0.0 0 -0 1.0 0 0 0e0")).comments.empty());
}

TEST(PcdHeader, PointsAloneAreARow) {
  std::string text = with("WIDTH 5", "");
  text.erase(text.find("HEIGHT 2\n"), 9);
  EXPECT_EQ(read(text).points, 10U);
  EXPECT_EQ(read(text).width, 10U);
  EXPECT_EQ(read(text).height, 1U);
}

TEST(PcdHeader, RefusesWhatItDoesNotKnow) {
  expect_refused(with("VERSION 0.7", "VERSION 0.8"), "line 2", "'0.8'", "version 0.5, 0.6 or 0.7");
  expect_refused(with("WIDTH 5", "WIDE 5"), "line 7", "'WIDE'", "one of VERSION, FIELDS");
  expect_refused(with("DATA ascii", "DATA text"), "line 11", "'text'", "ascii, binary or binary_compressed");
  expect_refused(with("WIDTH 5", "WIDTH 5\nWIDTH 5"), "line 8", "a second line WIDTH");
  expect_refused(with("FIELDS x y z rgb", "FIELDS x y z rgb\nCOLUMNS x y z rgb"), "line 4",
                 "a second line FIELDS");
}

TEST(PcdHeader, RefusesTypesThatDoNotExist) {
  expect_refused(with("SIZE 4 8 2 4", "SIZE 4 8 3 4"), "line 5", "TYPE 'I' with SIZE '3'", "I or U");
  expect_refused(with("SIZE 4 8 2 4", "SIZE 2 8 2 4"), "line 5", "TYPE 'F' with SIZE '2'");
  expect_refused(with("TYPE F F I U", "TYPE F F I D"), "line 5", "TYPE 'D' with SIZE '4'");
  expect_refused(with("SIZE 4 8 2 4", "SIZE 4 8 0 4"), "SIZE '0'");
  expect_refused(with("SIZE 4 8 2 4", "SIZE 4 8 -2 4"), "SIZE '-2'");
}

TEST(PcdHeader, RefusesListsOfUnequalLength) {
  expect_refused(with("SIZE 4 8 2 4", "SIZE 4 8 2"), "line 4", "3 values after SIZE", "expected 4");
  expect_refused(with("TYPE F F I U", "TYPE F F I U U"), "line 5", "5 values after TYPE", "expected 4");
  expect_refused(with("COUNT 1 1 1 3", "COUNT 1"), "line 6", "1 values after COUNT", "expected 4");
  expect_refused(with("WIDTH 5", "WIDTH"), "line 7", "0 values after WIDTH", "expected 1");
  expect_refused(with("VIEWPOINT 0 0 0 1 0 0 0", "VIEWPOINT 0 0 0"), "line 9", "3 values after VIEWPOINT",
                 "7");
  expect_refused(with("DATA ascii", "DATA"), "line 11", "0 values after DATA");
}

TEST(PcdHeader, RefusesWhatIsMissing) {
  expect_refused(with("FIELDS x y z rgb", ""), "line 10", "a line FIELDS");
  expect_refused(with("SIZE 4 8 2 4", ""), "line 10", "a line SIZE");
  expect_refused(with("TYPE F F I U", ""), "line 10", "a line TYPE");
  expect_refused(with("WIDTH 5", ""), "line 10", "a line WIDTH");
  expect_refused(with("DATA ascii", ""), "line 10", "the end of the file", "a line DATA");
  expect_refused("", "line 1", "the end of the file");
}

TEST(PcdHeader, RefusesFieldsWithoutCoordinates) {
  expect_refused(with("FIELDS x y z rgb", "FIELDS x y w rgb"), "line 3", "no field 'z'", "x, y and z");
  expect_refused(with("FIELDS x y z rgb", "FIELDS x y x z"), "line 3", "two fields 'x'");
  expect_refused(with("COUNT 1 1 1 3", "COUNT 1 2 1 3"), "line 6", "count 2 of field 'y'", "expected 1");
  const PcdHeader padded = read(with("FIELDS x y z rgb", "FIELDS x y z _"));
  EXPECT_TRUE(padded.fields[3].is_padding());
}

TEST(PcdHeader, RefusesCountsThatLie) {
  expect_refused(with("POINTS 10", "POINTS 11"), "line 10", "POINTS 11", "10 (WIDTH 5 x HEIGHT 2)");
  expect_refused(with("POINTS 10", "POINTS -1"), "line 10", "'-1'", "an integer from 0");
  expect_refused(with("POINTS 10", "POINTS 1e99"), "line 10", "'1e99'", "an integer from 0");
  expect_refused(with("WIDTH 5", "WIDTH five"), "line 7", "'five'", "an integer from 0");
  expect_refused(with("WIDTH 5", "WIDTH 9223372036854775813"), "line 7",
                 "at most 4294967294 points");  // 2^63 + 5
  expect_refused(with("WIDTH 5", "WIDTH 2147483648"), "line 7", "at most 4294967294 points");
  expect_refused(with("WIDTH 5", "WIDTH 18446744073709551616"), "line 7", "an integer from 0");
  expect_refused(with("HEIGHT 2", "HEIGHT 0"), "line 10", "POINTS 10", "0 (WIDTH 5 x HEIGHT 0)");
  std::string points_only = with("POINTS 10", "POINTS 4294967295");
  points_only.erase(points_only.find("WIDTH"), 17);
  expect_refused(points_only, "POINTS 4294967295", "at most 4294967294");
}

TEST(PcdHeader, RefusesRecordsBeyondAMebibyte) {
  EXPECT_EQ(read(with("COUNT 1 1 1 3", "COUNT 1 1 1 262140")).record_bytes, (1U << 20U) - 2);
  expect_refused(with("COUNT 1 1 1 3", "COUNT 1 1 1 262141"), "line 6", "more than 1 MiB");
  expect_refused(with("COUNT 1 1 1 3", "COUNT 1 1 1 4611686018427387904"), "line 6", "more than 1 MiB");
  expect_refused(with("COUNT 1 1 1 3", "COUNT 1 1 1 0"), "line 6", "found 0", "a count from 1");
}

TEST(PcdHeader, RefusesAHeaderWithoutEnd) {
  expect_refused("VERSION 0.7\n" + std::string(2U << 20U, '#'), "line 2", "a header of more than 1 MiB");
  expect_refused("VERSION 0.7\nFIELDS x y\0 z\n"s, "line 2", "a zero byte");
}

}  // namespace
}  // namespace keenline
