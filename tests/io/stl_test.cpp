#include "keenline/io/stl.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using test::expect_error;
using Triangle = std::array<std::array<float, 3>, 3>;

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Reading read(std::string_view bytes) { return read_stl({"a.stl", bytes}, no_progress()); }

template <typename... Parts>
void expect_refusal(std::string_view bytes, const Parts&... parts) {
  expect_error<InputError>([&] { (void)read(bytes); }, "a.stl: ", parts...);
}

template <typename T>
std::string bytes_of(const T& value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

std::string binary(std::string title, const std::vector<Triangle>& triangles, std::uint16_t attribute = 0) {
  title.resize(80);
  std::string bytes = title + bytes_of(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    bytes += bytes_of(std::array<float, 3>{0, 0, 1}) + bytes_of(triangle) + bytes_of(attribute);
    if (attribute != 0) ++attribute;
  }
  return bytes;
}

std::vector<std::int32_t> indices_of(const PointCloud& cloud) {
  const auto values = cloud.tables.at(0).columns.at(0).values<std::int32_t>();
  return {values.begin(), values.end()};
}

/// The 12 triangles of the unit cube; corner i has the coordinates (i & 1, i >> 1 & 1, i >> 2).
std::vector<Triangle> cube() {
  std::vector<Triangle> triangles;
  const auto corner = [](unsigned i) {
    return std::array<float, 3>{static_cast<float>(i & 1U), static_cast<float>(i >> 1U & 1U),
                                static_cast<float>(i >> 2U)};
  };
  for (const auto& q : {std::array{0U, 1U, 3U, 2U},
                        {4U, 5U, 7U, 6U},
                        {0U, 1U, 5U, 4U},
                        {2U, 3U, 7U, 6U},
                        {0U, 2U, 6U, 4U},
                        {1U, 3U, 7U, 5U}}) {
    triangles.push_back({corner(q[0]), corner(q[1]), corner(q[2])});
    triangles.push_back({corner(q[0]), corner(q[2]), corner(q[3])});
  }
  return triangles;
}

const std::vector<Triangle> two_triangles{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}},
                                          {{{1, 0, 0}, {0, 1, 0}, {1, 1, 0.5F}}}};
const std::vector<Point> two_triangles_points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5}};
const std::vector<std::int32_t> two_triangles_indices{0, 1, 2, 1, 2, 3};

constexpr std::string_view ascii =
    "solid part one\n"
    "  facet normal 0 0 1\n    outer loop\n"
    "      vertex 0 0 0\n      vertex 1 0 0\n      vertex 0 1 0\n"
    "    endloop\n  endfacet\n"
    "  facet normal 0 0 1\n    outer loop\n"
    "      vertex 1 0 0\n      vertex 0 1 0\n      vertex 1 1 0.5\n"
    "    endloop\n  endfacet\n"
    "endsolid part one\n";

std::string replaced(std::string_view what, std::string_view by) {
  std::string text(ascii);
  return text.replace(text.find(what), what.size(), by);
}

TEST(Stl, ReadsBinary) {
  const Reading reading = read(binary("made by hand", two_triangles));
  EXPECT_EQ(reading.format, "stl");
  EXPECT_EQ(reading.encoding, "binary");
  EXPECT_EQ(reading.cloud.positions, two_triangles_points);
  EXPECT_EQ(reading.cloud.position_types[2], ScalarType::Float32);
  EXPECT_EQ(indices_of(reading.cloud), two_triangles_indices);
  EXPECT_EQ(reading.cloud.tables.at(0).columns.size(), 1U);
  EXPECT_EQ(reading.cloud.comments, std::vector<std::string>{"made by hand"});
  EXPECT_EQ(reading.notes,
            (std::vector<std::string>{"6 corners merged to 4 points", "facet normals are not kept"}));
}

