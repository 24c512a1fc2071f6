#include "keenline/io/obj.h"

#include <cstdint>
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
using Lists = std::vector<std::vector<std::int32_t>>;

Reading read(std::string_view text) { return read_obj({"a.obj", text}, no_progress()); }

template <typename... Parts>
void expect_refusal(std::string_view text, const Parts&... parts) {
  expect_error<InputError>([&] { (void)read(text); }, "a.obj: ", parts...);
}

Lists lists_of(const PointCloud& cloud, std::string_view name) {
  Lists lists;
  for (const Table& table : cloud.tables) {
    if (table.name != name) continue;
    const Column& column = table.columns.at(0);
    const auto values = column.values<std::int32_t>();
    for (std::size_t i = 0; i < column.rows(); ++i)
      lists.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(column.offsets()[i]),
                         values.begin() + static_cast<std::ptrdiff_t>(column.offsets()[i + 1]));
  }
  return lists;
}

std::vector<double> values_of(const PointCloud& cloud, std::string_view name) {
  const Column* const column = cloud.attribute(name);
  if (column == nullptr) return {};
  return {column->values<double>().begin(), column->values<double>().end()};
}

constexpr std::string_view four = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

std::string with_four(std::string_view lines) { return std::string(four) + std::string(lines); }

TEST(Obj, ReadsVerticesAndFaces) {
  const Reading reading = read("# cube\n\nv 1 2 3\nv\t-1e3  .5 6 # last\nf 1 2 1\n");
  EXPECT_EQ(reading.format, "obj");
  EXPECT_EQ(reading.cloud.positions, (std::vector<Point>{{1, 2, 3}, {-1000, .5, 6}}));
  EXPECT_TRUE(reading.cloud.attributes.empty());
  EXPECT_EQ(lists_of(reading.cloud, "face"), (Lists{{0, 1, 0}}));
  EXPECT_EQ(reading.cloud.comments, std::vector<std::string>{"cube"});
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Obj, ReadsEveryFormOfReference) {
  const PointCloud cloud =
      read(with_four("f 1 2 3\nf 1/5 2/6 3/7\nf 1//5 2//6 3//7\nf 1/5/1 2/6/1 3/-7/-1\nf 4/ 1// 2\n")).cloud;
  EXPECT_EQ(lists_of(cloud, "face"), (Lists{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {3, 0, 1}}));
}

TEST(Obj, CountsNegativeReferencesFromTheVerticesSoFar) {
  const PointCloud cloud = read("v 0 0 0\nv 1 0 0\nf -1 -2\nv 0 1 0\nf -1 -3\nl -3 -2 -1\n").cloud;
  EXPECT_EQ(lists_of(cloud, "face"), (Lists{{1, 0}, {2, 0}}));
  EXPECT_EQ(lists_of(cloud, "line"), (Lists{{0, 1, 2}}));
}

TEST(Obj, LetsFacesPrecedeTheirVertices) {
  EXPECT_EQ(lists_of(read("f 1 2 4\nl 4 3\n" + std::string(four)).cloud, "face"), (Lists{{0, 1, 3}}));
}

TEST(Obj, KeepsWeightsAndColours) {
  EXPECT_EQ(values_of(read("v 0 0 0 2\nv 0 0 0 3\n").cloud, "w"), (std::vector<double>{2, 3}));
  const PointCloud coloured = read("v 0 0 0 .25 .5 1\nv 0 0 1 0 1 255\n").cloud;
  ASSERT_EQ(coloured.attributes.size(), 3U);
  EXPECT_EQ(values_of(coloured, "red"), (std::vector<double>{.25, 0}));
  EXPECT_EQ(values_of(coloured, "green"), (std::vector<double>{.5, 1}));
  EXPECT_EQ(values_of(coloured, "blue"), (std::vector<double>{1, 255}));
  const Reading both = read("v 1 2 3 4 5 6 7\n");
  EXPECT_EQ(values_of(both.cloud, "w"), std::vector<double>{4});
  EXPECT_EQ(values_of(both.cloud, "blue"), std::vector<double>{7});
  EXPECT_EQ(both.notes.size(), 2U);
}

