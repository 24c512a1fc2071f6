#include "keenline/io/xyz.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/io/text_rows.h"
#include "keenline/io/text_split.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::size_t longest_head_line = 32U << 20U;
constexpr std::array<std::string_view, 3> axis_names{"x", "y", "z"};

struct Line {
  std::string_view text;
  std::uint64_t number = 0;
};

using Names = std::vector<std::string>;

/// The lines up to the first row of numbers.
struct Head {
  std::vector<Line> comments;
  std::optional<Line> count;  // a lone integer
  std::optional<Line> header;
  Line first_row;         // without comment; empty when there is none
  std::string_view body;  // the text from the first row's line on
};

/// Which columns are called x, y and z.
struct Axes {
  std::array<std::vector<std::size_t>, 3> columns;  // more than one: ambiguous

  [[nodiscard]] bool complete() const {
    return std::none_of(columns.begin(), columns.end(), [](const auto& found) { return found.empty(); });
  }
};

bool equals_ignoring_case(std::string_view word, std::string_view lower_case) {
  return word.size() == lower_case.size() && starts_with_ignoring_case(word, lower_case);
}

Axes find_axes(const Names& names) {
  using Words = std::vector<std::string_view>;
  static const std::array<Words, 3> other_names{Words{"easting"}, Words{"northing"},
                                                Words{"elevation", "height", "altitude"}};
  Axes axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < names.size(); ++c)
      if (equals_ignoring_case(names[c], axis_names[axis])) axes.columns[axis].push_back(c);
    if (!axes.columns[axis].empty()) continue;
    for (std::size_t c = 0; c < names.size(); ++c) {
      for (const std::string_view other : other_names[axis])
        if (equals_ignoring_case(names[c], other)) axes.columns[axis].push_back(c);
    }
  }
  return axes;
}

/// Also what is too large for a number: it is none, but it is no name either.
bool is_number_like(std::string_view word) {
  double number = 0;
  return parse_number(unquoted(word), number) != Parsed::NotANumber;
}

bool is_count(std::string_view line) {
  return !line.empty() && line.size() <= 20 && line.find_first_not_of("0123456789") == std::string_view::npos;
}

char data_delimiter(std::string_view line) {
  const char guess = guess_delimiter(line);
  return guess == '\t' ? ' ' : guess;  // a run of blanks and tabs is one delimiter
}

std::vector<std::string_view> fields_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> fields;
  FieldReader reader(line, delimiter);
  for (std::string_view field; reader.next(field);) fields.push_back(field);
  return fields;
}

/// A line of names, as opposed to a row of numbers with a mistake in it.
bool is_header(std::string_view line) {
  const std::vector<std::string_view> fields = fields_of(line, data_delimiter(line));
  if (std::all_of(fields.begin(), fields.end(), is_number_like)) return false;
  if (find_axes(split_quoted(line, guess_delimiter(line))).complete()) return true;
  return std::none_of(fields.begin(), fields.end(), is_number_like);
}

/// "1,5 2,5 3,5" and "1,5;2,5;3,5" would else be split at the wrong places.
void require_decimal_points(const Source& source, const Line& line) {
  const bool semicolons = guess_delimiter(line.text) == ';';
  const std::vector<std::string_view> fields = fields_of(line.text, semicolons ? ';' : ' ');
  const auto found = std::find_if(fields.begin(), fields.end(), is_number_with_comma);
  const bool numbers = std::all_of(fields.begin(), fields.end(), [](std::string_view field) {
    return is_number_with_comma(field) || is_number_like(field);
  });
  if (found != fields.end() && fields.size() > 1 && (semicolons || numbers))
    throw InputError(source.name, Place::line(line.number), quoted(*found), "a number with a decimal point");
}

std::string_view comment_text(std::string_view line) {
  line = trimmed(line);
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t"), line.size()));
  return line;
}

class HeadReader {
 public:
  HeadReader(const Source& source, std::string_view text)
      : source_(source), rest_(text), line_end_(line_end_of(text)) {}

  Head read() {
    Head head;
    while (next_content(head)) {
      if (!head.count && !head.header && is_count(content_.text)) {
        head.count = content_;
        continue;
      }
      require_decimal_points(source_, content_);
      if (!head.header && is_header(content_.text)) {
        head.header = content_;
        continue;
      }
      head.first_row = content_;
      head.body = body_;
      return head;
    }
    return head;
  }

 private:
  /// Moves to the next line that is more than blank or comment.
  bool next_content(Head& head) {
    while (!rest_.empty()) {
      body_ = rest_;
      const std::string_view line = next_line();
      content_ = {trimmed(without_comment(line)), number_};
      if (!content_.text.empty()) return true;
      if (trimmed(line).empty()) continue;
      head.comments.push_back({comment_text(line), number_});
    }
    return false;
  }

