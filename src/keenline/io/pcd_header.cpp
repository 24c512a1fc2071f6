#include "keenline/io/pcd_header.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"

namespace keenline {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t longest_header = 1U << 20U;
constexpr std::size_t largest_record = 1U << 20U;
constexpr std::array<std::string_view, 10> keywords{"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                                    "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

struct Entry {
  std::uint64_t line = 0;
  Words words;
};

class HeaderParser {
 public:
  explicit HeaderParser(const Source& source) : source_(source) {}

  PcdHeader parse() {
    read_entries();
    header_.version = version();
    read_fields();
    read_point_count();
    keep_viewpoint();
    header_.encoding = encoding();
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(std::uint64_t line, std::string_view found, std::string_view expected) const {
    throw InputError(source_.name, Place::line(line), found, expected);
  }

  /// Reads up to the line DATA.
  void read_entries() {
    const std::string_view text = without_bom(source_.bytes);
    const std::size_t bom = source_.bytes.size() - text.size();
    const bool cut = text.size() > longest_header;
    LineReader lines(text.substr(0, longest_header));
    for (std::string_view line; entries_.count("DATA") == 0;) {
      const bool found = lines.next(line);
      if (cut && lines.rest().empty()) refuse(lines.number(), "a header of more than 1 MiB", "a line DATA");
      if (!found) refuse(std::max<std::uint64_t>(lines.number(), 1), "the end of the file", "a line DATA");
      if (line.find('\0') != std::string_view::npos) refuse(lines.number(), "a zero byte", "a header line");
      read_line(trimmed(line), lines.number());
    }
    header_.body_offset = bom + std::min(text.size(), longest_header) - lines.rest().size();
    header_.body_line = lines.number() + 1;
  }

  void read_line(std::string_view line, std::uint64_t number) {
    if (line.starts_with('#')) {
      const std::string_view comment = trimmed(line.substr(1));
      // "# .PCD v0.7 - Point Cloud Data file format" is no one's comment.
      if (!comment.empty() && !comment.starts_with(".PCD")) header_.comments.emplace_back(comment);
      return;
    }
    std::string_view keyword = take_word(line);
    if (keyword.empty()) return;
    if (keyword == "COLUMNS") keyword = "FIELDS";  // its name in old files
    if (std::find(keywords.begin(), keywords.end(), keyword) == keywords.end())
      refuse(number, quoted(keyword), fmt::format("one of {}", fmt::join(keywords, ", ")));
    Entry entry{number, {}};
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
      entry.words.push_back(word);
    if (!entries_.emplace(keyword, std::move(entry)).second)
      refuse(number, fmt::format("a second line {}", keyword), "one");
  }

  const Entry* find(std::string_view keyword) const {
    const auto found = entries_.find(keyword);
    return found == entries_.end() ? nullptr : &found->second;
  }

  /// The entry with so many words. \throw InputError when it is not there.
  const Entry& require(std::string_view keyword, std::size_t words) const {
    const Entry* entry = find(keyword);
    if (entry == nullptr) refuse(header_.body_line - 1, "DATA", fmt::format("a line {} before it", keyword));
    if (entry->words.size() != words) {
      refuse(entry->line, fmt::format("{} values after {}", entry->words.size(), keyword),
             fmt::format("{}", words));
    }
    return *entry;
  }

  std::uint64_t integer(const Entry& entry, std::size_t word) const {
    std::uint64_t value = 0;
    if (parse_number(entry.words[word], value) != Parsed::Ok)
      refuse(entry.line, quoted(entry.words[word]), "an integer from 0");
    return value;
  }

  std::string version() const {
    if (find("VERSION") == nullptr) return {};
    const Entry& entry = require("VERSION", 1);
    std::string_view word = entry.words[0];
    if (word.starts_with("0.")) word.remove_prefix(1);
    if (word != ".5" && word != ".6" && word != ".7")
      refuse(entry.line, quoted(entry.words[0]), "version 0.5, 0.6 or 0.7");
    return "0" + std::string(word);
  }

  void read_fields() {
    const Entry* names = find("FIELDS");
    if (names == nullptr) refuse(header_.body_line - 1, "DATA", "a line FIELDS before it");
    const std::size_t number = names->words.size();
    const Entry& types = require("TYPE", number);
    const Entry& sizes = require("SIZE", number);
    const Entry* counts = find("COUNT") == nullptr ? nullptr : &require("COUNT", number);
    for (std::size_t i = 0; i < number; ++i) {
      const ScalarType type = scalar_type(types, sizes, i);
      const std::uint64_t count = counts == nullptr ? 1 : integer(*counts, i);
      if (count == 0) refuse(counts->line, "0", "a count from 1");
      if (count > (largest_record - header_.record_bytes) / size_of(type))
        refuse(counts == nullptr ? names->line : counts->line, "records of more than 1 MiB", "smaller ones");
      header_.fields.push_back({std::string(names->words[i]), type, count});
      header_.record_bytes += header_.fields.back().size();
      header_.record_values += count;
    }
    require_unique_names(*names);
    for (const std::string_view axis : {"x", "y", "z"}) require_axis(axis, *names);
  }

  ScalarType scalar_type(const Entry& types, const Entry& sizes, std::size_t i) const {
    struct Combination {
      std::string_view type;
      std::string_view size;
      ScalarType scalar;
    };
    static constexpr std::array combinations{
        Combination{"I", "1", ScalarType::Int8},    Combination{"I", "2", ScalarType::Int16},
        Combination{"I", "4", ScalarType::Int32},   Combination{"I", "8", ScalarType::Int64},
        Combination{"U", "1", ScalarType::UInt8},   Combination{"U", "2", ScalarType::UInt16},
        Combination{"U", "4", ScalarType::UInt32},  Combination{"U", "8", ScalarType::UInt64},
        Combination{"F", "4", ScalarType::Float32}, Combination{"F", "8", ScalarType::Float64}};
    for (const Combination& known : combinations)
      if (known.type == types.words[i] && known.size == sizes.words[i]) return known.scalar;
    refuse(types.line, fmt::format("TYPE {} with SIZE {}", quoted(types.words[i]), quoted(sizes.words[i])),
           "I or U with 1, 2, 4 or 8, or F with 4 or 8");
  }

  void require_unique_names(const Entry& names) const {
    Words sorted = names.words;
    sorted.erase(std::remove(sorted.begin(), sorted.end(), "_"), sorted.end());
    std::sort(sorted.begin(), sorted.end());
    if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
      refuse(names.line, fmt::format("two fields {}", quoted(*twice)), "a name of its own for each");
  }

  void require_axis(std::string_view axis, const Entry& names) const {
    const auto found = std::find_if(header_.fields.begin(), header_.fields.end(),
                                    [&](const PcdField& field) { return field.name == axis; });
    if (found == header_.fields.end())
      refuse(names.line, fmt::format("no field '{}'", axis), "fields x, y and z");
    if (found->count != 1) {
      refuse(require("COUNT", names.words.size()).line,
             fmt::format("count {} of field '{}'", found->count, axis), "1");
    }
  }

  void read_point_count() {
    std::optional<std::uint64_t> product;
    if (find("WIDTH") != nullptr || find("HEIGHT") != nullptr) {
      const Entry& width = require("WIDTH", 1);
      header_.points_line = width.line;
      header_.width = integer(width, 0);
      header_.height = find("HEIGHT") == nullptr ? 1 : integer(require("HEIGHT", 1), 0);
      if (header_.height > 0 && header_.width > max_points / header_.height) {
        refuse(width.line, fmt::format("WIDTH {} and HEIGHT {}", header_.width, header_.height),
               fmt::format("at most {} points", max_points));
      }
      product = header_.width * header_.height;
    }
    if (find("POINTS") != nullptr || !product) {
      const Entry& points = require("POINTS", 1);
      header_.points_line = points.line;
      header_.points = integer(points, 0);
      if (product && header_.points != *product) {
        refuse(points.line, fmt::format("POINTS {}", header_.points),
               fmt::format("{} (WIDTH {} x HEIGHT {})", *product, header_.width, header_.height));
      }
      if (header_.points > max_points)
        refuse(points.line, fmt::format("POINTS {}", header_.points), fmt::format("at most {}", max_points));
      if (!product) header_.width = header_.points;
    } else {
      header_.points = *product;
    }
  }

  void keep_viewpoint() {
    if (find("VIEWPOINT") == nullptr) return;
    const Entry& entry = require("VIEWPOINT", 7);
    static constexpr std::array<double, 7> usual{0, 0, 0, 1, 0, 0, 0};
    std::array<double, 7> viewpoint{};
    for (std::size_t i = 0; i < usual.size(); ++i) {
      if (parse_number(entry.words[i], viewpoint[i]) != Parsed::Ok)
        refuse(entry.line, quoted(entry.words[i]), "a number");
    }
    if (viewpoint != usual)
      header_.comments.push_back(fmt::format("VIEWPOINT {}", fmt::join(entry.words, " ")));
  }

  PcdEncoding encoding() const {
    const Entry& entry = require("DATA", 1);
    const std::string_view word = entry.words[0];
    if (word == "ascii") return PcdEncoding::Ascii;
    if (word == "binary") return PcdEncoding::Binary;
    if (word == "binary_compressed") return PcdEncoding::BinaryCompressed;
    refuse(entry.line, quoted(word), "ascii, binary or binary_compressed");
  }

  const Source& source_;
  PcdHeader header_;
  std::map<std::string_view, Entry> entries_;
};

}  // namespace

PcdHeader read_pcd_header(const Source& source) { return HeaderParser(source).parse(); }

}  // namespace keenline
