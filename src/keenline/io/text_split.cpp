#include "keenline/io/text_split.h"

#include <algorithm>

#include "keenline/io/text.h"

namespace keenline {
namespace {

constexpr std::size_t npos = std::string_view::npos;

bool is_blank(char c) { return c == ' ' || c == '\t'; }

bool ends_field(char c, char delimiter) { return c == delimiter || (delimiter == ' ' && is_blank(c)); }

void skip_blanks(std::string_view& text, char delimiter) {
  const std::size_t start = text.find_first_not_of(delimiter == '\t' ? " " : " \t");
  text.remove_prefix(std::min(start, text.size()));
}

/// Takes a field that begins with a quote off `text`, with what may follow the closing quote.
std::string take_quoted(std::string_view& text, char delimiter) {
  std::string field;
  bool inside = true;
  std::size_t i = 1;
  for (; i < text.size() && (inside || !ends_field(text[i], delimiter)); ++i) {
    if (text[i] != '"') {
      field += text[i];
    } else if (inside && i + 1 < text.size() && text[i + 1] == '"') {
      field += text[i++];
    } else {
      inside = !inside;
    }
  }
  text.remove_prefix(i);
  return field;
}

}  // namespace

char line_end_of(std::string_view text) {
  // Whoever has a first line longer than this has no lone '\r' to speak of; a sparse file must not be read to
  // its end.
  constexpr std::size_t longest_look = 1U << 20U;
  const std::size_t end = text.substr(0, longest_look).find_first_of("\r\n");
  const bool lone_return = end != npos && text[end] == '\r' && text.substr(end + 1, 1) != "\n";
  return lone_return ? '\r' : '\n';
}

std::string_view take_line(std::string_view& text, char line_end) {
  const std::size_t end = text.find(line_end);
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == npos ? text.size() : end + 1);
  if (line_end == '\n' && line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

std::string_view without_comment(std::string_view line) {
  std::size_t start = 0;
  while (true) {
    const std::size_t comment = std::min(line.find('#', start), line.find("//", start));
    if (comment == npos) return line;
    if (std::count(line.begin(), line.begin() + comment, '"') % 2 == 0) return line.substr(0, comment);
    start = line.find('"', comment);  // the quote that closes
    if (start == npos) return line;
  }
}

bool FieldReader::next(std::string_view& field) {
  if (delimiter_ == ' ') {
    field = take_word(rest_);
    return !field.empty();
  }
  if (ended_) return false;
  const std::size_t end = rest_.find(delimiter_);
  ended_ = end == npos;
  field = trimmed(rest_.substr(0, end));
  rest_.remove_prefix(ended_ ? rest_.size() : end + 1);
  return true;
}

std::size_t count_fields(std::string_view line, char delimiter) {
  if (delimiter != ' ') return 1 + static_cast<std::size_t>(std::count(line.begin(), line.end(), delimiter));
  std::size_t count = 0;
  while (!take_word(line).empty()) ++count;
  return count;
}

std::string_view unquoted(std::string_view field) {
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
    field = field.substr(1, field.size() - 2);
  return field;
}

std::vector<std::string> split_quoted(std::string_view line, char delimiter) {
  std::vector<std::string> fields;
  skip_blanks(line, delimiter);
  while (!line.empty()) {
    if (line.front() == '"') {
      fields.emplace_back(trimmed(take_quoted(line, delimiter)));
    } else {
      const auto end =
          std::find_if(line.begin(), line.end(), [&](char c) { return ends_field(c, delimiter); });
      const auto length = static_cast<std::size_t>(end - line.begin());
      fields.emplace_back(trimmed(line.substr(0, length)));
      line.remove_prefix(length);
    }
    if (!line.empty()) line.remove_prefix(1);  // the delimiter
    skip_blanks(line, delimiter);
  }
  return fields;
}

char guess_delimiter(std::string_view line) {
  char best = ' ';
  bool inside = false;
  for (const char c : line) {
    if (c == '"') inside = !inside;
    if (inside) continue;
    if (c == ';') return ';';
    if (c == ',') best = ',';
    if (c == '\t' && best == ' ') best = '\t';
  }
  return best;
}

bool is_number_with_comma(std::string_view word) {
  const std::size_t comma = word.find(',');
  const auto is_digit_at = [&](std::size_t i) { return i < word.size() && word[i] >= '0' && word[i] <= '9'; };
  if (comma == npos || comma == 0 || !is_digit_at(comma - 1) || !is_digit_at(comma + 1)) return false;
  std::string with_point(word);
  with_point[comma] = '.';
  double number = 0;
  return parse_number(with_point, number) == Parsed::Ok;
}

}  // namespace keenline