  std::string_view next_line() {
    ++number_;
    const std::string_view window = rest_.substr(0, longest_head_line);
    if (window.size() < rest_.size() && window.find(line_end_) == std::string_view::npos) {
      throw InputError(
          source_.name, Place::line(number_),
          window.find('\0') == std::string_view::npos ? "a line of more than 32 MiB" : "a zero byte", "text");
    }
    const std::string_view line = take_line(rest_, line_end_);
    if (line.find('\0') != std::string_view::npos)
      throw InputError(source_.name, Place::line(number_), "a zero byte", "text");
    return line;
  }

  const Source& source_;
  std::string_view rest_;
  char line_end_;
  std::uint64_t number_ = 0;
  Line content_;
  std::string_view body_;
};

/// What the head says of the data.
struct Layout {
  RowFormat format;
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::optional<Line> names;  // the line they come from
  bool named_by_comment = false;
};

/// The names in `line`, split in the way that gives the wanted number of them, with x, y and z among them.
std::optional<Names> matching_names(std::string_view line, char delimiter, std::size_t wanted) {
  for (const char candidate : {delimiter, guess_delimiter(line), ' '}) {
    Names names = split_quoted(line, candidate);
    if (names.size() == wanted && find_axes(names).complete()) return names;
  }
  return std::nullopt;
}

Names numbered_names(std::size_t count) {
  Names names(axis_names.begin(), axis_names.end());
  for (std::size_t c = names.size() + 1; c <= count; ++c) names.push_back(fmt::format("column_{}", c));
  names.resize(count);
  return names;
}

std::string listed(const Names& names) {
  constexpr std::size_t longest = 12;
  std::vector<std::string> words;
  for (std::size_t c = 0; c < names.size() && c < longest; ++c) words.push_back(quoted(names[c]));
  return fmt::format("{}{}", fmt::join(words, ", "), names.size() > longest ? ", …" : "");
}

/// Finds x, y and z among the names. \throw InputError unless each is there once and no other name is there
/// twice.
std::array<std::size_t, 3> unique_axes(const Source& source, const Line& line, const Names& names) {
  const Place place = Place::line(line.number);
  const Axes axes = find_axes(names);
  if (!axes.complete()) {
    throw InputError(source.name, place, "the column names " + listed(names),
                     "names with x, y and z among them");
  }
  std::array<std::size_t, 3> result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::vector<std::size_t>& found = axes.columns[axis];
    if (found.size() > 1) {
      throw InputError(source.name, place,
                       fmt::format("the columns {} and {}", quoted(names[found[0]]), quoted(names[found[1]])),
                       fmt::format("one column for {}", axis_names[axis]));
    }
    result[axis] = found[0];
  }
  Names sorted = names;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end()) {
    throw InputError(source.name, place, fmt::format("two columns {}", quoted(*twice)),
                     "a name of its own for each");
  }
  return result;
}

/// Chooses the names: the header's, else those in the last comment that fits, else numbers.
Names choose_names(const Head& head, char delimiter, std::size_t count, Layout& layout) {
  if (head.header) {
    layout.names = head.header;
    if (auto names = matching_names(head.header->text, delimiter, count)) return *names;
    return split_quoted(head.header->text, guess_delimiter(head.header->text));
  }
  for (auto comment = head.comments.rbegin(); comment != head.comments.rend(); ++comment) {
    if (auto names = matching_names(comment->text, delimiter, count)) {
      layout.names = *comment;
      layout.named_by_comment = true;
      return *names;
    }
  }
  return numbered_names(count);
}

Layout find_layout(const Source& source, const Head& head) {
  Layout layout;
  const std::string_view example = head.first_row.text.empty() ? head.header->text : head.first_row.text;
  RowFormat& format = layout.format;
  format.delimiter = data_delimiter(example);
  format.comments = true;
  format.quotes = true;
  const std::vector<std::string_view> fields = fields_of(example, format.delimiter);
  const bool empty_at_end = !head.first_row.text.empty() && fields.back().empty();
  format.names = choose_names(head, format.delimiter, fields.size() - (empty_at_end ? 1 : 0), layout);
  // A header that names every field of the first row says that the last one is missing, not that rows end so.
  format.trailing_delimiter = empty_at_end && !(head.header && format.names.size() == fields.size());

  for (std::size_t c = 0; c < format.names.size(); ++c)
    if (format.names[c].empty()) format.names[c] = fmt::format("column_{}", c + 1);
  if (layout.names) layout.axes = unique_axes(source, *layout.names, format.names);
  if (format.names.size() < 3) {
    throw InputError(source.name, Place::line(head.first_row.number),
                     fmt::format("{} value{}", format.names.size(), format.names.size() == 1 ? "" : "s"),
                     "at least 3 (x, y, z)");
  }
  format.types.assign(format.names.size(), ScalarType::Float64);
  for (std::size_t c = 0; c < format.names.size(); ++c) {
    if (std::find(layout.axes.begin(), layout.axes.end(), c) == layout.axes.end())
      format.inferred.push_back(c);
  }
  return layout;
}

