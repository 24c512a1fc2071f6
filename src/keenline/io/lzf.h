#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace keenline {

class Progress;

/// Where compressed data stop making sense.
struct LzfError {
  std::size_t position = 0;  ///< byte in the compressed data
  std::string_view found;
};

/// No n bytes of LZF stand for more than n times this: three of them repeat at most 264.
inline constexpr std::size_t lzf_largest_ratio = 88;

/// Decompresses LZF data that fill `output` exactly.
///
/// The data are a sequence of
///   000nnnnn + n+1 bytes                 those bytes
///   lllooooo oooooooo                    l+2 bytes from o+1 bytes back in the output, 1 <= l <= 6
///   111ooooo llllllll oooooooo           l+9 bytes from o+1 bytes back
/// where what is repeated may overlap what it makes.
/// \throw Cancelled.
[[nodiscard]] std::optional<LzfError> decompress_lzf(std::string_view compressed, std::vector<char>& output,
                                                     const Progress& progress);

}  // namespace keenline
