#pragma once

#include <string>

#include "keenline/io/sink.h"

namespace keenline {

/// A file that appears whole or not at all: bytes go to a temporary file beside the target; commit() flushes
/// it to the disk and renames it. Without commit() the target is as it was before.
class OutputFile : public Sink {
 public:
  /// A target that is a symbolic link is written where the link points.
  /// \throw OutputError when the folder is missing or not writable, or the target exists and is not a regular
  /// file.
  explicit OutputFile(const std::string& path);
  /// Removes the temporary file unless committed.
  ~OutputFile() override;

  void write(std::string_view bytes) override;
  /// \throw OutputError; the target is then as it was before.
  void commit();

 private:
  void flush();

  std::string path_;       // as the caller named it, for messages
  std::string target_;     // with a symbolic link followed
  std::string temporary_;  // empty once committed or removed
  std::string buffer_;
  int descriptor_ = -1;
};

/// Removes the temporary file of an OutputFile that is open just now. Safe to call from a signal handler;
/// meant for a program that is about to end without unwinding.
void remove_unfinished_output() noexcept;

}  // namespace keenline
