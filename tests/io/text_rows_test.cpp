#include "keenline/io/text_rows.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using namespace std::string_literals;

RowFormat format_xyz(char delimiter = ' ') {
  RowFormat format;
  format.delimiter = delimiter;
  format.names = {"x", "y", "z"};
  format.types.assign(3, ScalarType::Float64);
  return format;
}

Rows read(std::string_view text, const RowFormat& format, std::optional<std::uint64_t> count = {},
          std::uint64_t first_line = 1) {
  return read_rows({"rows.txt", text}, text, first_line, format, count, no_progress());
}

template <typename T>
std::vector<T> values_of(const Column& column) {
  EXPECT_EQ(column.type(), scalar_type_of<T>());
  if (column.type() != scalar_type_of<T>()) return {};
  const auto values = column.values<T>();
  return {values.begin(), values.end()};
}

using Doubles = std::vector<double>;

void expect_refused(std::string_view text, const RowFormat& format, std::string_view place,
                    std::string_view found, std::string_view expected,
                    std::optional<std::uint64_t> count = {}) {
  test::expect_error<InputError>([&] { (void)read(text, format, count); }, "rows.txt: ", place, found,
                                 expected);
}

TEST(TextRows, ReadsBlankSeparatedNumbers) {
  const Rows rows = read("1 2 3\n\t4.5  -5\t+6 \n", format_xyz());
  ASSERT_EQ(rows.count, 2U);
  EXPECT_EQ(values_of<double>(rows.columns[0]), (Doubles{1, 4.5}));
  EXPECT_EQ(values_of<double>(rows.columns[1]), (Doubles{2, -5}));
  EXPECT_EQ(values_of<double>(rows.columns[2]), (Doubles{3, 6}));
  EXPECT_EQ(rows.columns[2].name(), "z");
  EXPECT_EQ(rows.consumed, 19U);
  EXPECT_EQ(rows.next_line, 3U);
}

TEST(TextRows, ReadsOtherDelimitersWithBlanksAroundThem) {
  for (const char delimiter : {',', ';', '\t'}) {
    std::string text = "1|2|3\n 4 | 5 |6\n";
    std::replace(text.begin(), text.end(), '|', delimiter);
    const Rows rows = read(text, format_xyz(delimiter));
    EXPECT_EQ(values_of<double>(rows.columns[1]), (Doubles{2, 5})) << delimiter;
  }
}

TEST(TextRows, ReadsEveryLineEnd) {
  for (const std::string& end : {"\n"s, "\r\n"s, "\r"s}) {
    const Rows rows = read("1 2 3" + end + end + "4 5 6", format_xyz());
    EXPECT_EQ(values_of<double>(rows.columns[2]), (Doubles{3, 6}));
    EXPECT_EQ(rows.next_line, 4U);
    EXPECT_EQ(rows.consumed, 10 + 2 * end.size());
  }
}