TEST(Stl, ReadsAscii) {
  const Reading reading = read(ascii);
  EXPECT_EQ(reading.encoding, "ascii");
  EXPECT_EQ(reading.cloud.positions, two_triangles_points);
  EXPECT_EQ(reading.cloud.position_types[0], ScalarType::Float64);
  EXPECT_EQ(indices_of(reading.cloud), two_triangles_indices);
  EXPECT_EQ(reading.cloud.comments, std::vector<std::string>{"part one"});
  EXPECT_EQ(read(replaced("1 1 0.5", "1 1 0.1234567890123456")).cloud.positions.at(3)[2], 0.1234567890123456);
}

TEST(Stl, KnowsBinaryBySizeWhateverItBeginsWith) {
  EXPECT_EQ(read(binary("solid facet endsolid", two_triangles)).encoding, "binary");
  EXPECT_EQ(read(binary("", two_triangles)).cloud.comments.size(), 0U);
  EXPECT_EQ(read(binary("", {})).cloud.size(), 0U);
}

TEST(Stl, MergesTheCornersOfACube) {
  const Reading reading = read(binary("", cube()));
  EXPECT_EQ(reading.cloud.size(), 8U);
  EXPECT_EQ(reading.notes.front(), "36 corners merged to 8 points");
}

TEST(Stl, MergesManyCornersInOrderOfFirstAppearance) {
  std::vector<Triangle> strip;
  for (int i = 0; i < 1000; ++i) {
    const auto x = static_cast<float>(i);
    strip.push_back({{{x, 0, 0}, {x + 1, 0, 0}, {x + 2, 0, 0}}});
  }
  const PointCloud cloud = read(binary("", strip)).cloud;
  ASSERT_EQ(cloud.size(), 1002U);
  for (std::size_t i = 0; i < cloud.size(); ++i) EXPECT_EQ(cloud.positions[i][0], static_cast<double>(i));
  EXPECT_EQ(indices_of(cloud).at(2999), 1001);
}

TEST(Stl, MergesZerosOfBothSignsButNothingThatIsNotANumber) {
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(read(binary("", {{{{0, 0, 0}, {-0.0F, 0, 0}, {0, -0.0F, -0.0F}}}})).cloud.size(), 1U);
  EXPECT_EQ(read(binary("", {{{{inf, 0, 0}, {inf, 0, 0}, {-inf, 0, 0}}}})).cloud.size(), 2U);
  const std::vector<Triangle> undefined(100, {{{nan, 0, 0}, {nan, 0, 0}, {0, 0, nan}}});
  EXPECT_EQ(read(binary("", undefined)).cloud.size(), 300U);
}

TEST(Stl, KeepsAttributeWordsUnlessAllAreZero) {
  const PointCloud cloud = read(binary("", two_triangles, 65534)).cloud;
  ASSERT_EQ(cloud.tables.at(0).columns.size(), 2U);
  const Column& column = cloud.tables[0].columns[1];
  EXPECT_EQ(column.name(), "attribute");
  ASSERT_EQ(column.type(), ScalarType::UInt16);
  EXPECT_EQ(column.value(0), 65534);
  EXPECT_EQ(column.value(1), 65535);
}

TEST(Stl, ReadsOddButValidText) {
  std::string text =
      "\xEF\xBB\xBF\r\n  SOLID\r\n\tFacet Normal 0 0 1\r\n\r\nOUTER  loop\r\nVertex 0 0 0\r\nvertex 1e0 0 "
      "0\r\n";
  text += "vertex 0 +1 0\r\nEndLoop\r\nendFacet\r\nENDSOLID";
  EXPECT_EQ(read(text).cloud.size(), 3U);
  EXPECT_EQ(read("solid a\nendsolid a\n").cloud.size(), 0U);

  const Reading several = read(std::string(ascii) + "\n" + std::string(ascii));
  EXPECT_EQ(several.cloud.size(), 4U);
  EXPECT_EQ(several.cloud.tables.at(0).rows, 4U);
  EXPECT_EQ(several.cloud.comments.size(), 2U);
}

