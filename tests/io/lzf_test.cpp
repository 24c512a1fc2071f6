#include "keenline/io/lzf.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/progress.h"

#include "support/cancelled_progress.h"

namespace keenline {
namespace {

using namespace std::string_literals;

/// The output, or "position: what was found".
std::string decompress(std::string_view compressed, std::size_t size) {
  std::vector<char> output(size, '?');
  if (const auto error = decompress_lzf(compressed, output, no_progress()))
    return std::to_string(error->position) + ": " + std::string(error->found);
  return {output.begin(), output.end()};
}

TEST(Lzf, CopiesLiterals) {
  EXPECT_EQ(decompress("\0a"s, 1), "a");
  EXPECT_EQ(decompress("\2abc\1de"s, 5), "abcde");
  EXPECT_EQ(decompress("\x1f" + std::string(32, 'x'), 32), std::string(32, 'x'));
  EXPECT_EQ(decompress("", 0), "");
}

TEST(Lzf, RepeatsEarlierBytes) {
  EXPECT_EQ(decompress("\3abcd\x20\3"s, 7), "abcdabc");        // 3 bytes from 4 back
  EXPECT_EQ(decompress("\3abcd\xc0\3"s, 12), "abcdabcdabcd");  // 8 bytes, overlapping
  EXPECT_EQ(decompress("\0a\xc0\0"s, 9), "aaaaaaaaa");         // the last byte, again and again
}

TEST(Lzf, RepeatsMany) {
  EXPECT_EQ(decompress("\0a\xe0\0\0"s, 10), std::string(10, 'a'));      // the shortest long one: 9
  EXPECT_EQ(decompress("\0a\xe0\xff\0"s, 265), std::string(265, 'a'));  // the longest: 264
}

TEST(Lzf, RepeatsFromFar) {
  std::string literals;
  std::string compressed;
  for (int block = 0; block < 256; ++block) {
    const std::string text(32, static_cast<char>(block));
    literals += text;
    compressed += '\x1f' + text;
  }
  ASSERT_EQ(literals.size(), 8192U);
  EXPECT_EQ(decompress(compressed + "\x3f\xff", 8195), literals + literals.substr(0, 3));  // 8192 back
}

TEST(Lzf, TheLargestRatioIsThatOfTheLongestRepetition) { EXPECT_EQ(lzf_largest_ratio, 264 / 3); }

TEST(Lzf, RefusesWhatReachesBeforeTheStart) {
  EXPECT_EQ(decompress("\0a\x20\1"s, 4), "2: a repetition of bytes before the first");
  EXPECT_EQ(decompress("\x20\0"s, 3), "0: a repetition of bytes before the first");
}

TEST(Lzf, RefusesWhatEndsTooEarly) {
  EXPECT_EQ(decompress("\0"s, 1), "0: literal bytes past the end of the compressed data");
  EXPECT_EQ(decompress("\0a\2bc"s, 4), "2: literal bytes past the end of the compressed data");
  EXPECT_EQ(decompress("\0a\x20"s, 4), "2: half a repetition");
  EXPECT_EQ(decompress("\0a\xe0"s, 10), "2: half a repetition");
  EXPECT_EQ(decompress("\0a\xe0\0"s, 10), "2: half a repetition");
}

TEST(Lzf, RefusesAnotherSize) {
  EXPECT_EQ(decompress("\2abc"s, 2), "0: more data than declared");
  EXPECT_EQ(decompress("\0a\xc0\0"s, 8), "2: more data than declared");
  EXPECT_EQ(decompress("\2abc"s, 4), "4: less data than declared");
  EXPECT_EQ(decompress("", 1), "0: less data than declared");
  EXPECT_EQ(decompress("\0a"s, 0), "0: more data than declared");
}

TEST(Lzf, AnyBytesAreReadOrRefused) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 2000; ++trial) {
    std::string bytes(random() % 64, '\0');
    for (char& c : bytes) c = static_cast<char>(random() % 3 == 0 ? random() : random() % 4);
    EXPECT_FALSE(decompress(bytes, 1 + random() % 300).empty());
  }
}

TEST(Lzf, CanBeCancelled) {
  std::vector<char> output(1);
  const test::CancelledProgress stopped;
  EXPECT_THROW((void)decompress_lzf("\0a"s, output, stopped), Cancelled);
}

}  // namespace
}  // namespace keenline
