#include "keenline/io/obj.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/io/faces.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_lines.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

/// Keywords whose lines are counted and skipped, frequent ones first.
constexpr std::array<std::string_view, 41> skipped_keywords{
    "vn",   "vt",       "g",        "s",          "usemtl",   "o",      "p",    "mtllib", "vp",
    "mg",   "usemap",   "maplib",   "lod",        "bevel",    "cstype", "deg",  "bmat",   "step",
    "curv", "curv2",    "surf",     "parm",       "trim",     "hole",   "scrv", "sp",     "end",
    "con",  "c_interp", "d_interp", "ctech",      "stech",    "call",   "csh",  "bsp",    "bzp",
    "cdc",  "cdp",      "res",      "shadow_obj", "trace_obj"};

bool is_face(std::string_view keyword) { return keyword == "f" || keyword == "fo"; }

/// Walks through the lines that say something, joined with the next one where they end with a backslash.
class JoinedLines {
 public:
  JoinedLines(const Source& source, Progress& progress) : lines_(source, progress) {}

  /// `line` is good until the next call; of joined lines nothing may be left. Comments on the way are added
  /// to `comments`, where there is one.
  [[nodiscard]] bool next(std::string_view& line, std::vector<std::string>* comments = nullptr);
  /// Number of the line, the first one of those that were joined.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  TextLines lines_;
  std::uint64_t number_ = 0;
  std::string joined_;
};

bool JoinedLines::next(std::string_view& line, std::vector<std::string>* comments) {
  if (!lines_.next_content(line, comments)) return false;
  number_ = lines_.number();
  if (!line.ends_with('\\')) return true;
  joined_.clear();
  while (line.ends_with('\\')) {
    joined_ += line.substr(0, line.size() - 1);
    joined_ += ' ';
    if (!lines_.next(line)) lines_.refuse_end("the line that a backslash announces");
    line = trimmed(line.substr(0, line.find('#')));
  }
  joined_ += line;
  line = trimmed(joined_);
  return true;
}

/// Whether `parts` is "", "/2", "//3" or "/2/3". Texture coordinates and normals are not kept, but no line
/// that holds nonsense is half understood.
bool refers_to_texture_and_normal(std::string_view parts) {
  for (int i = 0; i < 2 && !parts.empty(); ++i) {
    parts.remove_prefix(1);
    const std::string_view part = parts.substr(0, parts.find('/'));
    std::int64_t number = 0;
    if (!part.empty() && (parse_number(part, number) != Parsed::Ok || number == 0)) return false;
    parts.remove_prefix(part.size());
  }
  return parts.empty();
}

class ObjReader {
 public:
  ObjReader(const Source& source, Progress& progress)
      : source_(source), progress_(progress), lines_(source, progress) {}

  Reading read();

 private:
  void read_line(Words words);
  void read_vertex(Words& words);
  void read_row(Words& words, FaceBuilder& rows);
  [[nodiscard]] std::uint32_t vertex_index(const Words& words, std::string_view reference);
  void skip(const Words& words, std::string_view keyword);
  void keep_attributes();
  void note_what_was_skipped();

  const Source& source_;
  Progress& progress_;
  JoinedLines lines_;
  PointCloud cloud_;
  std::vector<std::string> notes_;

  std::size_t columns_ = 0;  // numbers per vertex
  std::uint64_t first_vertex_line_ = 0;
  std::vector<double> attributes_;  // columns_ - 3 per vertex

  FaceBuilder faces_;
  FaceBuilder polylines_;
  std::vector<std::uint32_t> row_;  // of the face or polyline at hand
  // A positive number may refer to a vertex further on, so the largest is checked at the end.
  std::uint64_t largest_number_ = 0;
  std::uint64_t largest_number_line_ = 0;

  std::array<std::uint64_t, skipped_keywords.size()> skipped_{};
};

Reading ObjReader::read() {
  std::string_view line;
  while (lines_.next(line, columns_ == 0 ? &cloud_.comments : nullptr))
    read_line(Words(source_, line, lines_.number()));
  if (largest_number_ > cloud_.size()) {
    throw InputError(source_.name, Place::line(largest_number_line_), fmt::format("'{}'", largest_number_),
                     expected_vertex_number(1, cloud_.size()));
  }
  keep_attributes();
  if (faces_.rows() > 0) cloud_.tables.push_back(faces_.finish());
  if (polylines_.rows() > 0) cloud_.tables.push_back(polylines_.finish("line"));
  note_what_was_skipped();
  return {std::move(cloud_), "obj", "ascii", std::move(notes_)};
}

void ObjReader::read_line(Words words) {
  const std::string_view keyword = words.next();
  if (keyword.empty()) return;
  if (keyword == "v") read_vertex(words);
  else if (is_face(keyword)) read_row(words, faces_);
  else if (keyword == "l") read_row(words, polylines_);
  else skip(words, keyword);
}

