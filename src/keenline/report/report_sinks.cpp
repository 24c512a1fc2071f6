#include "keenline/report/report_sinks.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#define ZLIB_CONST  // what is compressed is only read
#include <zlib.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr std::string_view base64_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Three bytes become four digits.
void append_base64(std::string& text, std::string_view group) {
  std::uint32_t bits = 0;
  for (const char c : group) bits = bits << 8U | static_cast<unsigned char>(c);
  for (const unsigned shift : {18U, 12U, 6U, 0U}) text += base64_digits[bits >> shift & 63U];
}

}  // namespace

void HtmlJsonSink::write(std::string_view json) {
  for (std::size_t special = 0; (special = json.find_first_of("<>&")) != std::string_view::npos;) {
    target_.write(json.substr(0, special));
    target_.write(json[special] == '<' ? "\\u003c" : json[special] == '>' ? "\\u003e" : "\\u0026");
    json.remove_prefix(special + 1);
  }
  target_.write(json);
}

void Base64Sink::write(std::string_view bytes) {
  if (!rest_.empty()) {
    const std::string_view missing = bytes.substr(0, 3 - rest_.size());
    rest_ += missing;
    bytes.remove_prefix(missing.size());
    if (rest_.size() < 3) return;
  }
  std::string text;
  text.reserve((bytes.size() / 3 + 1) * 4);
  if (!rest_.empty()) append_base64(text, rest_);
  for (; bytes.size() >= 3; bytes.remove_prefix(3)) append_base64(text, bytes.substr(0, 3));
  rest_ = bytes;
  target_.write(text);
}

void Base64Sink::finish() {
  if (rest_.empty()) return;
  const std::size_t missing = 3 - rest_.size();
  rest_.append(missing, '\0');
  std::string text;
  append_base64(text, rest_);
  text.replace(4 - missing, missing, missing, '=');
  target_.write(text);
  rest_.clear();
}

struct ZlibSink::Stream : z_stream {};

ZlibSink::ZlibSink(Sink& target) : target_(target), stream_(std::make_unique<Stream>()) {
  if (::deflateInit(stream_.get(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw OutOfMemory("no memory to compress the data of a report");
}

ZlibSink::~ZlibSink() { (void)::deflateEnd(stream_.get()); }

void ZlibSink::deflate(std::string_view bytes, int flush) {
  std::array<char, 1U << 16U> out;
  stream_->next_in = reinterpret_cast<const Bytef*>(bytes.data());
  stream_->avail_in = static_cast<uInt>(bytes.size());
  do {
    stream_->next_out = reinterpret_cast<Bytef*>(out.data());
    stream_->avail_out = static_cast<uInt>(out.size());
    (void)::deflate(stream_.get(), flush);  // cannot fail: the stream is whole, and there is room
    target_.write({out.data(), out.size() - stream_->avail_out});
  } while (stream_->avail_out == 0);
}

void ZlibSink::write(std::string_view bytes) {
  constexpr std::size_t largest = std::size_t{1} << 20U;  // zlib counts in 32 bits
  for (; !bytes.empty(); bytes.remove_prefix(std::min(largest, bytes.size())))
    deflate(bytes.substr(0, largest), Z_NO_FLUSH);
}

void ZlibSink::finish() { deflate({}, Z_FINISH); }

}  // namespace keenline