TEST(TextRows, ReadsEveryType) {
  RowFormat format;
  format.types = {ScalarType::Int8,    ScalarType::UInt8,  ScalarType::Int16, ScalarType::UInt16,
                  ScalarType::Int32,   ScalarType::UInt32, ScalarType::Int64, ScalarType::UInt64,
                  ScalarType::Float32, ScalarType::Float64};
  for (const ScalarType type : format.types) format.names.emplace_back(name_of(type));
  const Rows rows = read(
      "-128 255 -32768 65535 -2147483648 4294967295 -9223372036854775808 18446744073709551615 0.1 0.1\n"
      "1.0 2.0 3.0 4.0 5.0 6.0 7.0 8.0 9 10\n",
      format);
  EXPECT_EQ(values_of<std::int8_t>(rows.columns[0]), (std::vector<std::int8_t>{-128, 1}));
  EXPECT_EQ(values_of<std::uint8_t>(rows.columns[1]), (std::vector<std::uint8_t>{255, 2}));
  EXPECT_EQ(values_of<std::int16_t>(rows.columns[2]), (std::vector<std::int16_t>{-32768, 3}));
  EXPECT_EQ(values_of<std::uint16_t>(rows.columns[3]), (std::vector<std::uint16_t>{65535, 4}));
  EXPECT_EQ(values_of<std::int32_t>(rows.columns[4]), (std::vector<std::int32_t>{-2147483647 - 1, 5}));
  EXPECT_EQ(values_of<std::uint32_t>(rows.columns[5]), (std::vector<std::uint32_t>{4294967295U, 6}));
  EXPECT_EQ(values_of<std::int64_t>(rows.columns[6])[0], std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(values_of<std::uint64_t>(rows.columns[7])[0], std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(values_of<float>(rows.columns[8]), (std::vector<float>{0.1F, 9}));
  EXPECT_EQ(values_of<double>(rows.columns[9]), (Doubles{0.1, 10}));
}

TEST(TextRows, ReadsNotFiniteNumbers) {
  const Rows rows = read("nan NaN -nan\ninf -Inf INFINITY\n", format_xyz());
  for (const Column& column : rows.columns) EXPECT_TRUE(std::isnan(column.value(0)));
  EXPECT_EQ(rows.columns[0].value(1), std::numeric_limits<double>::infinity());
  EXPECT_EQ(rows.columns[1].value(1), -std::numeric_limits<double>::infinity());
}

TEST(TextRows, SkipsCommentsOnlyWhenTold) {
  RowFormat format = format_xyz();
  format.comments = true;
  const Rows rows = read("# one\n1 2 3 // two\n  // three\n4 5 6# four\n", format);
  EXPECT_EQ(values_of<double>(rows.columns[0]), (Doubles{1, 4}));
  EXPECT_EQ(rows.next_line, 5U);
  expect_refused("# one\n1 2 3\n", format_xyz(), "line 1", "2 values", "3 (x, y, z)");
}

TEST(TextRows, TakesQuotesOffOnlyWhenTold) {
  RowFormat format = format_xyz(',');
  expect_refused("\"1\",2,3\n", format, "line 1", "'\"1\"' in column 'x'", "a number");
  format.quotes = true;
  EXPECT_EQ(read("\"1\",2,\"3\"\n", format).columns[2].value(0), 3);
}

TEST(TextRows, KnowsTrailingDelimiters) {
  RowFormat format = format_xyz(';');
  format.trailing_delimiter = true;
  EXPECT_EQ(read("1;2;3;\n4;5;6; \n", format).count, 2U);
  expect_refused("1;2;3;\n1;2;3\n", format, "line 2", "no ';' at the end", "one");
  expect_refused("1;2;3;4\n", format, "line 1", "4 values", "3 (x, y, z)");
  expect_refused("1;2;3;4;\n", format, "line 1", "4 values", "3 (x, y, z)");
  expect_refused("1;2;\n", format, "line 1", "2 values", "3 (x, y, z)");
  expect_refused("1;2;3;\n", format_xyz(';'), "line 1", "4 values", "3 (x, y, z)");
}

TEST(TextRows, RefusesWhatIsNoNumber) {
  expect_refused("1 2 3\n\n1 2 abc\n", format_xyz(), "line 3", "'abc' in column 'z'", "expected a number");
  expect_refused("1,,3\n", format_xyz(','), "line 1", "an empty field in column 'y'", "a number");
  expect_refused("1;2,5;3\n", format_xyz(';'), "line 1", "'2,5' in column 'y'",
                 "a number with a decimal point");
  expect_refused("1 1e999 3\n", format_xyz(), "line 1", "'1e999' in column 'y'",
                 "that a 64-bit float can hold");
  expect_refused("1 2 0x10\n", format_xyz(), "line 1", "'0x10'", "a number");
  expect_refused("1 2 3\x1a\n", format_xyz(), "line 1", "'3\\x1a'", "a number");
}

TEST(TextRows, RefusesIntegersOutOfRange) {
  RowFormat format;
  format.names = {"red"};
  format.types = {ScalarType::UInt8};
  expect_refused("255\n300\n", format, "line 2", "'300' in column 'red'", "an integer from 0 to 255");
  expect_refused("-1\n", format, "line 1", "'-1'", "an integer from 0 to 255");
  expect_refused("1.5\n", format, "line 1", "'1.5'", "an integer from 0 to 255");
}

TEST(TextRows, RefusesRaggedRows) {
  expect_refused("1 2 3\n1 2 3 4\n", format_xyz(), "line 2", "4 values", "3 (x, y, z)");
  expect_refused("1 2\n", format_xyz(), "line 1", "2 values", "3 (x, y, z)");
  expect_refused("1\n", format_xyz(','), "line 1", "1 value,", "3 (x, y, z)");
  RowFormat five = format_xyz();
  five.names = {"x", "y", "z", "a", "b"};
  five.types.assign(5, ScalarType::Float64);
  expect_refused("1 2 3 4\n", five, "line 1", "4 values", "5 (x, y, z, …)");
}

TEST(TextRows, StopsAfterTheCount) {
  const std::string_view text = "1 2 3\n\n4 5 6\nnot a row\n";
  const Rows rows = read(text, format_xyz(), 2, 10);
  EXPECT_EQ(values_of<double>(rows.columns[0]), (Doubles{1, 4}));
  EXPECT_EQ(text.substr(rows.consumed), "not a row\n");
  EXPECT_EQ(rows.next_line, 13U);
  const Rows none = read(text, format_xyz(), 0, 10);
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.consumed, 0U);
  EXPECT_EQ(none.next_line, 10U);
  ASSERT_EQ(none.columns.size(), 3U);
  EXPECT_EQ(none.columns[0].rows(), 0U);
}

TEST(TextRows, RefusesMissingRowsWithoutAllocatingThem) {
  expect_refused("1 2 3\n4 5 6\n", format_xyz(), "line 2", "the end of the file after 2 rows", "3 rows", 3);
  expect_refused("", format_xyz(), "line 1", "the end of the file after 0 rows", "1 rows", 1);
  expect_refused("1 2 3\n", format_xyz(), "line 1", "after 1 rows", "9223372036854775808",
                 std::uint64_t{1} << 63U);
  expect_refused("1 2 3\n", format_xyz(), "line 1", "after 1 rows", "rows",
                 std::numeric_limits<std::uint64_t>::max());
  expect_refused("1 2 x\n", format_xyz(), "line 1", "'x'", "a number", 5);  // the first mistake comes first
}

TEST(TextRows, RefusesZeroBytes) {
  expect_refused("1 2 3\n4 5\0 6\n"s, format_xyz(), "line 2", "a zero byte", "text");
  expect_refused("\0"s, format_xyz(), "line 1", "a zero byte", "text");
  expect_refused("1 2 3\n" + std::string(1000, '\0'), format_xyz(), "line 2", "a zero byte", "text", 2);
  expect_refused("1 2 x\n4 5\0 6\n"s, format_xyz(), "line 1", "'x'", "a number");
  EXPECT_EQ(read("1 2 3\n\0"s, format_xyz(), 1).count, 1U);  // beyond what was asked for
}

TEST(TextRows, ReadsAPartOfTheSource) {
  const std::string bytes = "header\n1 2 3\n";
  const Rows rows =
      read_rows({"a", bytes}, std::string_view(bytes).substr(7), 2, format_xyz(), {}, no_progress());
  EXPECT_EQ(rows.consumed, 6U);
  EXPECT_EQ(rows.next_line, 3U);
}

/// Some megabytes: many chunks and several batches.
std::string long_text(std::size_t rows) {
  std::string text;
  for (std::size_t i = 0; i < rows; ++i)
    fmt::format_to(std::back_inserter(text), "{} {}.5 -{}e-3\n", i, i, i);
  return text;
}

TEST(TextRows, ManyChunksKeepTheOrder) {
  const std::size_t count = 200'000;
  const std::string text = long_text(count);
  for (const bool with_count : {false, true}) {
    const Rows rows =
        read(text, format_xyz(), with_count ? std::optional<std::uint64_t>(count - 1) : std::nullopt);
    ASSERT_EQ(rows.count, count - (with_count ? 1 : 0));
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < rows.count; ++i)
      if (rows.columns[0].value(i) != static_cast<double>(i) ||
          rows.columns[1].value(i) != static_cast<double>(i) + 0.5)
        ++wrong;
    EXPECT_EQ(wrong, 0U);
    EXPECT_EQ(rows.next_line, rows.count + 1);
    EXPECT_EQ(rows.consumed, with_count ? text.rfind('\n', text.size() - 2) + 1 : text.size());
  }
}