std::string encoding_of(const Layout& layout) {
  const char delimiter = layout.format.delimiter;
  const std::string_view text = delimiter == ';'   ? "semicolon-separated text"
                                : delimiter == ',' ? "comma-separated text"
                                                   : "blank-separated text";
  const std::string_view names = layout.named_by_comment ? " with names in a comment" : " with a header line";
  return fmt::format("{}{}", text, layout.names ? names : "");
}

void note_other_names(const Layout& layout, std::vector<std::string>& notes) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string& name = layout.format.names[layout.axes[axis]];
    if (!equals_ignoring_case(name, axis_names[axis]))
      notes.push_back(fmt::format("column {} is read as {}", quoted(name), axis_names[axis]));
  }
}

void fill_cloud(PointCloud& cloud, Rows&& rows, const Layout& layout) {
  const auto coordinates = [&](std::size_t axis) { return rows.columns[layout.axes[axis]].values<double>(); };
  const auto x = coordinates(0);
  const auto y = coordinates(1);
  const auto z = coordinates(2);
  cloud.positions.resize(rows.count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows.count, 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) cloud.positions[i] = {x[i], y[i], z[i]};
  });
  for (const std::size_t c : layout.format.inferred) cloud.attributes.push_back(std::move(rows.columns[c]));
}

void require_count(const Source& source, const Line& line, std::uint64_t rows) {
  std::uint64_t count = 0;
  if (parse_number(line.text, count) != Parsed::Ok || count != rows) {
    throw InputError(source.name, Place::line(line.number), fmt::format("a count of {} points", line.text),
                     fmt::format("{}, the number of rows that follow", rows));
  }
}

/// \throw InputError when this is no text of one byte per ASCII character.
std::string_view text_of(const Source& source) {
  if (source.bytes.starts_with("\xFF\xFE") || source.bytes.starts_with("\xFE\xFF"))
    throw InputError(source.name, Place::byte(0), "UTF-16 text", "UTF-8 or ASCII text");
  return without_bom(source.bytes);
}

}  // namespace

Reading read_xyz(const Source& source, Progress& progress) {
  const std::string_view text = text_of(source);
  const Head head = HeadReader(source, text).read();
  if (!head.count && !head.header && head.first_row.text.empty() && head.comments.empty())
    throw InputError(source.name, Place::file(), "an empty file", "rows of numbers");

  Reading reading;
  Layout layout;
  std::uint64_t row_count = 0;
  if (head.header || !head.first_row.text.empty()) layout = find_layout(source, head);
  if (!head.body.empty()) {
    progress.advance(static_cast<std::size_t>(head.body.data() - source.bytes.data()));
    Rows rows = read_rows(source, head.body, head.first_row.number, layout.format, {}, progress);
    row_count = rows.count;
    reading.notes = std::move(rows.notes);
    fill_cloud(reading.cloud, std::move(rows), layout);
  } else {
    for (const std::size_t c : layout.format.inferred)
      reading.cloud.attributes.emplace_back(layout.format.names[c], ScalarType::Float64, 0);
  }
  if (head.count) {
    require_count(source, *head.count, row_count);
    reading.notes.push_back(fmt::format("line {} is read as the number of points", head.count->number));
  }
  if (layout.names) note_other_names(layout, reading.notes);
  for (const Line& comment : head.comments) {
    if (!layout.named_by_comment || comment.number != layout.names->number)
      reading.cloud.comments.emplace_back(comment.text);
  }
  reading.encoding = encoding_of(layout);
  return reading;
}

Format::Match match_xyz(const Source& source) {
  constexpr std::size_t longest_look = 64 * std::size_t{1024};
  std::string_view text = without_bom(source.bytes.substr(0, longest_look));
  if (text.find('\0') != std::string_view::npos) return Format::Match::No;
  const char line_end = line_end_of(text);
  // The first row of numbers may follow a count and a line of names.
  for (int lines = 0; lines < 3 && !text.empty();) {
    const std::string_view line = trimmed(without_comment(take_line(text, line_end)));
    if (line.empty()) continue;
    ++lines;
    std::vector<std::string_view> fields = fields_of(line, data_delimiter(line));
    if (fields.back().empty()) fields.pop_back();
    if (fields.size() >= 3 && std::all_of(fields.begin(), fields.end(), is_number_like))
      return Format::Match::Weak;
  }
  return Format::Match::No;
}

}  // namespace keenline
