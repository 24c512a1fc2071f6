#include "keenline/io/lzf.h"

#include <algorithm>
#include <cstring>

#include "keenline/progress.h"

namespace keenline {

std::optional<LzfError> decompress_lzf(std::string_view compressed, std::vector<char>& output,
                                       const Progress& progress) {
  constexpr std::size_t bytes_per_check = 1U << 20U;
  std::size_t in = 0;
  std::size_t out = 0;
  std::size_t next_check = 0;
  const auto byte = [&](std::size_t i) -> unsigned { return static_cast<unsigned char>(compressed[i]); };

  while (in < compressed.size()) {
    if (in + out >= next_check) {
      progress.check();
      next_check = in + out + bytes_per_check;
    }
    const std::size_t start = in;
    const unsigned control = byte(in++);
    if (control < 0x20) {
      const std::size_t length = control + 1;
      if (length > compressed.size() - in)
        return LzfError{start, "literal bytes past the end of the compressed data"};
      if (length > output.size() - out) return LzfError{start, "more data than declared"};
      std::memcpy(output.data() + out, compressed.data() + in, length);
      in += length;
      out += length;
      continue;
    }
    const bool is_long = control >= 0xE0;
    if (compressed.size() - in < (is_long ? 2U : 1U)) return LzfError{start, "half a repetition"};
    const std::size_t length = (is_long ? 7 + byte(in++) : control >> 5U) + 2;
    const std::size_t distance = ((control & 0x1FU) << 8U) + byte(in++) + 1;
    if (distance > out) return LzfError{start, "a repetition of bytes before the first"};
    if (length > output.size() - out) return LzfError{start, "more data than declared"};
    char* const to = output.data() + out;
    const char* const from = to - distance;
    if (distance >= length) {
      std::memcpy(to, from, length);
    } else {
      for (std::size_t i = 0; i < length; ++i) to[i] = from[i];  // overlaps: byte by byte
    }
    out += length;
  }
  if (out < output.size()) return LzfError{in, "less data than declared"};
  return std::nullopt;
}

}  // namespace keenline