TEST(Obj, ReadsOddButValidText) {
  const std::string_view windows = "\xEF\xBB\xBFv 0 0 0\r\nv 1 \\\r\n0 \\\r\n0\r\nf 1 \\\r\n2\r\n\\\r\n\r\n";
  const PointCloud cloud = read(windows).cloud;
  EXPECT_EQ(cloud.positions, (std::vector<Point>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(lists_of(cloud, "face"), (Lists{{0, 1}}));
  EXPECT_EQ(read("v 0 0 0\rv 1 0 0\r").cloud.size(), 2U);
  EXPECT_EQ(read("# a path C:\\dir\\\nv 1 0 0").cloud.size(), 1U) << "a comment does not continue";
}

TEST(Obj, SkipsAndCountsWhatIsNoGeometryOfPoints) {
  const Reading reading =
      read(with_four("vn 0 0 1\nvt 0 0\nvn 1 0 0\ng\ng a b\no x\ns off\nusemtl red\nmtllib a.mtl\np 1 "
                     "2\ncstype bezier\nend\n"));
  EXPECT_EQ(reading.cloud.size(), 4U);
  EXPECT_EQ(reading.notes,
            std::vector<std::string>{
                "skipped lines: 2 vn, 1 vt, 2 g, 1 s, 1 usemtl, 1 o, 1 p, 1 mtllib, 1 cstype, 1 end"});
}

TEST(Obj, NotesThatThereIsNoVertex) {
  const Reading reading = read("# nothing\n");
  EXPECT_EQ(reading.cloud.size(), 0U);
  EXPECT_EQ(reading.notes, std::vector<std::string>{"there are no vertices (v lines)"});
}

TEST(Obj, RefusesWrongVertices) {
  expect_refusal("v 1 2\n", "line 1", "2 numbers", "3, 4, 6 or 7");
  expect_refusal("v\n", "line 1", "0 numbers");
  expect_refusal("v 1 2 3 4 5\n", "line 1", "5 numbers");
  expect_refusal("v 1 2 3 4 5 6 7 8\n", "line 1", "'8'", "the end of the line");
  expect_refusal("\nv 0 0 0\nv 1 2,5 3\n", "line 3", "'2,5'", "a number");
  expect_refusal("v 1 2 1e400\n", "line 1", "'1e400'");
  expect_refusal("# x\nv 0 0 0\n\nv 0 0 0 1\n", "line 4", "4 numbers", "3 as for the vertex in line 2");
}

TEST(Obj, RefusesWrongReferences) {
  expect_refusal(with_four("f 1 2 0\n"), "line 5", "'0'");
  expect_refusal(with_four("f 1 2 x\n"), "line 5", "'x'");
  expect_refusal(with_four("f\n"), "line 5", "the end of the line");
  expect_refusal(with_four("f 1 2 -5\n"), "line 5", "'-5'", "one of the 4 vertices that precede");
  expect_refusal(with_four("f 1 2 -9223372036854775808\n"), "line 5");
  expect_refusal(with_four("f 1 2 5\nf 1 2 3\n"), "line 5", "'5'", "a vertex number from 1 to 4");
  expect_refusal(with_four("f 1 2 4294967297\n"), "line 5", "'4294967297'");
  expect_refusal(with_four("f 1 2 18446744073709551617\n"), "line 5");
  expect_refusal(with_four("f 1/x 2 3\n"), "line 5", "'1/x'");
  expect_refusal(with_four("f 1/0 2 3\n"), "line 5", "'1/0'");
  expect_refusal(with_four("f 1/1/1/1 2 3\n"), "line 5", "'1/1/1/1'");
  expect_refusal(with_four("f /1 2 3\n"), "line 5", "'/1'");
  expect_refusal(with_four("l 1 7\n"), "line 5", "'7'");
  expect_refusal("f 1\n", "line 1", "'1'", "no vertices");
}

TEST(Obj, RefusesWhatIsNoObj) {
  expect_refusal("xyz 1 2 3\n", "line 1", "'xyz'", "an OBJ keyword");
  expect_refusal("v 0 0 0\nV 1 0 0\n", "line 2", "'V'");
  expect_refusal("v 0 0 0 \\\n", "line 1", "the end of the file", "backslash");
  expect_refusal(std::string_view("v 0 0 0\nv 0 \0 0\n", 16), "line 2", "a zero byte");
}

TEST(Obj, StopsWhenCancelled) {
  struct Stopped : Progress {
    [[nodiscard]] bool cancelled() const override { return true; }
  } stopped;
  EXPECT_THROW((void)read_obj({"a.obj", four}, stopped), Cancelled);
}

TEST(Obj, IsRecognisedWeaklyByAKeyword) {
  const auto match = [](std::string_view text) { return match_obj({"a", text}); };
  EXPECT_EQ(match(four), Format::Match::Weak);
  EXPECT_EQ(match("\xEF\xBB\xBF# x\r\n\r\nmtllib a.mtl\r\n"), Format::Match::Weak);
  EXPECT_EQ(match("v\n"), Format::Match::No);
  EXPECT_EQ(match("1 2 3\n"), Format::Match::No);
  EXPECT_EQ(match("vertex 1 2 3\n"), Format::Match::No);
  EXPECT_EQ(match(""), Format::Match::No);
}

}  // namespace
}  // namespace keenline
