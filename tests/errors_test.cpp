#include "keenline/errors.h"

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(Errors, InputErrorNamesFilePlaceFoundAndExpected) {
  EXPECT_STREQ(InputError("a.xyz", Place::line(12), quoted("abc"), "a number").what(),
               "a.xyz: line 12: found 'abc', expected a number");
  EXPECT_STREQ(InputError("a.ply", Place::byte(0), "nothing", "'ply'").what(),
               "a.ply: byte 0: found nothing, expected 'ply'");
  EXPECT_STREQ(InputError("a.ply", Place::file(), "9 points", "10").what(),
               "a.ply: found 9 points, expected 10");
  EXPECT_STREQ(InputError("a.ply", "cannot be opened").what(), "a.ply: cannot be opened");
}

TEST(Errors, ControlCharactersInFileNamesCannotForgeALine) {
  EXPECT_STREQ(InputError("a\nb\x1b[31m", "is a folder").what(), "a\\x0ab\\x1b[31m: is a folder");
  EXPECT_STREQ(OutputError("a\rb", "is full").what(), "a\\x0db: is full");
}

TEST(Errors, EscapedKeepsTextAndHidesTheRest) {
  EXPECT_EQ(escaped("plain text"), "plain text");
  EXPECT_EQ(escaped("Straße 東京 🙂"), "Straße 東京 🙂");
  EXPECT_EQ(escaped(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(escaped("\xff\xc3"), "\\xff\\xc3");           // not UTF-8
  EXPECT_EQ(escaped("\xc2\x9b"), "\\xc2\\x9b");           // a control character of the upper half: CSI
  EXPECT_EQ(escaped("\xe2\x80\xae"), "\\xe2\\x80\\xae");  // right-to-left override
  EXPECT_EQ(escaped("\xe2\x80\xa8"), "\\xe2\\x80\\xa8");  // line separator
  EXPECT_EQ(escaped("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80");  // overlong, surrogate
}

TEST(Errors, EscapedEndsLongText) {
  EXPECT_EQ(escaped("0123456789", 10), "0123456789");
  EXPECT_EQ(escaped("0123456789a", 10), "0123456789...");
  EXPECT_EQ(quoted(std::string(100000, 'x'), 5), "'xxxxx...'");
}

TEST(Errors, AllAreErrors) {
  EXPECT_THROW(throw InvalidArgument("x"), Error);
  EXPECT_THROW(throw OutOfMemory("x"), Error);
  EXPECT_THROW(throw Cancelled(), Error);
  EXPECT_FALSE(system_message(2).empty());
}

}  // namespace
}  // namespace keenline