void ObjReader::read_vertex(Words& words) {
  std::array<double, 7> numbers{};
  std::size_t count = 0;
  while (count < numbers.size() && !words.rest().empty()) numbers[count++] = words.number<double>();
  words.expect_end();
  const Place here = Place::line(words.line_number());
  if (count != 3 && count != 4 && count != 6 && count != 7) {
    throw InputError(source_.name, here, fmt::format("{} numbers", count),
                     "3, 4, 6 or 7 numbers of a vertex");
  }
  if (columns_ == 0) {
    columns_ = count;
    first_vertex_line_ = words.line_number();
  }
  if (count != columns_) {
    throw InputError(source_.name, here, fmt::format("{} numbers", count),
                     fmt::format("{} as for the vertex in line {}", columns_, first_vertex_line_));
  }
  if (cloud_.size() == max_points)
    throw InputError(source_.name, here, "one more vertex", fmt::format("at most {}", max_points));
  cloud_.positions.push_back({numbers[0], numbers[1], numbers[2]});
  attributes_.insert(attributes_.end(), numbers.begin() + 3,
                     numbers.begin() + static_cast<std::ptrdiff_t>(count));
}

void ObjReader::read_row(Words& words, FaceBuilder& rows) {
  row_.clear();
  do {
    row_.push_back(vertex_index(words, words.next()));
    if (row_.size() % 4096 == 0) progress_.check();
  } while (!words.rest().empty());
  rows.add(row_);
}

std::uint32_t ObjReader::vertex_index(const Words& words, std::string_view reference) {
  const std::string_view vertex = reference.substr(0, reference.find('/'));
  std::int64_t number = 0;
  if (parse_number(vertex, number) != Parsed::Ok || number == 0 ||
      !refers_to_texture_and_normal(reference.substr(vertex.size())))
    words.refuse(reference, "a vertex such as 3, 3/1, 3//2, 3/1/2 or -1");
  const auto vertices = static_cast<std::int64_t>(cloud_.size());
  if (number < -vertices)
    words.refuse(reference, fmt::format("one of the {} vertices that precede this line", vertices));
  if (number < 0) return static_cast<std::uint32_t>(vertices + number);
  if (static_cast<std::uint64_t>(number) > max_points)
    words.refuse(reference, fmt::format("a vertex number of at most {}", max_points));
  if (static_cast<std::uint64_t>(number) > largest_number_) {
    largest_number_ = static_cast<std::uint64_t>(number);
    largest_number_line_ = words.line_number();
  }
  return static_cast<std::uint32_t>(number - 1);
}

void ObjReader::skip(const Words& words, std::string_view keyword) {
  const auto found = std::find(skipped_keywords.begin(), skipped_keywords.end(), keyword);
  if (found == skipped_keywords.end()) words.refuse(keyword, "an OBJ keyword");
  ++skipped_[static_cast<std::size_t>(found - skipped_keywords.begin())];
}

void ObjReader::keep_attributes() {
  if (columns_ <= 3) return;
  const std::array<const char*, 4> all_names{"w", "red", "green", "blue"};
  const std::size_t width = columns_ - 3;
  const std::size_t first_name = width == 3 ? 1 : 0;
  for (std::size_t k = 0; k < width; ++k) {
    Column column(all_names[first_name + k], ScalarType::Float64, cloud_.size());
    const std::span<double> values = column.values<double>();
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = attributes_[i * width + k];
    cloud_.attributes.push_back(std::move(column));
  }
  if (first_name == 0) notes_.emplace_back("w is kept as an attribute; positions are not divided by it");
  if (columns_ == 7) notes_.emplace_back("7 numbers per vertex are taken for x y z w red green blue");
}

void ObjReader::note_what_was_skipped() {
  std::vector<std::string> counts;
  for (std::size_t i = 0; i < skipped_.size(); ++i)
    if (skipped_[i] > 0) counts.push_back(fmt::format("{} {}", skipped_[i], skipped_keywords[i]));
  if (!counts.empty()) notes_.push_back(fmt::format("skipped lines: {}", fmt::join(counts, ", ")));
  if (cloud_.size() == 0) notes_.emplace_back("there are no vertices (v lines)");
}

}  // namespace

Reading read_obj(const Source& source, Progress& progress) { return ObjReader(source, progress).read(); }

Format::Match match_obj(const Source& source) {
  constexpr std::size_t longest_preface = 65536;
  LineReader lines(without_bom(source.bytes).substr(0, longest_preface));
  std::string_view line;
  while (lines.next(line)) {
    line = trimmed(line.substr(0, line.find('#')));
    if (line.empty()) continue;
    const std::string_view keyword = take_word(line);
    const bool known =
        keyword == "v" || is_face(keyword) || keyword == "l" ||
        std::find(skipped_keywords.begin(), skipped_keywords.end(), keyword) != skipped_keywords.end();
    return known && !line.empty() ? Format::Match::Weak : Format::Match::No;
  }
  return Format::Match::No;
}

}  // namespace keenline
