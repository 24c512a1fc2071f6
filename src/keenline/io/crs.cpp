#include "keenline/io/crs.h"

#include <cctype>

#include <fmt/format.h>

#include "keenline/io/text.h"

namespace keenline {
namespace {

constexpr std::string_view epsg_comment = "crs_epsg ";
constexpr std::string_view wkt_comment = "crs_wkt ";

/// \pre there are two more bytes
unsigned number_at(std::string_view bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]) |
         static_cast<unsigned>(static_cast<unsigned char>(bytes[at + 1])) << 8U;
}

std::optional<int> epsg_code(std::string_view text) {
  double code = 0;
  if (parse_number(text, code) != Parsed::Ok || !(code >= 1 && code <= 998999) ||
      code != static_cast<int>(code))
    return std::nullopt;
  return static_cast<int>(code);
}

/// `"EPSG","25832"]` or `"EPSG",25832]`, as it stands behind AUTHORITY[ or ID[.
std::optional<int> epsg_in_brackets(std::string_view text) {
  constexpr std::string_view authority = "\"EPSG\",";
  const std::size_t end = text.find(']');
  if (end == std::string_view::npos || !text.starts_with(authority)) return std::nullopt;
  std::string_view code = text.substr(authority.size(), end - authority.size());
  if (code.size() > 2 && code.front() == '"' && code.back() == '"') code = code.substr(1, code.size() - 2);
  return epsg_code(code);
}

}  // namespace

std::optional<int> epsg_of_geotiff_keys(std::string_view directory) {
  constexpr std::size_t entry_bytes = 8;  // key, where its value stands, how many values, the value
  constexpr unsigned geographic = 2048;
  constexpr unsigned projected = 3072;
  constexpr unsigned first_own_code = 32767;  // "user-defined"
  if (directory.size() < entry_bytes || number_at(directory, 0) != 1) return std::nullopt;
  const std::size_t count = number_at(directory, 6);
  if (count > directory.size() / entry_bytes - 1) return std::nullopt;
  std::optional<int> code;
  for (std::size_t i = 1; i <= count; ++i) {
    const unsigned key = number_at(directory, i * entry_bytes);
    const unsigned value = number_at(directory, i * entry_bytes + 6);
    const bool stands_here = number_at(directory, i * entry_bytes + 2) == 0;
    if ((key != geographic && key != projected) || !stands_here || value == 0 || value >= first_own_code)
      continue;
    if (key == projected || !code) code = static_cast<int>(value);
  }
  return code;
}

std::optional<int> epsg_of_wkt(std::string_view wkt) {
  std::string packed;  // without the spaces outside of quotes
  bool quoted = false;
  for (const char c : wkt) {
    if (c == '"') quoted = !quoted;
    if (quoted || std::isspace(static_cast<unsigned char>(c)) == 0) packed += c;
  }
  int depth = 0;
  quoted = false;
  for (std::size_t i = 0; i < packed.size(); ++i) {
    if (packed[i] == '"') quoted = !quoted;
    if (quoted) continue;
    if (packed[i] == ']') --depth;
    if (packed[i] != '[') continue;
    const std::string_view before = std::string_view(packed).substr(0, i);
    if (depth == 1 && (before.ends_with(",AUTHORITY") || before.ends_with(",ID")))
      return epsg_in_brackets(std::string_view(packed).substr(i + 1));
    ++depth;
  }
  return std::nullopt;
}

std::string crs_of(const PointCloud& cloud) {
  std::string text;
  for (const std::string_view comment : cloud.comments) {
    std::optional<int> code;
    if (comment.starts_with(epsg_comment)) code = epsg_code(comment.substr(epsg_comment.size()));
    if (comment.starts_with(wkt_comment)) {
      text = comment.substr(wkt_comment.size());
      code = epsg_of_wkt(text);
    }
    if (code) return fmt::format("EPSG:{}", *code);
  }
  return text;
}

}  // namespace keenline
