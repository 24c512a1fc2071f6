#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/labels.h"
#include "keenline/report/image.h"

namespace keenline {

/// What a colour means.
struct LegendEntry {
  Color color;
  std::string text;
};

/// Colours that people with any kind of colour vision can tell apart (after M. Okabe and K. Ito): light for
/// what is not sharp, strong for what is.
[[nodiscard]] Color color_of(Kind kind);

/// Colours for things that only need to be different, as in color_of(); from the ninth on they repeat.
[[nodiscard]] Color color_of_number(int number);

/// Dark violet over green to yellow: evenly rising brightness. `share` 0 to 1.
[[nodiscard]] Color color_of_share(double share);

/// An entry "edge 1,234" for each kind that occurs, in the order of all_kinds.
[[nodiscard]] std::vector<LegendEntry> legend_of(std::span<const Kind> kinds);

/// Size of letters (see lettering.h) that suits a picture of this width.
[[nodiscard]] double dot_for(int width);

/// Pixels that draw_legend() needs in an image of this width; 0 for no entries.
[[nodiscard]] int legend_height(std::span<const LegendEntry> entries, int width);

/// Entries side by side in as many rows as they need, centred, from `top` on.
void draw_legend(Image& image, int top, std::span<const LegendEntry> entries);

/// A bar of color_of_share() with the values at its ends and its name, in the height of a line of a legend.
void draw_color_bar(Image& image, int top, std::string_view name, std::string_view low,
                    std::string_view high);

/// Pixels that draw_caption() needs; 0 for no caption.
[[nodiscard]] int caption_height(std::string_view caption, int width);

/// A line in the middle of the upper rim, cut off where it is too long.
void draw_caption(Image& image, std::string_view caption);

}  // namespace keenline
