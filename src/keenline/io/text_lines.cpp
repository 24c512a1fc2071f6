#include "keenline/io/text_lines.h"

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/io/text_split.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr std::size_t npos = std::string_view::npos;
constexpr std::size_t window = 65536;

}  // namespace

TextLines::TextLines(const Source& source, Progress& progress)
    : TextLines(source, without_bom(source.bytes), 1, progress) {
  unreported_ = source.bytes.size() - rest_.size();
}

TextLines::TextLines(const Source& source, std::string_view text, std::uint64_t first_line,
                     Progress& progress)
    : source_(&source),
      progress_(&progress),
      rest_(text),
      number_(first_line - 1),
      line_end_(line_end_of(text)) {}

bool TextLines::next(std::string_view& line) {
  if (rest_.empty() || unreported_ >= window) report();
  if (rest_.empty()) return false;
  ++number_;
  const std::size_t length = length_of_line();
  const std::size_t taken = length < rest_.size() ? length + 1 : length;
  line = rest_.substr(0, length);
  if (line_end_ == '\n' && line.ends_with('\r')) line.remove_suffix(1);
  rest_.remove_prefix(taken);
  unreported_ += taken;
  return true;
}

std::size_t TextLines::length_of_line() const {
  for (std::size_t begin = 0; begin < rest_.size(); begin += window) {
    const std::string_view part = rest_.substr(begin, window);
    const std::size_t end = part.find(line_end_);
    if (part.substr(0, end).find('\0') != npos)
      throw InputError(source_->name, Place::line(number_), "a zero byte", "text");
    if (end != npos) return begin + end;
    progress_->check();
  }
  return rest_.size();
}

bool TextLines::next_content(std::string_view& line, std::vector<std::string>* comments) {
  while (next(line)) {
    const std::size_t hash = line.find('#');
    if (comments != nullptr && hash != npos) {
      if (const std::string_view comment = trimmed(line.substr(hash + 1)); !comment.empty())
        comments->emplace_back(comment);
    }
    line = trimmed(line.substr(0, hash));
    if (!line.empty()) return true;
  }
  return false;
}

void TextLines::report() {
  progress_->check();
  progress_->advance(unreported_);
  unreported_ = 0;
}

void TextLines::refuse_end(std::string_view expected) const {
  throw InputError(source_->name, Place::line(number_), "the end of the file", expected);
}

void Words::expect_end() {
  if (const std::string_view word = next(); !word.empty()) refuse(word, "the end of the line");
}

void Words::refuse(std::string_view word, std::string_view expected) const {
  throw InputError(source_->name, Place::line(line_number_),
                   word.empty() ? "the end of the line" : quoted(word), expected);
}

}  // namespace keenline
