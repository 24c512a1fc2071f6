#include "keenline/io/text.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

using namespace std::string_literals;

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  LineReader reader(text);
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  EXPECT_EQ(reader.number(), lines.size());
  EXPECT_TRUE(reader.rest().empty());
  return lines;
}

using Lines = std::vector<std::string>;

TEST(LineReader, EndsLinesAtEveryKindOfLineEnd) {
  EXPECT_EQ(lines_of("a\nb\n"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a\r\nb\r\n"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a\rb\r"), (Lines{"a", "b"}));
}

TEST(LineReader, TheEndOfTheTextEndsTheLastLine) {
  EXPECT_EQ(lines_of("a\nb"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a\r\nb\r"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a\rb"), (Lines{"a", "b"}));
  EXPECT_EQ(lines_of("a"), (Lines{"a"}));
  EXPECT_EQ(lines_of(""), Lines{});
}

TEST(LineReader, KeepsEmptyLines) {
  EXPECT_EQ(lines_of("\n\na\n\n"), (Lines{"", "", "a", ""}));
  EXPECT_EQ(lines_of("\r\n\r\n"), (Lines{"", ""}));
}

TEST(LineReader, TheFirstLineEndDecides) {
  EXPECT_EQ(lines_of("a\nb\rc\n"), (Lines{"a", "b\rc"}));
  EXPECT_EQ(lines_of("a\rb\nc\r"), (Lines{"a", "b\nc"}));
}

TEST(LineReader, TellsNumberAndRest) {
  LineReader reader("a\nb\nc", 10);
  std::string_view line;
  ASSERT_TRUE(reader.next(line));
  ASSERT_TRUE(reader.next(line));
  EXPECT_EQ(line, "b");
  EXPECT_EQ(reader.number(), 11U);
  EXPECT_EQ(reader.rest(), "c");
}

TEST(Text, TakesWords) {
  std::string_view text = " \tone two\t\tthree ";
  EXPECT_EQ(take_word(text), "one");
  EXPECT_EQ(take_word(text), "two");
  EXPECT_EQ(take_word(text), "three");
  EXPECT_EQ(take_word(text), "");
  EXPECT_EQ(take_word(text), "");
}

