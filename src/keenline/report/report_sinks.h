#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "keenline/io/sink.h"

namespace keenline {

/// JSON on its way into an HTML element: what could end it or begin another is escaped. In JSON these
/// characters stand in strings only.
class HtmlJsonSink : public Sink {
 public:
  explicit HtmlJsonSink(Sink& target) : target_(target) {}
  void write(std::string_view json) override;

 private:
  Sink& target_;
};

/// Bytes as base64, without line ends.
class Base64Sink : public Sink {
 public:
  explicit Base64Sink(Sink& target) : target_(target) {}
  void write(std::string_view bytes) override;
  /// The last characters. Nothing can be written after it.
  void finish();

 private:
  Sink& target_;
  std::string rest_;  // 0 to 2 bytes of an unfinished group
};

/// Bytes as one zlib stream (RFC 1950).
class ZlibSink : public Sink {
 public:
  /// \throw OutOfMemory
  explicit ZlibSink(Sink& target);
  ZlibSink(const ZlibSink&) = delete;
  ZlibSink& operator=(const ZlibSink&) = delete;
  ~ZlibSink() override;
  void write(std::string_view bytes) override;
  /// The last bytes. Nothing can be written after it.
  void finish();

 private:
  struct Stream;
  void deflate(std::string_view bytes, int flush);

  Sink& target_;
  std::unique_ptr<Stream> stream_;
};

}  // namespace keenline