TEST(TextRows, TheFirstMistakeOfManyWinsOnAnyNumberOfThreads) {
  std::string text = long_text(100'000);
  std::vector<std::size_t> lines;  // starts
  for (std::size_t i = 0; i < text.size(); i = text.find('\n', i) + 1) lines.push_back(i);
  for (const std::size_t bad : {99'999U, 70'001U, 50'000U, 30'000U}) text[lines[bad]] = 'x';
  for (const std::size_t threads : {1U, 2U, 8U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    expect_refused(text, format_xyz(), "line 30001:", "in column 'x'", "a number");
  }
}

TEST(TextRows, InfersIntegerTypes) {
  RowFormat format;
  format.delimiter = ',';
  format.quotes = true;
  format.names = {"a", "b", "c", "d", "e", "f", "g", "h"};
  format.types.assign(8, ScalarType::Float64);
  format.inferred = {0, 1, 2, 3, 4, 5, 6};
  const Rows rows = read(
      "1,-2147483648,2147483648,18446744073709551615,1.0,-0,\"7\",1\n"
      "2,2147483647,-1,0,2,0,+8,2\n",
      format);
  EXPECT_EQ(values_of<std::int32_t>(rows.columns[0]), (std::vector<std::int32_t>{1, 2}));
  EXPECT_EQ(rows.columns[1].type(), ScalarType::Int32);
  EXPECT_EQ(values_of<std::int64_t>(rows.columns[2]), (std::vector<std::int64_t>{2147483648, -1}));
  EXPECT_EQ(values_of<std::uint64_t>(rows.columns[3])[0], std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(rows.columns[4].type(), ScalarType::Float64);
  EXPECT_TRUE(std::signbit(values_of<double>(rows.columns[5])[0]));  // an integer has no -0
  EXPECT_EQ(values_of<std::int32_t>(rows.columns[6]), (std::vector<std::int32_t>{7, 8}));
  EXPECT_EQ(rows.columns[7].type(), ScalarType::Float64);  // not to be inferred
  EXPECT_TRUE(rows.notes.empty());
}

TEST(TextRows, SaysWhenIntegersAreRounded) {
  RowFormat format = format_xyz();
  format.inferred = {1, 2};
  // 2^53 + 1 and 10^23 are no doubles; 2^70 and 10^22 are.
  const Rows rows = read(
      "0 9007199254740993 1180591620717411303424\n"
      "0 0.5 10000000000000000000000\n"
      "0 100000000000000000000000 0\n",
      format);
  EXPECT_EQ(rows.columns[1].type(), ScalarType::Float64);
  EXPECT_EQ(rows.columns[2].type(), ScalarType::Float64);
  EXPECT_EQ(rows.notes, std::vector<std::string>{"column 'y': 2 integers were rounded to 64-bit floats"});
  EXPECT_EQ(read("0 -1 0\n0 18446744073709551615 0\n", format).columns[1].type(), ScalarType::Float64);
}

TEST(TextRows, InfersOverAllChunks) {
  RowFormat format = format_xyz();
  format.inferred = {0};
  std::string text = long_text(100'000);
  EXPECT_EQ(read(text, format).columns[0].type(), ScalarType::Int32);
  text += "5000000000 0 0\n";
  EXPECT_EQ(read(text, format).columns[0].type(), ScalarType::Int64);
  text += "0.5 0 0\n";
  EXPECT_EQ(read(text, format).columns[0].type(), ScalarType::Float64);
  EXPECT_EQ(read("", format).columns[0].type(), ScalarType::Float64);
}

class Recorder : public Progress {
 public:
  void advance(std::uint64_t units) override { done += units; }
  [[nodiscard]] bool cancelled() const override { return stop; }
  std::atomic<std::uint64_t> done = 0;
  bool stop = false;
};

TEST(TextRows, ReportsEveryByteOnce) {
  const std::string text = long_text(100'000);
  Recorder progress;
  (void)read_rows({"a", text}, text, 1, format_xyz(), {}, progress);
  EXPECT_EQ(progress.done, text.size());
  Recorder part;
  const Rows rows = read_rows({"a", text}, text, 1, format_xyz(), 54'321, part);
  EXPECT_EQ(part.done, rows.consumed);
}

TEST(TextRows, CanBeCancelled) {
  Recorder progress;
  progress.stop = true;
  EXPECT_THROW((void)read_rows({"a", "1 2 3\n"}, "1 2 3\n", 1, format_xyz(), {}, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
