#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>
#include <zlib.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "keenline/report/report_buffers.h"

namespace keenline::test {

/// The numbers of a buffer, tuple after tuple, by the words of docs/report-format.md.
inline std::vector<std::uint32_t> decoded(std::string_view bytes, std::string_view type,
                                          std::size_t components, std::size_t count,
                                          std::string_view coding) {
  const std::size_t size = type == "uint8" ? 1 : type == "uint16" ? 2 : 4;
  std::vector<std::uint32_t> numbers(components * count);
  EXPECT_EQ(bytes.size(), numbers.size() * size);
  for (std::size_t component = 0; component < components; ++component) {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t number = 0;
      for (std::size_t b = 0; b < size; ++b) {
        const std::size_t at =
            coding == "raw" ? (i * components + component) * size + b : (component * size + b) * count + i;
        number += std::uint32_t{static_cast<unsigned char>(bytes[at])} << (8 * b);
      }
      if (coding == "delta") {
        sum += number % 2 == 0 ? number / 2 : ~(number / 2);
        number = sum & static_cast<std::uint32_t>((std::uint64_t{1} << (8 * size)) - 1);
      }
      numbers[i * components + component] = number;
    }
  }
  return numbers;
}

inline std::vector<std::uint32_t> decoded(const ReportBuffer& buffer) {
  return decoded(buffer.bytes, name_of(buffer.type), buffer.components, buffer.count, name_of(buffer.coding));
}

/// Of a list of buffers the one of that name; fails and gives an empty one where there is none.
inline ReportBuffer buffer_named(const std::vector<ReportBuffer>& buffers, std::string_view name) {
  for (const ReportBuffer& buffer : buffers)
    if (buffer.name == name) return buffer;
  ADD_FAILURE() << "no buffer " << name;
  return {};
}

inline std::string base64_decoded(std::string_view text) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  EXPECT_EQ(text.size() % 4, 0U);
  std::string bytes;
  std::uint32_t bits = 0;
  unsigned known = 0;
  for (const char c : text.substr(0, text.find('='))) {
    bits = bits << 6U | static_cast<std::uint32_t>(digits.find(c));
    known += 6;
    if (known < 8) continue;
    known -= 8;
    bytes += static_cast<char>(static_cast<unsigned char>(bits >> known));
  }
  return bytes;
}

inline std::string inflated(std::string_view packed) {
  std::string bytes;
  z_stream stream{};
  EXPECT_EQ(::inflateInit(&stream), Z_OK);
  std::string input(packed);
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  int result = Z_OK;
  while (result == Z_OK) {
    std::string part(1U << 16U, '\0');
    stream.next_out = reinterpret_cast<Bytef*>(part.data());
    stream.avail_out = static_cast<uInt>(part.size());
    result = ::inflate(&stream, Z_NO_FLUSH);
    bytes.append(part, 0, part.size() - stream.avail_out);
  }
  EXPECT_EQ(result, Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U);
  ::inflateEnd(&stream);
  return bytes;
}

/// The text of the element that begins with `open`, up to the first "</script>" as a browser reads it.
inline std::string_view element(std::string_view html, std::string_view open) {
  const std::size_t at = html.find(open);
  EXPECT_NE(at, std::string_view::npos) << open;
  if (at == std::string_view::npos) return {};
  const std::string_view rest = html.substr(at + open.size());
  return rest.substr(0, rest.find("</script>"));
}

struct ReportFile {
  nlohmann::json facts;
  std::string data;  // inflated

  explicit ReportFile(std::string_view html)
      : facts(nlohmann::json::parse(element(html, R"(<script type="application/json" id="keenline-facts">)"),
                                    nullptr, false)),
        data(inflated(base64_decoded(element(html, R"(<script type="text/plain" id="keenline-data">)")))) {
    EXPECT_FALSE(facts.is_discarded());
  }

  [[nodiscard]] std::vector<std::uint32_t> numbers(std::string_view name) const {
    for (const auto& buffer : facts.at("buffers"))
      if (buffer.at("name") == name)
        return decoded(std::string_view(data).substr(buffer.at("offset").get<std::size_t>(),
                                                     buffer.at("bytes").get<std::size_t>()),
                       buffer.at("type").get<std::string>(), buffer.at("components").get<std::size_t>(),
                       buffer.at("count").get<std::size_t>(), buffer.at("coding").get<std::string>());
    ADD_FAILURE() << "no buffer " << name;
    return {};
  }
};

}  // namespace keenline::test