TEST(Stl, RefusesBinaryWhoseSizeContradictsItsCount) {
  const std::string good = binary("", two_triangles);
  expect_refusal(good.substr(0, good.size() - 1), "byte 80",
                 "2 triangles, which take 184 bytes, in a file of 183 bytes", "binary", "ascii");
  expect_refusal(good + "x", "byte 80", "in a file of 185 bytes");
  expect_refusal(binary("solid of two", two_triangles) + "x", "byte 80", "in a file of 185 bytes");
  for (const std::uint32_t count : {0U, 1U, 3U, 0x8000'0000U, 0xFFFF'FFFFU}) {
    std::string lying = good;
    lying.replace(80, 4, bytes_of(count));
    expect_refusal(lying, "byte 80", std::to_string(count) + " triangles");
  }
  for (std::size_t size = 0; size < good.size(); ++size) expect_refusal(good.substr(0, size), "byte");
}

TEST(Stl, RefusesWhatIsNeither) {
  expect_refusal("", "byte 0", "the end of the file", "solid", "84 bytes");
  expect_refusal("solidarity\n", "byte 11");
  expect_refusal(std::string(100, 'x'), "byte 80", "in a file of 100 bytes", "solid");
}

TEST(Stl, RefusesWrongText) {
  expect_refusal(replaced("0 0 1", "0 0 up"), "line 2", "'up'", "a number");
  expect_refusal(replaced("facet normal 0 0 1", "facet normal 0 0"), "line 2", "the end of the line");
  expect_refusal(replaced("outer loop", "outer"), "line 3", "the end of the line", "loop");
  expect_refusal(replaced("vertex 1 0 0", "vertex 1 0"), "line 5", "the end of the line");
  expect_refusal(replaced("vertex 1 0 0", "vertex 1 0 0 0"), "line 5", "'0'", "the end of the line");
  expect_refusal(replaced("vertex 1 0 0", "vertex 1 abc 0"), "line 5", "'abc'");
  expect_refusal(replaced("    endloop", "vertex 2 2 2\nendloop"), "line 7", "'vertex'", "endloop");
  expect_refusal(replaced("      vertex 1 0 0\n", ""), "line 6", "'endloop'", "vertex");
  expect_refusal(replaced("endfacet", "nonsense"), "line 8", "'nonsense'", "endfacet");
  expect_refusal(replaced("endsolid part one\n", ""), "line 15", "the end of the file", "facet or endsolid");
  expect_refusal(replaced("  facet", "  face"), "line 2", "'face'", "facet or endsolid");
  expect_refusal(std::string(ascii) + "garbage\n", "line 17", "'garbage'", "solid");
  for (std::size_t size = 0; size < ascii.rfind("endsolid") + 8; ++size)
    expect_refusal(ascii.substr(0, size), "found");
}

TEST(Stl, StopsWhenCancelled) {
  struct Stopped : Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } stopped;
  EXPECT_THROW((void)read_stl({"a.stl", ascii}, stopped), Cancelled);
  const std::string bytes = binary("", std::vector<Triangle>(2000, two_triangles.front()));
  EXPECT_THROW((void)read_stl({"a.stl", bytes}, stopped), Cancelled);
}

TEST(Stl, IsRecognisedBySizeOrKeywords) {
  const auto match = [](std::string_view bytes) { return match_stl({"a", bytes}); };
  EXPECT_EQ(match(binary("", two_triangles)), Format::Match::Strong);
  EXPECT_EQ(match(binary("solid", two_triangles)), Format::Match::Strong);
  EXPECT_EQ(match(binary("", {})), Format::Match::No);
  EXPECT_EQ(match(ascii), Format::Match::Strong);
  EXPECT_EQ(match("\n Solid\r\n ENDSOLID"), Format::Match::Strong);
  EXPECT_EQ(match("solid gold\nis heavy\n"), Format::Match::No);
  EXPECT_EQ(match("facet\nendsolid\n"), Format::Match::No);
  EXPECT_EQ(match(""), Format::Match::No);
}

}  // namespace
}  // namespace keenline
