#include "keenline/report/report_sinks.h"

#include <random>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/report_file.h"

namespace keenline {
namespace {

/// `text` in pieces of the given size.
template <typename AnySink>
void write_in_pieces(AnySink& sink, std::string_view text, std::size_t size) {
  for (; !text.empty(); text.remove_prefix(std::min(size, text.size()))) sink.write(text.substr(0, size));
}

std::string base64(std::string_view bytes, std::size_t piece) {
  StringSink text;
  Base64Sink sink(text);
  write_in_pieces(sink, bytes, piece);
  sink.finish();
  return text.text;
}

/// Bytes that zlib can make something of, and others.
std::string some_bytes(std::size_t count) {
  std::mt19937 random(5);
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i)
    bytes += static_cast<char>(i % 4096 < 2048 ? static_cast<int>(random() % 256) - 128 : 'a');
  return bytes;
}

TEST(ReportSinks, Base64AsTheStandardHasIt) {
  // RFC 4648, section 10.
  const std::array<std::pair<const char*, const char*>, 7> examples{{{"", ""},
                                                                     {"f", "Zg=="},
                                                                     {"fo", "Zm8="},
                                                                     {"foo", "Zm9v"},
                                                                     {"foob", "Zm9vYg=="},
                                                                     {"fooba", "Zm9vYmE="},
                                                                     {"foobar", "Zm9vYmFy"}}};
  for (const auto& [bytes, text] : examples)
    for (const std::size_t piece : {1U, 2U, 3U, 4U, 100U}) EXPECT_EQ(base64(bytes, piece), text);
  EXPECT_EQ(base64("\xfb\xff\xfe", 3), "+//+");
}

TEST(ReportSinks, Base64ComesBackWhateverThePieces) {
  const std::string bytes = some_bytes(5000);
  for (const std::size_t piece : {1U, 7U, 1000U, 5000U})
    EXPECT_EQ(test::base64_decoded(base64(bytes, piece)), bytes);
}

TEST(ReportSinks, ZlibComesBackWhateverThePieces) {
  const std::string bytes = some_bytes(3'000'000);
  for (const std::size_t piece : {999U, 3'000'000U}) {
    StringSink packed;
    ZlibSink sink(packed);
    write_in_pieces(sink, bytes, piece);
    sink.finish();
    EXPECT_LT(packed.text.size(), bytes.size() * 6 / 10);
    EXPECT_EQ(test::inflated(packed.text), bytes);
  }
  StringSink nothing;
  ZlibSink sink(nothing);
  sink.finish();
  EXPECT_EQ(test::inflated(nothing.text), "");
}

TEST(ReportSinks, JsonCannotEndItsElement) {
  const nlohmann::json object{{"</script><img src=x onerror=alert(1)>", "<!--<script>&amp;"}, {"n", 3}};
  const std::string text = object.dump();
  for (const std::size_t piece : {1U, 5U, 1000U}) {
    StringSink escaped;
    HtmlJsonSink sink(escaped);
    write_in_pieces(sink, text, piece);
    EXPECT_EQ(escaped.text.find_first_of("<>&"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(escaped.text), object);
  }
}

}  // namespace
}  // namespace keenline
