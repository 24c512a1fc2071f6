#pragma once

#include <string>
#include <string_view>

#include "keenline/report/image.h"

namespace keenline {

/// A font of the project's own: ASCII 32 to 126 on a grid of 5 x 9 dots, neighbouring dots joined by round
/// strokes, in any size. `dot` is the width of one grid cell in pixels: capital letters are 7 of them high,
/// lines lettering_line dots apart. What is not printable ASCII appears as '?', one for each UTF-8 character.
inline constexpr double lettering_line = 12;

/// (x, y) is the upper left corner of the first letter.
void draw_text(Image& image, double x, double y, std::string_view text, double dot, Color color = ink);

/// Pixels from the first letter's left to the last one's right.
[[nodiscard]] double text_width(std::string_view text, double dot);

/// The text, or when that is wider than `width` pixels its beginning and "...".
[[nodiscard]] std::string fitted(std::string_view text, double width, double dot);

}  // namespace keenline
