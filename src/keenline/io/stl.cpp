#include "keenline/io/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/faces.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_lines.h"
#include "keenline/memory.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

static_assert(std::endian::native == std::endian::little, "STL's numbers are little endian");

constexpr std::size_t title_size = 80;
constexpr std::size_t header_size = title_size + 4;
constexpr std::size_t facet_size = 50;
constexpr std::size_t size_of_signature = 4096;

/// Gives corners of triangles the number of their point; corners with equal coordinates share one.
class PointMerger {
 public:
  PointMerger(const Source& source, Progress& progress) : source_(source), progress_(progress) {}

  /// \throw InputError, for a file with too many points.
  std::uint32_t add(const Point& corner, Place place);
  [[nodiscard]] std::vector<Point>& points() { return points_; }

 private:
  static constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();
  static_assert(empty > max_points);

  [[nodiscard]] std::uint32_t& slot_of(const Point& corner);
  void grow();

  const Source& source_;
  Progress& progress_;
  std::vector<Point> points_;         // in order of first appearance
  std::vector<std::uint32_t> slots_;  // open addressing; a power of two, at most half full
};

bool has_nan(const Point& p) { return std::isnan(p[0]) || std::isnan(p[1]) || std::isnan(p[2]); }

std::uint64_t hash_of(const Point& p) {
  std::uint64_t hash = 0;
  for (const double coordinate : p) {
    // -0 + 0 is +0: what compares equal must hash alike.
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate + 0.0)) * 0x9E37'79B9'7F4A'7C15U;
    hash ^= hash >> 32U;
  }
  return hash;
}

std::uint32_t PointMerger::add(const Point& corner, Place place) {
  // Not a number equals nothing, itself included: such corners stay out of the table.
  std::uint32_t* slot = nullptr;
  if (!has_nan(corner)) {
    if (2 * (points_.size() + 1) > slots_.size()) grow();
    slot = &slot_of(corner);
    if (*slot != empty) return *slot;
  }
  if (points_.size() == max_points)
    throw InputError(source_.name, place, "one more point", fmt::format("at most {}", max_points));
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(corner);
  if (slot != nullptr) *slot = number;
  return number;
}

std::uint32_t& PointMerger::slot_of(const Point& corner) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = hash_of(corner) & mask;
  while (slots_[i] != empty && points_[slots_[i]] != corner) i = (i + 1) & mask;
  return slots_[i];
}

void PointMerger::grow() {
  slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), empty);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i % 1024 == 0) progress_.check();
    if (!has_nan(points_[i])) slot_of(points_[i]) = static_cast<std::uint32_t>(i);
  }
}

Reading finish(PointMerger& merger, FaceBuilder& faces, ScalarType position_type, std::string encoding) {
  Reading reading;
  reading.format = "stl";
  reading.encoding = std::move(encoding);
  PointCloud& cloud = reading.cloud;
  cloud.positions = std::move(merger.points());
  cloud.position_types.fill(position_type);
  if (const std::size_t triangles = faces.rows(); triangles > 0) {
    cloud.tables.push_back(faces.finish());
    reading.notes.push_back(fmt::format("{} corners merged to {} points", 3 * triangles, cloud.size()));
    reading.notes.emplace_back("facet normals are not kept");
  }
  return reading;
}

/// The name that a file gives itself, where it is text.
void keep_title(std::string_view title, PointCloud& cloud) {
  title = trimmed(title);
  if (!title.empty() && escaped(title, title.size()) == title) cloud.comments.emplace_back(title);
}

