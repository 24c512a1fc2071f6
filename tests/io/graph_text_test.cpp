#include "keenline/io/graph_text.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keenline/io/text.h"

namespace keenline {
namespace {

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string string(std::string_view value) {
  std::string text;
  append_json(text, value);
  return text;
}

TEST(GraphText, NumbersAreTheShortestThatReadBack) {
  EXPECT_EQ(number(0.1), "0.1");
  EXPECT_EQ(number(4500000.123), "4500000.123");
  EXPECT_EQ(number(1), "1");
  EXPECT_EQ(number(-0.0), "0");
  for (const double value :
       {1.0 / 3, std::numeric_limits<double>::min(), 1e150, -5e-324, 123456789012345678.0}) {
    double back = 0;
    EXPECT_EQ(parse_number(number(value), back), Parsed::Ok);
    EXPECT_EQ(back, value);
  }
}

TEST(GraphText, ListsAndPointsAreJson) {
  std::string text = "> ";
  append_json(text, Point{1, 2.5, -3});
  EXPECT_EQ(text, "> [1, 2.5, -3]");
  text.clear();
  append_json_list(text, std::vector<double>{1, 2}, append_number);
  EXPECT_EQ(text, "[1, 2]");
  text.clear();
  append_json_list(text, std::vector<double>{}, append_number);
  EXPECT_EQ(text, "[]");
}

TEST(GraphText, StringsAreEscaped) {
  EXPECT_EQ(string("a\"b\\c\n\x01"), "\"a\\\"b\\\\c\\n\\u0001\"");
  EXPECT_EQ(string("Gauß-Krüger €, 𝄞"), "\"Gauß-Krüger €, 𝄞\"");
}

TEST(GraphText, WhatIsNotUtf8IsReplaced) {
  EXPECT_EQ(string("a\xFF"
                   "b"),
            "\"a\xEF\xBF\xBD"
            "b\"");
  // Cut off, overlong, a surrogate, past the last character: replacements, and what follows stays.
  for (const std::string_view bad : {"\xE2\x82", "\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80"}) {
    const std::string text = string(std::string(bad) + "x");
    EXPECT_EQ(text.substr(0, 4), "\"\xEF\xBF\xBD");
    EXPECT_EQ(nlohmann::json::parse(text).get<std::string>().back(), 'x');
  }
}

}  // namespace
}  // namespace keenline
