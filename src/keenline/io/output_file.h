#pragma once

#include <span>
#include <string>

#include "keenline/io/sink.h"

namespace keenline {

/// A file that appears whole or not at all: bytes go to a temporary file beside the target, which store()
/// flushes to the disk and commit() renames. Without commit() the target is as it was before.
class OutputFile : public Sink {
 public:
  /// A target that is a symbolic link is written where the link points.
  /// \throw OutputError when the folder is missing or not writable, or the target exists and is not a regular
  /// file.
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  /// Removes the temporary file unless committed.
  ~OutputFile() override;

  void write(std::string_view bytes) override;
  /// Brings every byte to the disk; nothing can be written after it. \throw OutputError.
  void store();
  /// store(), unless that is done, and the target is the new file.
  /// \throw OutputError; the target is then as it was before.
  void commit();

 private:
  void flush();
  void publish(int folder);

  std::string path_;       // as the caller named it, for messages
  std::string target_;     // with a symbolic link followed
  std::string folder_;     // of the target
  std::string temporary_;  // empty once committed or removed
  std::string buffer_;
  int descriptor_ = -1;  // none once stored
};

/// The input is precious: a result never replaces it.
/// \throw InvalidArgument when both names lead to the same file.
void require_different_files(const std::string& input, const std::string& output);

/// One result never replaces another.
/// \throw InvalidArgument when two of the names lead to the same file, whether that exists or not.
void require_distinct_outputs(std::span<const std::string> paths);

/// Removes the temporary file of an OutputFile that is open just now. Safe to call from a signal handler;
/// meant for a program that is about to end without unwinding.
void remove_unfinished_output() noexcept;

}  // namespace keenline
