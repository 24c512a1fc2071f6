#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/io/ply_header.h"

namespace keenline {

class Progress;
struct Source;

/// The rows of one element, and where they begin in the file.
struct PlyRows {
  Table table;
  std::size_t start_byte = 0;
  std::uint64_t start_line = 0;  ///< ascii only
};

/// What follows a header: the rows of one element after another.
class PlyBody {
 public:
  /// Refers to all three; they must outlive it.
  PlyBody(const Source& source, const PlyHeader& header, Progress& progress);

  /// Where the header alone tells how long the file must be (or must be at least), before any row is read.
  /// \throw InputError when it is not.
  void require_sizes() const;

  /// The rows of the next element, which are to be asked for in the order of the header.
  /// \throw InputError when the rest of the file cannot hold them or they are not exactly understood;
  /// Cancelled.
  [[nodiscard]] PlyRows read(const PlyElement& element);

  /// \throw InputError when anything but white space and a few bytes of padding follows the last element.
  void expect_end() const;

  /// Where a row stands: its line, or the byte at which it begins.
  [[nodiscard]] Place place_of(const PlyRows& rows, std::uint64_t row) const;

 private:
  /// \param position of its first row
  void require_room(const PlyElement& element, std::size_t position) const;
  void expect_end_at(std::size_t end) const;
  Table read_ascii_scalars(const PlyElement& element);
  Table read_ascii_lists(const PlyElement& element);
  Table read_binary_scalars(const PlyElement& element);
  Table read_binary_lists(const PlyElement& element);
  /// Line in which `byte` stands; where the rows end, when the file has no lines.
  [[nodiscard]] Place place_after_rows(std::size_t end, std::size_t byte) const;
  [[nodiscard]] std::string_view rest() const;

  const Source& source_;
  const PlyHeader& header_;
  Progress& progress_;
  std::size_t position_;  // of the next byte
  std::uint64_t line_;    // number of the next line; ascii only
};

}  // namespace keenline
