#include "keenline/io/ply_body.h"

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/bytes.h"
#include "support/expect_error.h"

namespace keenline {
namespace {

/// Reads all rows of a file, whatever its elements.
std::vector<PlyRows> read(const std::string& text) {
  const Source source{"a.ply", text};
  const PlyHeader header = read_ply_header(source);
  PlyBody body(source, header, no_progress());
  std::vector<PlyRows> rows;
  for (const PlyElement& element : header.elements) rows.push_back(body.read(element));
  body.expect_end();
  return rows;
}

template <typename... Parts>
void expect_refused(const std::string& text, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(text); }, "a.ply: ", parts...);
}

std::string header(std::string_view format, std::string_view rest) {
  return "ply\nformat " + std::string(format) + " 1.0\n" + std::string(rest) + "end_header\n";
}

template <typename T>
std::vector<T> values(const Column& column) {
  EXPECT_EQ(column.type(), scalar_type_of<T>());
  const auto span = column.values<T>();
  return {span.begin(), span.end()};
}

std::vector<std::uint64_t> offsets(const Column& column) {
  return {column.offsets().begin(), column.offsets().end()};
}

const std::string all_types =
    "element e 2\nproperty char a\nproperty uchar b\nproperty short c\nproperty ushort d\nproperty int e\n"
    "property uint f\nproperty int64 g\nproperty uint64 h\nproperty float i\nproperty double j\n";

void expect_all_types(const Table& table) {
  ASSERT_EQ(table.columns.size(), 10U);
  EXPECT_EQ(table.rows, 2U);
  EXPECT_EQ(values<std::int8_t>(table.columns[0]), (std::vector<std::int8_t>{-128, 1}));
  EXPECT_EQ(values<std::uint8_t>(table.columns[1]), (std::vector<std::uint8_t>{255, 2}));
  EXPECT_EQ(values<std::int16_t>(table.columns[2]), (std::vector<std::int16_t>{-32768, 3}));
  EXPECT_EQ(values<std::uint16_t>(table.columns[3]), (std::vector<std::uint16_t>{65535, 4}));
  EXPECT_EQ(values<std::int32_t>(table.columns[4]), (std::vector<std::int32_t>{-2147483647 - 1, 5}));
  EXPECT_EQ(values<std::uint32_t>(table.columns[5]), (std::vector<std::uint32_t>{4294967295U, 6}));
  EXPECT_EQ(values<std::int64_t>(table.columns[6]),
            (std::vector<std::int64_t>{std::numeric_limits<std::int64_t>::min(), 7}));
  EXPECT_EQ(values<std::uint64_t>(table.columns[7]),
            (std::vector<std::uint64_t>{std::numeric_limits<std::uint64_t>::max(), 8}));
  EXPECT_EQ(values<float>(table.columns[8]), (std::vector<float>{-1.5F, 9}));
  EXPECT_EQ(values<double>(table.columns[9]), (std::vector<double>{0.1, 10}));
}

TEST(PlyBody, ReadsEveryTypeFromText) {
  expect_all_types(
      read(header("ascii", all_types) +
           "-128 255 -32768 65535 -2147483648 4294967295 -9223372036854775808 18446744073709551615 -1.5 0.1\n"
           "1.0 2 3 4 5 6 7 8 9e0 1e1\n")[0]
          .table);
}

TEST(PlyBody, ReadsEveryTypeFromBytesInBothOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    test::Bytes bytes(
        header(order == std::endian::big ? "binary_big_endian" : "binary_little_endian", all_types), order);
    bytes.add(std::int8_t{-128}, std::uint8_t{255}, std::int16_t{-32768}, std::uint16_t{65535},
              std::numeric_limits<std::int32_t>::min(), 4294967295U, std::numeric_limits<std::int64_t>::min(),
              std::numeric_limits<std::uint64_t>::max(), -1.5F, 0.1);
    bytes.add(std::int8_t{1}, std::uint8_t{2}, std::int16_t{3}, std::uint16_t{4}, std::int32_t{5}, 6U,
              std::int64_t{7}, std::uint64_t{8}, 9.0F, 10.0);
    expect_all_types(read(bytes.str())[0].table);
  }
}

const std::string lists =
    "element e 3\nproperty float w\nproperty list uchar short a\nproperty list int double b\n";

void expect_lists(const PlyRows& rows) {
  ASSERT_EQ(rows.table.columns.size(), 3U);
  EXPECT_EQ(values<float>(rows.table.columns[0]), (std::vector<float>{0.5F, 1.5F, 2.5F}));
  const Column& a = rows.table.columns[1];
  EXPECT_EQ(offsets(a), (std::vector<std::uint64_t>{0, 2, 2, 3}));
  EXPECT_EQ(values<std::int16_t>(a), (std::vector<std::int16_t>{-1, 2, 3}));
  EXPECT_EQ(a.count_type(), ScalarType::UInt8);
  const Column& b = rows.table.columns[2];
  EXPECT_EQ(offsets(b), (std::vector<std::uint64_t>{0, 0, 1, 2}));
  EXPECT_EQ(values<double>(b), (std::vector<double>{0.25, 4}));
  EXPECT_EQ(b.count_type(), ScalarType::Int32);
}

