#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "keenline/progress.h"

namespace keenline::cli {

/// A closed stdin, stdout or stderr is occupied, so that no file opened later takes its number and receives
/// what is meant for the terminal; reading and writing it fail as before.
void occupy_closed_descriptors();

/// From now on SIGINT, SIGTERM and SIGHUP ask the work to stop (a second one ends the program at once), a
/// file that shrinks while it is read ends it with exit code 1, and a file size limit or a closed pipe is a
/// failed write. Temporary output files are removed in every case.
void install_signal_handlers();

/// The signal that asked the work to stop; 0 when none did.
[[nodiscard]] int interrupting_signal();

/// Draws a bar on stderr when that is a terminal; cancels the work when a signal asked for it.
class TerminalProgress : public Progress {
 public:
  explicit TerminalProgress(bool quiet);
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;
  ~TerminalProgress() override;
  void begin(std::string_view stage, std::uint64_t total) override;
  void advance(std::uint64_t units) override;
  [[nodiscard]] bool cancelled() const override { return interrupting_signal() != 0; }
  /// Removes the bar, so that something else can be printed.
  void clear() const;

 private:
  void draw() const;

  bool visible_;
  std::string stage_;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::int64_t> next_drawing_ms_{0};
};

/// From now on so many threads are used for everything, fewer where the system does not give them;
/// 0 = all there are. \throw InvalidArgument unless 0 <= threads <= 1024
void limit_threads(int threads);

/// "keenline: note: …", a line each, on stderr.
void print_notes(std::string_view file, const std::vector<std::string>& notes);

/// Text to stdout. \throw OutputError when stdout does not take it (full disk, closed pipe).
void print(std::string_view text);
void print_json(nlohmann::json object);

}  // namespace keenline::cli
