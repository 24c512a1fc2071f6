#include "keenline/io/ply_header.h"

#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

PlyHeader read(std::string_view text) { return read_ply_header({"a.ply", text}); }

template <typename... Parts>
void expect_refused(std::string_view text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "a.ply: ", parts...);
}

TEST(PlyHeader, HoldsElementsPropertiesAndComments) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\ncomment  made by hand \nobj_info num_cols 5\n"
      "element vertex 3\nproperty float x\nproperty list uchar int32 rings\ncomment\nelement camera "
      "0\nend_header\n";
  const PlyHeader header = read(text + "rows");
  EXPECT_EQ(header.encoding, PlyEncoding::BigEndian);
  EXPECT_EQ(header.comments, (std::vector<std::string>{" made by hand ", "obj_info num_cols 5", ""}));
  EXPECT_EQ(header.size, text.size());
  EXPECT_EQ(header.lines, 10U);
  ASSERT_EQ(header.elements.size(), 2U);
  const PlyElement& vertex = header.elements[0];
  EXPECT_EQ(vertex.name, "vertex");
  EXPECT_EQ(vertex.count, 3U);
  EXPECT_EQ(vertex.line, 5U);
  ASSERT_EQ(vertex.properties.size(), 2U);
  EXPECT_EQ(vertex.properties[0].type, ScalarType::Float32);
  EXPECT_FALSE(vertex.properties[0].count_type);
  EXPECT_EQ(vertex.properties[1].type, ScalarType::Int32);
  EXPECT_EQ(vertex.properties[1].count_type, ScalarType::UInt8);
  EXPECT_EQ(vertex.properties[1].line, 7U);
  EXPECT_TRUE(vertex.has_lists());
  EXPECT_EQ(vertex.property("rings"), &vertex.properties[1]);
  EXPECT_EQ(vertex.property("y"), nullptr);
  EXPECT_FALSE(header.elements[1].has_lists());
}

TEST(PlyHeader, KnowsEveryTypeUnderBothNames) {
  const std::vector<std::pair<std::string, ScalarType>> names{
      {"char", ScalarType::Int8},       {"int8", ScalarType::Int8},      {"uchar", ScalarType::UInt8},
      {"uint8", ScalarType::UInt8},     {"short", ScalarType::Int16},    {"int16", ScalarType::Int16},
      {"ushort", ScalarType::UInt16},   {"uint16", ScalarType::UInt16},  {"int", ScalarType::Int32},
      {"int32", ScalarType::Int32},     {"uint", ScalarType::UInt32},    {"uint32", ScalarType::UInt32},
      {"int64", ScalarType::Int64},     {"uint64", ScalarType::UInt64},  {"float", ScalarType::Float32},
      {"float32", ScalarType::Float32}, {"double", ScalarType::Float64}, {"float64", ScalarType::Float64}};
  for (const auto& [name, type] : names) {
    const PlyHeader header =
        read("ply\nformat ascii 1.0\nelement e 0\nproperty " + name + " p\nend_header\n");
    EXPECT_EQ(header.elements[0].properties[0].type, type) << name;
  }
  EXPECT_EQ(ply_type_name(ScalarType::Int8), "char");
  EXPECT_EQ(ply_type_name(ScalarType::UInt16), "ushort");
  EXPECT_EQ(ply_type_name(ScalarType::Float32), "float");
  EXPECT_EQ(ply_type_name(ScalarType::Float64), "double");
}

TEST(PlyHeader, TakesEveryLineEndAndBlank) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text = "\xEF\xBB\xBFply" + end + "format\tascii  1.0 " + end + end +
                             "  element   vertex\t2" + end + "property  float\t x" + end + "end_header" + end;
    const PlyHeader header = read(text + "1\n2\n");
    EXPECT_EQ(header.size, text.size());
    EXPECT_EQ(header.lines, 6U);
    ASSERT_EQ(header.elements.size(), 1U);
    EXPECT_EQ(header.elements[0].count, 2U);
    EXPECT_EQ(header.elements[0].properties[0].name, "x");
  }
}