template <typename T>
T load(const char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

Point as_point(const std::array<float, 3>& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// The number of triangles that a binary header claims; nothing when the file is too short to hold one.
std::optional<std::uint32_t> claimed_triangles(std::string_view bytes) {
  if (bytes.size() < header_size) return std::nullopt;
  return load<std::uint32_t>(bytes.data() + title_size);
}

/// The size is the only sign of a binary STL that can be relied on: many begin with "solid".
bool is_binary(std::string_view bytes) {
  const std::optional<std::uint32_t> triangles = claimed_triangles(bytes);
  return triangles && (bytes.size() - header_size) % facet_size == 0 &&
         (bytes.size() - header_size) / facet_size == *triangles;
}

Reading read_binary(const Source& source, Progress& progress) {
  progress.advance(header_size);
  // A triangle's corners and attribute; its points may be shared.
  constexpr std::size_t triangle_memory =
      3 * sizeof(std::uint32_t) + sizeof(std::uint64_t) + sizeof(std::uint16_t);
  require_memory((source.bytes.size() - header_size) / facet_size * triangle_memory, "reading triangles");
  PointMerger merger(source, progress);
  FaceBuilder faces;
  std::vector<std::uint16_t> attributes;
  bool any_attribute = false;
  for (std::size_t begin = header_size; begin < source.bytes.size(); begin += facet_size) {
    const char* const facet = source.bytes.data() + begin;
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const std::size_t offset = 12 * (corner + 1);  // after the normal
      triangle[corner] =
          merger.add(as_point(load<std::array<float, 3>>(facet + offset)), Place::byte(begin + offset));
    }
    faces.add(triangle);
    attributes.push_back(load<std::uint16_t>(facet + 48));
    any_attribute = any_attribute || attributes.back() != 0;
    if (faces.rows() % 1024 == 0) {
      progress.check();
      progress.advance(1024 * facet_size);
    }
  }
  progress.advance(faces.rows() % 1024 * facet_size);

  Reading reading = finish(merger, faces, ScalarType::Float32, "binary");
  if (any_attribute) reading.cloud.tables.front().columns.emplace_back("attribute", attributes);
  const std::string_view title = source.bytes.substr(0, title_size);
  keep_title(title.substr(0, title.find('\0')), reading.cloud);
  return reading;
}

bool is_keyword(std::string_view word, std::string_view lower_case_keyword) {
  return word.size() == lower_case_keyword.size() && starts_with_ignoring_case(word, lower_case_keyword);
}

class AsciiReader {
 public:
  AsciiReader(const Source& source, Progress& progress)
      : source_(source), lines_(source, progress), merger_(source, progress) {}

  Reading read();

 private:
  void read_facets_of_solid();
  void read_facet(Words& first_line);
  [[nodiscard]] std::uint32_t read_vertex();
  /// The next line that is not blank. \throw InputError at the end of the file.
  [[nodiscard]] Words next_line(std::string_view expected);
  [[nodiscard]] bool next_line_if_any(std::string_view& line);
  /// A line with these two keywords, or one, and nothing else.
  void expect_line(std::string_view keyword, std::string_view second_keyword = {});
  static void expect(Words& words, std::string_view keyword);

  const Source& source_;
  TextLines lines_;
  PointMerger merger_;
  FaceBuilder faces_;
};

Reading AsciiReader::read() {
  PointCloud titles;
  std::string_view line;
  while (next_line_if_any(line)) {
    Words words(source_, line, lines_.number());
    expect(words, "solid");
    keep_title(words.rest(), titles);
    read_facets_of_solid();
  }
  Reading reading = finish(merger_, faces_, ScalarType::Float64, "ascii");
  reading.cloud.comments = std::move(titles.comments);
  return reading;
}

void AsciiReader::read_facets_of_solid() {
  constexpr std::string_view expected = "facet or endsolid";
  for (;;) {
    Words words = next_line(expected);
    const std::string_view keyword = words.next();
    if (is_keyword(keyword, "endsolid")) return;
    if (!is_keyword(keyword, "facet")) words.refuse(keyword, expected);
    read_facet(words);
  }
}

void AsciiReader::read_facet(Words& first_line) {
  expect(first_line, "normal");
  for (int axis = 0; axis < 3; ++axis) (void)first_line.number<double>();
  first_line.expect_end();
  expect_line("outer", "loop");
  std::array<std::uint32_t, 3> triangle{};
  for (std::uint32_t& corner : triangle) corner = read_vertex();
  expect_line("endloop");
  expect_line("endfacet");
  faces_.add(triangle);
}

std::uint32_t AsciiReader::read_vertex() {
  Words words = next_line("vertex");
  expect(words, "vertex");
  Point corner{};
  for (double& coordinate : corner) coordinate = words.number<double>();
  words.expect_end();
  return merger_.add(corner, Place::line(words.line_number()));
}

bool AsciiReader::next_line_if_any(std::string_view& line) {
  while (lines_.next(line))
    if (line = trimmed(line); !line.empty()) return true;
  return false;
}

Words AsciiReader::next_line(std::string_view expected) {
  std::string_view line;
  if (!next_line_if_any(line)) lines_.refuse_end(expected);
  return {source_, line, lines_.number()};
}

void AsciiReader::expect_line(std::string_view keyword, std::string_view second_keyword) {
  Words words = next_line(keyword);
  expect(words, keyword);
  if (!second_keyword.empty()) expect(words, second_keyword);
  words.expect_end();
}

void AsciiReader::expect(Words& words, std::string_view keyword) {
  if (const std::string_view word = words.next(); !is_keyword(word, keyword)) words.refuse(word, keyword);
}

/// Whether the first line that is not blank begins with the word "solid".
bool begins_with_solid(std::string_view bytes) {
  std::string_view text = without_bom(bytes.substr(0, size_of_signature));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return is_keyword(text.substr(0, text.find_first_of(" \t\r\n")), "solid");
}

}  // namespace

Reading read_stl(const Source& source, Progress& progress) {
  const std::string_view bytes = source.bytes;
  if (is_binary(bytes)) return read_binary(source, progress);
  const bool is_text = bytes.substr(0, size_of_signature).find('\0') == std::string_view::npos;
  if (is_text && begins_with_solid(bytes)) return AsciiReader(source, progress).read();
  const std::optional<std::uint32_t> triangles = claimed_triangles(bytes);
  if (!triangles) {
    throw InputError(source.name, Place::byte(bytes.size()), "the end of the file",
                     "the word 'solid' of an ascii STL, or the 84 bytes of a binary STL's header");
  }
  throw InputError(source.name, Place::byte(title_size),
                   fmt::format("{} triangles, which take {} bytes, in a file of {} bytes", *triangles,
                               header_size + std::uint64_t{*triangles} * facet_size, bytes.size()),
                   "a binary STL of just that size, or an ascii STL: text that begins with 'solid'");
}

Format::Match match_stl(const Source& source) {
  if (is_binary(source.bytes))
    return source.bytes.size() > header_size ? Format::Match::Strong : Format::Match::No;
  if (!begins_with_solid(source.bytes)) return Format::Match::No;
  LineReader lines(source.bytes.substr(0, size_of_signature));
  std::string_view line;
  while (lines.next(line)) {
    if (const std::string_view keyword = take_word(line);
        is_keyword(keyword, "facet") || is_keyword(keyword, "endsolid"))
      return Format::Match::Strong;
  }
  return Format::Match::No;
}

}  // namespace keenline
