#pragma once

#include <cstdint>
#include <string_view>

namespace keenline {

/// How long work reports itself and learns that it should stop. Derive from it to draw a bar or to cancel.
/// advance() and check() are called from many threads at once; begin() from one.
class Progress {
 public:
  Progress() = default;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  virtual ~Progress() = default;

  /// A stage starts: its name ("reading") and how many units it has (0 = unknown).
  virtual void begin(std::string_view /*stage*/, std::uint64_t /*total*/) {}
  /// `units` more are done.
  virtual void advance(std::uint64_t /*units*/) {}
  /// True when the work should stop. Called often: keep it to an atomic load.
  [[nodiscard]] virtual bool cancelled() const { return false; }

  /// \throw Cancelled when the work should stop.
  void check() const;
};

/// Reports nothing and never cancels.
[[nodiscard]] Progress& no_progress();

}  // namespace keenline
