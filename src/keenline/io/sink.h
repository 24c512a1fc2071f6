#pragma once

#include <string>
#include <string_view>

namespace keenline {

/// Where a writer's bytes go, in order.
class Sink {
 public:
  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  virtual ~Sink() = default;

  /// \throw OutputError when the bytes could not be stored.
  virtual void write(std::string_view bytes) = 0;
};

/// Keeps everything in memory.
class StringSink : public Sink {
 public:
  void write(std::string_view bytes) override { text += bytes; }
  std::string text;
};

}  // namespace keenline
