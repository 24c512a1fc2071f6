#include "keenline/io/text_lines.h"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using test::expect_error;

class CountedBytes : public Progress {
 public:
  void advance(std::uint64_t units) override { bytes += units; }
  [[nodiscard]] bool cancelled() const override { return stop; }
  std::uint64_t bytes = 0;
  bool stop = false;
};

std::vector<std::string> all_lines(const Source& source, Progress& progress = no_progress()) {
  TextLines lines(source, progress);
  std::vector<std::string> result;
  for (std::string_view line; lines.next(line);) result.emplace_back(line);
  return result;
}

TEST(TextLines, EndLinesAsUnixWindowsAndOldMacintoshDo) {
  const std::vector<std::string> expected{"one", "", "three"};
  EXPECT_EQ(all_lines({"a", "one\n\nthree"}), expected);
  EXPECT_EQ(all_lines({"a", "one\r\n\r\nthree\r\n"}), expected);
  EXPECT_EQ(all_lines({"a", "one\r\rthree\r"}), expected);
  EXPECT_EQ(all_lines({"a", "\xEF\xBB\xBFone\n\nthree\n"}), expected);
  EXPECT_TRUE(all_lines({"a", ""}).empty());
}

TEST(TextLines, CountLinesFromTheGivenOne) {
  const Source source{"a", "x\ny\n"};
  TextLines lines(source, source.bytes, 7, no_progress());
  std::string_view line;
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(lines.number(), 7U);
  EXPECT_EQ(lines.rest(), "y\n");
  ASSERT_TRUE(lines.next(line));
  EXPECT_EQ(lines.number(), 8U);
  EXPECT_FALSE(lines.next(line));
  expect_error<InputError>([&] { lines.refuse_end("more"); },
                           "a: line 8: found the end of the file, expected more");
}

TEST(TextLines, FindContentAndComments) {
  const Source source{"a", "# first \n\n  #\nv 1 # second\n \t\n"};
  TextLines lines(source, no_progress());
  std::string_view line;
  std::vector<std::string> comments;
  ASSERT_TRUE(lines.next_content(line, &comments));
  EXPECT_EQ(line, "v 1");
  EXPECT_EQ(lines.number(), 4U);
  EXPECT_EQ(comments, (std::vector<std::string>{"first", "second"}));
  EXPECT_FALSE(lines.next_content(line));
}

TEST(TextLines, RefuseZeroBytesWhereTheyStand) {
  const std::string text("good\nalso good\nb\0d\n", 19);
  expect_error<InputError>(
      [&] {
        (void)all_lines({"a", text});
      },
      "a: line 3: found a zero byte, expected text");
}

TEST(TextLines, GiveLongLinesWhole) {
  const std::string line(200'000, 'x');
  const std::string text = line + "\n" + line;
  EXPECT_EQ(all_lines({"a", text}), (std::vector<std::string>{line, line}));
}

TEST(TextLines, ReportEveryByteOnce) {
  std::string text = "\xEF\xBB\xBF";
  for (int i = 0; i < 20'000; ++i) text += "line\r\n";
  CountedBytes progress;
  EXPECT_EQ(all_lines({"a", text}, progress).size(), 20'000U);
  EXPECT_EQ(progress.bytes, text.size());
}

TEST(TextLines, StopSoonWhenCancelled) {
  CountedBytes progress;
  progress.stop = true;
  std::string text;
  for (int i = 0; i < 100'000; ++i) text += "line\n";
  const Source source{"a", text};
  TextLines lines(source, progress);
  std::string_view line;
  EXPECT_THROW(while (lines.next(line)){}, Cancelled);
  EXPECT_LT(lines.number(), 50'000U);
}

TEST(TextLines, StopInsideALongLineWhenCancelled) {
  CountedBytes progress;
  progress.stop = true;
  const std::string text(200'000, 'x');
  const Source source{"a", text};
  TextLines lines(source, progress);
  std::string_view line;
  EXPECT_THROW((void)lines.next(line), Cancelled);
}

TEST(Words, AreSeparatedByBlanks) {
  const Source source{"a", ""};
  Words words(source, "  one\ttwo  three ", 1);
  EXPECT_EQ(words.next(), "one");
  EXPECT_EQ(words.next(), "two");
  EXPECT_EQ(words.next(), "three");
  EXPECT_EQ(words.next(), "");
  EXPECT_EQ(words.next(), "");
}

TEST(Words, AreNumbersOrRefused) {
  const Source source{"a.off", ""};
  Words words(source, "1.5 -7 300 1e999 x 9", 12);
  EXPECT_EQ(words.number<double>(), 1.5);
  EXPECT_EQ(words.number<std::int32_t>(), -7);
  expect_error<InputError>([&] { (void)words.number<std::uint8_t>(); },
                           "a.off: line 12: found '300', expected an integer from 0 to 255");
  expect_error<InputError>([&] { (void)words.number<double>(); }, "'1e999'", "64-bit float");
  expect_error<InputError>([&] { (void)words.number<double>("a radius"); }, "found 'x', expected a radius");
  expect_error<InputError>([&] { words.expect_end(); }, "found '9', expected the end of the line");
  EXPECT_NO_THROW(words.expect_end());
  expect_error<InputError>([&] { (void)words.number<double>(); },
                           "line 12: found the end of the line, expected a number");
}

}  // namespace
}  // namespace keenline