TEST(PlyBody, ReadsListsFromText) {
  const auto rows = read(header("ascii", lists) + "0.5 2 -1 2 0\n\n1.5 0 1 0.25\r\n2.5\t1 3  1 4 \n");
  expect_lists(rows[0]);
}

TEST(PlyBody, ReadsListsFromBytesInBothOrders) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    test::Bytes bytes(header(order == std::endian::big ? "binary_big_endian" : "binary_little_endian", lists),
                      order);
    bytes.add(0.5F, std::uint8_t{2}, std::int16_t{-1}, std::int16_t{2}, 0);
    bytes.add(1.5F, std::uint8_t{0}, 1, 0.25);
    bytes.add(2.5F, std::uint8_t{1}, std::int16_t{3}, 1, 4.0);
    const auto rows = read(bytes.str());
    expect_lists(rows[0]);
  }
}

TEST(PlyBody, ReadsElementsOneAfterAnother) {
  const std::string elements =
      "element none 0\nproperty list uchar int p\nelement a 1\nproperty list uchar int p\nelement empty 0\n"
      "element b 2\nproperty uchar q\n";
  const auto text = read(header("ascii", elements) + "2 7 8\n4\n5\n");
  const auto bytes = read(test::Bytes(header("binary_little_endian", elements))
                              .add(std::uint8_t{2}, 7, 8, std::uint8_t{4}, std::uint8_t{5})
                              .str());
  for (const auto& rows : {text, bytes}) {
    ASSERT_EQ(rows.size(), 4U);
    EXPECT_EQ(rows[0].table.rows, 0U);
    ASSERT_EQ(rows[0].table.columns.size(), 1U);
    EXPECT_TRUE(rows[0].table.columns[0].is_list());
    EXPECT_EQ(values<std::int32_t>(rows[1].table.columns[0]), (std::vector<std::int32_t>{7, 8}));
    EXPECT_TRUE(rows[2].table.columns.empty());
    EXPECT_EQ(values<std::uint8_t>(rows[3].table.columns[0]), (std::vector<std::uint8_t>{4, 5}));
  }
}

TEST(PlyBody, TellsWhereARowStands) {
  const std::string elements = "element first 1\nproperty uchar q\n" + lists;
  const std::string ascii = header("ascii", elements) + "9\n0.5 2 -1 2 0\n\n1.5 0 1 0.25\n2.5 1 3 1 4\n";
  const Source text_source{"a.ply", ascii};
  const PlyHeader text_header = read_ply_header(text_source);
  PlyBody text(text_source, text_header, no_progress());
  (void)text.read(text_header.elements[0]);
  const PlyRows text_rows = text.read(text_header.elements[1]);
  EXPECT_EQ(text.place_of(text_rows, 0).number, text_header.lines + 2);
  EXPECT_EQ(text.place_of(text_rows, 2).number, text_header.lines + 5);
  EXPECT_EQ(text.place_of(text_rows, 2).unit, Place::Unit::Line);

  test::Bytes bytes(header("binary_little_endian", elements));
  const std::size_t start = bytes.size();
  bytes.add(std::uint8_t{9}, 0.5F, std::uint8_t{2}, std::int16_t{-1}, std::int16_t{2}, 0);
  const std::size_t second = bytes.size();
  bytes.add(1.5F, std::uint8_t{0}, 1, 0.25);
  const std::size_t third = bytes.size();
  bytes.add(2.5F, std::uint8_t{1}, std::int16_t{3}, 1, 4.0);
  const Source source{"a.ply", bytes.str()};
  const PlyHeader binary_header = read_ply_header(source);
  PlyBody binary(source, binary_header, no_progress());
  (void)binary.read(binary_header.elements[0]);
  const PlyRows rows = binary.read(binary_header.elements[1]);
  EXPECT_EQ(binary.place_of(rows, 0).number, start + 1);
  EXPECT_EQ(binary.place_of(rows, 1).number, second);
  EXPECT_EQ(binary.place_of(rows, 2).number, third);
  EXPECT_EQ(binary.place_of(rows, 2).unit, Place::Unit::Byte);
}