TEST(Text, TrimsBothEnds) {
  EXPECT_EQ(trimmed(" \ta b\r\t "), "a b");
  EXPECT_EQ(trimmed(" \t\r"), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Text, SkipsTheByteOrderMark) {
  EXPECT_EQ(without_bom("\xEF\xBB\xBFply"), "ply");
  EXPECT_EQ(without_bom("\xEF\xBBply"), "\xEF\xBBply");
  EXPECT_EQ(without_bom("ply"), "ply");
}

TEST(Text, ComparesPrefixesIgnoringCase) {
  EXPECT_TRUE(starts_with_ignoring_case("SoLiD cube", "solid"));
  EXPECT_FALSE(starts_with_ignoring_case("soli", "solid"));
  EXPECT_FALSE(starts_with_ignoring_case("s\x4flid", "salid"));
  EXPECT_TRUE(starts_with_ignoring_case("", ""));
}

template <typename T>
T parsed(std::string_view word) {
  T value{};
  EXPECT_EQ(parse_number(word, value), Parsed::Ok) << word;
  return value;
}

template <typename T>
Parsed outcome(std::string_view word) {
  T value{};
  return parse_number(word, value);
}

TEST(ParseNumber, Floats) {
  EXPECT_EQ(parsed<double>("1"), 1.0);
  EXPECT_EQ(parsed<double>("-1.5"), -1.5);
  EXPECT_EQ(parsed<double>("+1.5e+3"), 1500.0);
  EXPECT_EQ(parsed<double>(".5"), 0.5);
  EXPECT_EQ(parsed<double>("5."), 5.0);
  EXPECT_EQ(parsed<double>("0.1"), 0.1);
  EXPECT_EQ(parsed<float>("0.1"), 0.1F);
  EXPECT_EQ(parsed<double>("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_EQ(parsed<double>("5e-324"), std::numeric_limits<double>::denorm_min());
  EXPECT_TRUE(std::signbit(parsed<double>("-0")));
}

TEST(ParseNumber, TheNearestDoubleOfManyDigits) {
  EXPECT_EQ(parsed<double>("9007199254740993"), 9007199254740992.0);        // a tie: to even
  EXPECT_EQ(parsed<double>("9007199254740993.00001"), 9007199254740994.0);  // just above it
}

TEST(ParseNumber, NotFinite) {
  for (const char* word : {"nan", "NaN", "NAN", "-nan"})
    EXPECT_TRUE(std::isnan(parsed<double>(word))) << word;
  for (const char* word : {"inf", "Inf", "INF", "+inf", "infinity", "Infinity"})
    EXPECT_EQ(parsed<double>(word), std::numeric_limits<double>::infinity()) << word;
  EXPECT_EQ(parsed<double>("-inf"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(parsed<float>("-INF"), -std::numeric_limits<float>::infinity());
}

TEST(ParseNumber, FloatOverflowIsOutOfRangeAndUnderflowRounds) {
  EXPECT_EQ(outcome<double>("1e999"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<double>("-1e309"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<float>("1e39"), Parsed::OutOfRange);
  EXPECT_EQ(parsed<double>("1e-999"), 0.0);
}

TEST(ParseNumber, WhatIsNoFloat) {
  for (const char* word : {"", "abc", "1,5", "1.5x", "--1", "+-1", "++1", "1e", "0x10", " 1", "1 ", ".", "-",
                           "+", "1.2.3", "in"})
    EXPECT_EQ(outcome<double>(word), Parsed::NotANumber) << word;
  EXPECT_EQ(outcome<double>("1\0"s), Parsed::NotANumber);
}

TEST(ParseNumber, Integers) {
  EXPECT_EQ(parsed<std::int8_t>("-128"), -128);
  EXPECT_EQ(parsed<std::uint8_t>("255"), 255);
  EXPECT_EQ(parsed<std::uint8_t>("+7"), 7);
  EXPECT_EQ(parsed<std::uint8_t>("007"), 7);
  EXPECT_EQ(parsed<std::int64_t>("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parsed<std::uint64_t>("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
}

TEST(ParseNumber, WholeFractionsAreIntegers) {
  EXPECT_EQ(parsed<std::uint8_t>("255.0"), 255);
  EXPECT_EQ(parsed<std::int32_t>("-1e3"), -1000);
  EXPECT_EQ(outcome<std::uint8_t>("255.5"), Parsed::NotANumber);
  EXPECT_EQ(outcome<std::uint8_t>("256.0"), Parsed::OutOfRange);
}

TEST(ParseNumber, IntegersOutOfRange) {
  EXPECT_EQ(outcome<std::int8_t>("128"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<std::uint8_t>("-1"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<std::int32_t>("2147483648"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<std::uint64_t>("18446744073709551616"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<std::int64_t>("1e300"), Parsed::OutOfRange);
  EXPECT_EQ(outcome<std::int64_t>("inf"), Parsed::OutOfRange);
}

TEST(ParseNumber, WhatIsNoInteger) {
  for (const char* word : {"", "abc", "1x", "nan", "0x10", "--1", "1,5"})
    EXPECT_EQ(outcome<std::int32_t>(word), Parsed::NotANumber) << word;
}

TEST(ParseNumber, DescriptionsTellTheRange) {
  EXPECT_EQ(description_of_number<double>(), "a number");
  EXPECT_EQ(description_of_number<std::uint8_t>(), "an integer from 0 to 255");
  EXPECT_EQ(description_of_number<std::int16_t>(), "an integer from -32768 to 32767");
}

TEST(Grouped, AThousandAtATime) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(grouped(18446744073709551615U), "18,446,744,073,709,551,615");
}

}  // namespace
}  // namespace keenline
