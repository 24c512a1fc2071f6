#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace keenline {

/// Base of everything the library throws on purpose. what() is one line without control characters.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller's mistake: an option out of range, an unknown method, columns of unequal length.
class InvalidArgument : public Error {
 public:
  using Error::Error;
};

/// Where in a file something was found.
struct Place {
  enum class Unit : std::uint8_t { File, Line, Byte };
  Unit unit = Unit::File;
  std::uint64_t number = 0;  ///< lines count from 1, bytes from 0

  static constexpr Place file() { return {Unit::File, 0}; }
  static constexpr Place line(std::uint64_t number) { return {Unit::Line, number}; }
  static constexpr Place byte(std::uint64_t offset) { return {Unit::Byte, offset}; }
};

/// An input that cannot be understood. The message names file, place, what was found and what was expected.
class InputError : public Error {
 public:
  /// "FILE: line 12: found FOUND, expected EXPECTED"
  InputError(std::string_view file, Place place, std::string_view found, std::string_view expected);
  /// "FILE: PROBLEM", for what has no place inside the file (it cannot be opened, it is a folder).
  InputError(std::string_view file, std::string_view problem);
};

/// A result that could not be written. Nothing is left at the target.
class OutputError : public Error {
 public:
  /// "FILE: PROBLEM"
  OutputError(std::string_view file, std::string_view problem);
};

/// More memory is needed than this machine or this process may have; known before it is asked for.
/// An allocation that fails unforeseen is std::bad_alloc.
class OutOfMemory : public Error {
 public:
  using Error::Error;
};

/// The caller asked for the work to stop (see Progress::cancelled).
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

/// `text` fit for a one-line message: control and non-ASCII-printable bytes that are not valid UTF-8 become
/// \xNN, anything past `longest` bytes becomes "...".
[[nodiscard]] std::string escaped(std::string_view text, std::size_t longest = 60);

/// escaped() between single quotes.
[[nodiscard]] std::string quoted(std::string_view text, std::size_t longest = 60);

/// The system's words for an errno value.
[[nodiscard]] std::string system_message(int error_number);

}  // namespace keenline