TEST(PlyBody, RefusesBadTextRows) {
  const std::string scalars =
      header("ascii", "element e 2\nproperty float a\nproperty uchar b\n");  // 6 lines
  expect_refused(scalars + "1 2\n1 two\n", "line 8", "'two'", "'b'", "an integer from 0 to 255");
  expect_refused(scalars + "1 300\n1 2\n", "line 7", "'300'", "an integer from 0 to 255");
  expect_refused(scalars + "1e39 3\n1 2\n", "line 7", "'1e39'", "32-bit float");
  expect_refused(scalars + "1 2 3\n1 2\n", "line 7", "3 values", "2");
  expect_refused(scalars + "1\n2\n1 2\n", "line 7", "1 value", "2");
  expect_refused(scalars + "1 2\n\n\n\n", "the end of the file after 1 row", "2 rows");
  const std::string list =
      header("ascii", "element e 2\nproperty list uchar int a\nproperty float b\n");  // 6 lines
  expect_refused(list + "1 5 0.5\n2 5\n", "line 8", "the end of the line", "2 values");
  expect_refused(list + "1 5 0.5\n1 5\n", "line 8", "the end of the line", "a number");
  expect_refused(list + "1 5 0.5\n1 5 0.5 6\n", "line 8", "'6'", "the end of the line");
  expect_refused(list + "1 5 0.5\n-1 5 0.5\n", "line 8", "'-1'", "number of values", "'a'");
  expect_refused(list + "1 5 0.5\n256 5 0.5\n", "line 8", "'256'", "uint8");
  expect_refused(list + "1 5 0.5\n1 5.5 0.5\n", "line 8", "'5.5'", "an integer from -2147483648");
  expect_refused(list + "1 5 0.5\n\n  \n", "the end of the file", "row 2 of 2");
  expect_refused(list + "1 5 0.5\n" + std::string(8, '\0'), "line 8", "a zero byte");
}

TEST(PlyBody, RefusesCountsThatTheFileHasNoRoomFor) {
  for (const std::string count :
       {"2", "2147483648", "4294967306", "9223372036854775808", "18446744073709551615"}) {
    const std::string declared = count + " rows";
    expect_refused(test::Bytes(header("binary_little_endian", "element e " + count + "\nproperty double a\n"))
                       .add(1.0)
                       .str(),
                   "the end of the file", "at most 1 rows", declared, "line 3");
    expect_refused(
        header("binary_little_endian", "element e " + count + "\nproperty list uchar double a\n") + '\0',
        "the end of the file", "at most 1 rows", declared);
  }
  for (const std::string count : {"4", "18446744073709551615"}) {
    expect_refused(header("ascii", "element e " + count + "\nproperty double a\n") + "1\n1\n1",
                   "at most 3 rows");
    expect_refused(header("ascii", "element e " + count + "\nproperty list int int a\n") + "0\n0\n0",
                   "at most 3 rows");
    expect_refused(header("ascii", "element e " + count + "\n"), "line 3", "rows but no properties");
  }
  EXPECT_EQ(read(header("ascii", "element e 3\nproperty double a\n") + "1\n1\n1")[0].table.rows, 3U);
}

TEST(PlyBody, RefusesBadListLengthsInBytes) {
  const std::string one = "element e 1\nproperty list int double a\n";
  const std::size_t start = header("binary_little_endian", one).size();
  const std::string at_length = "byte " + std::to_string(start);
  const std::string at_values = "byte " + std::to_string(start + 4);
  const auto with_length = [&](std::int32_t length) {
    return test::Bytes(header("binary_little_endian", one)).add(length, 1.0).str();
  };
  EXPECT_EQ(read(with_length(1))[0].table.columns[0].value_count(), 1U);
  expect_refused(with_length(-1), at_length, "-1 values", "'a'");
  expect_refused(with_length(2), at_values, "2 values", "where 1 fit");
  expect_refused(with_length(2147483647), at_values, "2147483647 values");
  expect_refused(with_length(1).substr(0, start + 11), at_values, "1 values", "where 0 fit");
  expect_refused(test::Bytes(header("binary_little_endian", "element e 1\nproperty list uint64 double a\n"))
                     .add(std::uint64_t{1} << 61, 1.0)
                     .str(),
                 "2305843009213693952 values");
  expect_refused(test::Bytes(header("binary_little_endian",
                                    "element e 1\nproperty list uchar char a\nproperty list short char b\n"))
                     .add(std::uint8_t{1}, std::int8_t{5}, std::int8_t{0})
                     .str(),
                 "the end of the file", "number of values", "'b'");
}

TEST(PlyBody, RefusesMoreThanTheHeaderDeclares) {
  const std::string ascii = header("ascii", "element e 1\nproperty uchar a\n") + "1\n";
  EXPECT_EQ(read(ascii + " \t\r\n\n")[0].table.rows, 1U);
  EXPECT_EQ(read(ascii + '\0')[0].table.rows, 1U);
  expect_refused(ascii + "\n\n2\n", "line 9", "4 more bytes");
  const std::string binary = header("binary_little_endian", "element e 1\nproperty uchar a\n") + '1';
  EXPECT_EQ(read(binary + "\r\n")[0].table.rows, 1U);
  EXPECT_EQ(read(binary + std::string(7, '\0'))[0].table.rows, 1U);
  expect_refused(binary + std::string(8, '\0'), "byte " + std::to_string(binary.size()), "8 more bytes");
  expect_refused(binary + "\n2", "byte " + std::to_string(binary.size()), "2 more bytes",
                 "the end of the file");
}

}  // namespace
}  // namespace keenline