TEST(PlyHeader, TakesAwkwardNames) {
  const PlyHeader header = read(
      "ply\nformat ascii 1.0\nelement list 0\nproperty int list\nproperty list int int élan#1\nend_header");
  EXPECT_EQ(header.elements[0].properties[0].name, "list");
  EXPECT_EQ(header.elements[0].properties[1].name, "élan#1");
}

TEST(PlyHeader, NamesItsEncodings) {
  EXPECT_EQ(name_of(PlyEncoding::Ascii), "ascii 1.0");
  EXPECT_EQ(name_of(PlyEncoding::LittleEndian), "binary little endian 1.0");
  EXPECT_EQ(name_of(PlyEncoding::BigEndian), "binary big endian 1.0");
}

TEST(PlyHeader, RefusesWhatItDoesNotKnow) {
  expect_refused("", "line 1", "an empty file", "'ply'");
  expect_refused("plyx\n", "line 1", "'plyx'");
  expect_refused("ply\n", "line 1", "the end of the file", "'end_header'");
  expect_refused("ply\nformat ascii 1.0\nelement vertex 1\n", "line 3", "the end of the file",
                 "'end_header'");
  expect_refused("ply\nend_header\n", "line 2", "no format");
  expect_refused("ply\nformat ascii 2.0\nend_header\n", "line 2", "'2.0'", "1.0");
  expect_refused("ply\nformat binary 1.0\n", "line 2", "'binary'", "binary_little_endian");
  expect_refused("ply\nformat ascii 1.0\nformat ascii 1.0\n", "line 3", "a second format line");
  expect_refused("ply\nformat ascii 1.0\nvertices 3\n", "line 3", "'vertices'", "end_header");
  expect_refused("ply\nformat ascii 1.0\nend_header now\n", "line 3", "'now'");
  expect_refused(std::string_view("ply\nformat ascii 1.0\ncomment \0\nend_header\n", 42), "line 3",
                 "a zero byte");
}

TEST(PlyHeader, RefusesBadElements) {
  const std::string start = "ply\nformat ascii 1.0\n";
  for (const std::string count : {"-1", "1.5", "many", "18446744073709551616", "0x10", "+3"})
    expect_refused(start + "element vertex " + count + "\nend_header\n", "line 3", "'" + count + "'",
                   "'vertex'");
  EXPECT_EQ(read(start + "element vertex 18446744073709551615\nend_header\n").elements[0].count,
            18446744073709551615U);
  expect_refused(start + "element vertex\n", "line 3", "the end of the line", "number of rows");
  expect_refused(start + "element\n", "line 3", "the end of the line", "name of an element");
  expect_refused(start + "element vertex 3 4\n", "line 3", "'4'");
  expect_refused(start + "element a 0\nelement b 0\nelement a 0\n", "line 5", "a second element 'a'");
}

TEST(PlyHeader, RefusesBadProperties) {
  const std::string start = "ply\nformat ascii 1.0\n";
  expect_refused(start + "property float x\n", "line 3", "before any element");
  const std::string element = start + "element vertex 1\n";
  expect_refused(element + "property real x\n", "line 4", "'real'", "float");
  expect_refused(element + "property float\n", "line 4", "the end of the line", "name of a property");
  expect_refused(element + "property float x y\n", "line 4", "'y'");
  expect_refused(element + "property list float int x\n", "line 4", "length is a float", "integer");
  expect_refused(element + "property list uchar x\n", "line 4", "'x'", "a type");
  expect_refused(element + "property float x\nproperty int x\n", "line 5", "a second property 'x'",
                 "'vertex'");
  const std::string two = element + "property float x\nelement other 1\nproperty int x\nend_header\n";
  EXPECT_EQ(read(two).elements.size(), 2U);
}

TEST(PlyHeader, IsBounded) {
  const std::string start = "ply\nformat ascii 1.0\ncomment ";
  const std::string end = "\nend_header\n";
  EXPECT_EQ(read(start + std::string(500000, 'c') + end).comments[0].size(), 500000U);
  expect_refused(start + std::string(longest_ply_header, 'c') + end, "line 3", "more than 32 MiB",
                 "'end_header'");
  std::string lines = "ply\nformat ascii 1.0\n";
  while (lines.size() < longest_ply_header) lines += "comment again\n";
  expect_refused(lines + "end_header\n", "more than 32 MiB");
}

}  // namespace
}  // namespace keenline
