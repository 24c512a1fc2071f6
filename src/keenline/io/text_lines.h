#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "keenline/io/text.h"

namespace keenline {

class Progress;
struct Source;

/// Walks through the lines of a text file, tells `progress` how far it has come, and refuses zero bytes:
/// whoever meets them reads something else, perhaps a sparse file without end.
class TextLines {
 public:
  /// All lines of the source, without a byte order mark. Refers to both arguments.
  TextLines(const Source& source, Progress& progress);
  /// The lines of `text`, a part of source.bytes that begins with line number `first_line`.
  TextLines(const Source& source, std::string_view text, std::uint64_t first_line, Progress& progress);

  /// False at the end of the text. `line` comes without its line end.
  /// \throw InputError for a zero byte in the line; Cancelled.
  [[nodiscard]] bool next(std::string_view& line);
  /// The next line that says something: up to '#', without blanks at its ends, not empty. Comments on the
  /// way, unless blank, are added to `comments` where there is one.
  [[nodiscard]] bool next_content(std::string_view& line, std::vector<std::string>* comments = nullptr);

  /// Number of the line that was given last, from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  /// What has not yet been given.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  /// Tells progress of every byte given so far; next() does so now and then and at the end of the text.
  void report();
  /// \throw InputError always: found the end of the file.
  [[noreturn]] void refuse_end(std::string_view expected) const;

 private:
  [[nodiscard]] std::size_t length_of_line() const;

  const Source* source_;
  Progress* progress_;
  std::string_view rest_;
  std::uint64_t number_;
  char line_end_;
  std::size_t unreported_ = 0;  // bytes given that progress does not know of
};

/// The blank-separated words of one line, from left to right. Whatever is wrong with one is refused with the
/// name of the file and the number of the line.
class Words {
 public:
  /// Refers to `source` and `line`; both must outlive it.
  Words(const Source& source, std::string_view line, std::uint64_t line_number)
      : source_(&source), rest_(line), line_number_(line_number) {}

  /// The next word; empty when there is none left.
  [[nodiscard]] std::string_view next();
  /// The next word as a number. \throw InputError when there is none or it is not a T.
  template <typename T>
  T number(std::string_view expected = description_of_number<T>());
  /// \throw InputError when a word is left.
  void expect_end();
  /// What next() has not yet given.
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[nodiscard]] std::uint64_t line_number() const { return line_number_; }
  /// \throw InputError always: found `word`, or the end of the line when it is empty.
  [[noreturn]] void refuse(std::string_view word, std::string_view expected) const;

 private:
  const Source* source_;
  std::string_view rest_;
  std::uint64_t line_number_;
};

// --- inline: these are the inner loop of the text readers
// --------------------------------------------------------

inline std::string_view Words::next() {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  const char* const end = rest_.data() + rest_.size();
  const char* begin = rest_.data();
  while (begin != end && is_blank(*begin)) ++begin;
  const char* word_end = begin;
  while (word_end != end && !is_blank(*word_end)) ++word_end;
  rest_ = {word_end, static_cast<std::size_t>(end - word_end)};
  return {begin, static_cast<std::size_t>(word_end - begin)};
}

template <typename T>
T Words::number(std::string_view expected) {
  const std::string_view word = next();
  T value{};
  const Parsed parsed = parse_number(word, value);
  if (parsed == Parsed::OutOfRange && std::is_same_v<T, double>)
    refuse(word, "a number that a 64-bit float can hold");
  if (parsed != Parsed::Ok) refuse(word, expected);
  return value;
}

}  // namespace keenline
