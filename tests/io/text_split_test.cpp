#include "keenline/io/text_split.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

using Fields = std::vector<std::string>;

Fields fields_of(std::string_view line, char delimiter) {
  Fields fields;
  FieldReader reader(line, delimiter);
  for (std::string_view field; reader.next(field);) fields.emplace_back(field);
  EXPECT_EQ(count_fields(line, delimiter), fields.size());
  return fields;
}

TEST(TextSplit, FindsTheLineEnd) {
  EXPECT_EQ(line_end_of("a\nb\r"), '\n');
  EXPECT_EQ(line_end_of("a\r\nb\r"), '\n');
  EXPECT_EQ(line_end_of("a\rb\n"), '\r');
  EXPECT_EQ(line_end_of("a"), '\n');
  EXPECT_EQ(line_end_of(""), '\n');
}

TEST(TextSplit, TakesLines) {
  std::string_view text = "a\r\n\nb";
  EXPECT_EQ(take_line(text, '\n'), "a");
  EXPECT_EQ(take_line(text, '\n'), "");
  EXPECT_EQ(take_line(text, '\n'), "b");
  EXPECT_TRUE(text.empty());
}

TEST(TextSplit, CutsCommentsOutsideOfQuotes) {
  EXPECT_EQ(without_comment("1 2 3 # four"), "1 2 3 ");
  EXPECT_EQ(without_comment("1 2 3 // four # five"), "1 2 3 ");
  EXPECT_EQ(without_comment("1/2"), "1/2");
  EXPECT_EQ(without_comment("# all"), "");
  EXPECT_EQ(without_comment("x,\"a#b\",\"c//d\" # e"), "x,\"a#b\",\"c//d\" ");
  EXPECT_EQ(without_comment("x,\"a#b"), "x,\"a#b");
}

TEST(TextSplit, BlanksAreOneDelimiter) {
  EXPECT_EQ(fields_of(" 1 \t 2\t3 ", ' '), (Fields{"1", "2", "3"}));
  EXPECT_EQ(fields_of("", ' '), Fields{});
}

TEST(TextSplit, EveryOtherDelimiterCounts) {
  EXPECT_EQ(fields_of(" 1 , 2,3", ','), (Fields{"1", "2", "3"}));
  EXPECT_EQ(fields_of("1,,3,", ','), (Fields{"1", "", "3", ""}));
  EXPECT_EQ(fields_of("1;2", ','), (Fields{"1;2"}));
  EXPECT_EQ(fields_of("1 \t\t3", '\t'), (Fields{"1", "", "3"}));
}

TEST(TextSplit, TakesQuotesOff) {
  EXPECT_EQ(unquoted("\"1.5\""), "1.5");
  EXPECT_EQ(unquoted("\"\""), "");
  EXPECT_EQ(unquoted("\""), "\"");
  EXPECT_EQ(unquoted("\"1"), "\"1");
  EXPECT_EQ(unquoted("1"), "1");
}

TEST(TextSplit, SplitsQuotedNames) {
  EXPECT_EQ(split_quoted(R"(x, "y" ,"a, b","say ""z""",c)", ','),
            (Fields{"x", "y", "a, b", "say \"z\"", "c"}));
  EXPECT_EQ(split_quoted(R"("x 1" y  "z")", ' '), (Fields{"x 1", "y", "z"}));
  EXPECT_EQ(split_quoted("\tx a\t\ty \t", '\t'), (Fields{"", "x a", "", "y"}));
  EXPECT_EQ(split_quoted("x,y,", ','), (Fields{"x", "y"}));
  EXPECT_EQ(split_quoted(",x,,y", ','), (Fields{"", "x", "", "y"}));
  EXPECT_EQ(split_quoted("x,\"y,z", ','), (Fields{"x", "y,z"}));
  EXPECT_EQ(split_quoted("\"\",x", ','), (Fields{"", "x"}));
  EXPECT_EQ(split_quoted(" ", ','), Fields{});
}

TEST(TextSplit, GuessesTheDelimiter) {
  EXPECT_EQ(guess_delimiter("1 2\t3"), '\t');
  EXPECT_EQ(guess_delimiter("1, 2\t3"), ',');
  EXPECT_EQ(guess_delimiter("1,5;2,5"), ';');
  EXPECT_EQ(guess_delimiter("\"a;b\" c"), ' ');
}

TEST(TextSplit, KnowsADecimalComma) {
  for (const char* word : {"1,5", "-0,25", "1,5e3", "+1,0"}) EXPECT_TRUE(is_number_with_comma(word)) << word;
  for (const char* word : {"1.5", "1,", ",5", "1,2,3", "a,b", "1,x", "", ","})
    EXPECT_FALSE(is_number_with_comma(word)) << word;
}

}  // namespace
}  // namespace keenline
