#include "keenline/report/lettering.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace keenline {
namespace {

constexpr int glyph_width = 5;
constexpr int glyph_height = 9;
constexpr int glyphs_per_band = 16;
constexpr char first_glyph = ' ';
constexpr char last_glyph = '~';

// Sixteen letters side by side in a band of nine lines, a column of blanks between them; from ' ' to '~'.
constexpr std::array<std::string_view, 54> glyph_table{
    // clang-format off
    "        #    # #   # #    #   ##  #  ##     #      #   #                                      #",
    "        #    # #   # #   #### ##  # #  #    #     #     #     #     #                         #",
    "        #    # #  ##### # #      #  # #     #    #       #  # # #   #                        # ",
    "        #          # #   ###    #    #           #       #   ###  #####        ###          #  ",
    "        #         #####   # #  #    # # #        #       #  # # #   #                      #   ",
    "                   # #  ####  #  ## #  #          #     #     #     #     #               #    ",
    "        #          # #    #   #  ##  ## #          #   #                  #           #   #    ",
    "                                                                         #                     ",
    "                                                                                               ",
    " ###    #    ###   ###     #  #####   ##  #####  ###   ###                 #         #     ### ",
    "#   #  ##   #   # #   #   ##  #      #        # #   # #   #               #           #   #   #",
    "#   #   #       #     #  # #  ####  #        #  #   # #   #   #     #    #    #####    #      #",
    "# # #   #      #    ##  #  #      # ####     #   ###   ####             #               #    # ",
    "#   #   #     #       # #####     # #   #   #   #   #     #              #    #####    #    #  ",
    "#   #   #    #    #   #    #  #   # #   #   #   #   #    #    #     #     #           #        ",
    " ###   ###  #####  ###     #   ###   ###    #    ###   ##           #      #         #      #  ",
    "                                                                   #                           ",
    "                                                                                               ",
    " ###    #   ####   ###  ###   ##### #####  ###  #   #  ###    ### #   # #     #   # #   #  ### ",
    "#   #  # #  #   # #   # #  #  #     #     #   # #   #   #      #  #  #  #     ## ## ##  # #   #",
    "# ### #   # #   # #     #   # #     #     #     #   #   #      #  # #   #     # # # # # # #   #",
    "# # # #   # ####  #     #   # ####  ####  #  ## #####   #      #  ##    #     # # # # # # #   #",
    "# ##  ##### #   # #     #   # #     #     #   # #   #   #      #  # #   #     #   # # # # #   #",
    "#     #   # #   # #   # #  #  #     #     #   # #   #   #   #  #  #  #  #     #   # #  ## #   #",
    " #### #   # ####   ###  ###   ##### #      ###  #   #  ###   ##   #   # ##### #   # #   #  ### ",
    "                                                                                               ",
    "                                                                                               ",
    "####   ###  ####   ###  ##### #   # #   # #   # #   # #   # #####  ###  #      ###    #        ",
    "#   # #   # #   # #   #   #   #   # #   # #   # #   # #   #     #  #    #        #   # #       ",
    "#   # #   # #   # #       #   #   # #   # #   #  # #   # #     #   #     #       #  #   #      ",
    "####  #   # ####   ###    #   #   # #   # # # #   #     #     #    #      #      #             ",
    "#     # # # # #       #   #   #   #  # #  # # #  # #    #    #     #       #     #             ",
    "#     #  #  #  #  #   #   #   #   #  # #  ## ## #   #   #   #      #        #    #             ",
    "#      ## # #   #  ###    #    ###    #   #   # #   #   #   #####  ###      #  ###             ",
    "                                                                                          #####",
    "                                                                                               ",
    " #          #               #         ##        #       #      #  #      ##                    ",
    "  #         #               #        #          #                 #       #                    ",
    "       ###  ####   ###   ####  ###  ###    #### ####   ##     ##  #  #    #   ####  ####   ### ",
    "          # #   # #   # #   # #   #  #    #   # #   #   #      #  # #     #   # # # #   # #   #",
    "       #### #   # #     #   # #####  #    #   # #   #   #      #  ##      #   # # # #   # #   #",
    "      #   # #   # #   # #   # #      #    #   # #   #   #      #  # #     #   # # # #   # #   #",
    "       #### ####   ###   ####  ###   #     #### #   #  ###     #  #  #     ## # # # #   #  ### ",
    "                                              #                #                               ",
    "                                           ###               ##                                ",
    "                         #                                           #    #    #               ",
    "                         #                                          #     #     #              ",
    "####   #### # ##   #### ####  #   # #   # #   # #   # #   # #####   #     #     #    #  #      ",
    "#   # #   # ##  # #      #    #   # #   # #   #  # #  #   #    #   #      #      #  # # #      ",
    "#   # #   # #      ###   #    #   #  # #  # # #   #   #   #   #     #     #     #   #  #       ",
    "#   # #   # #         #  #    #   #  # #  # # #  # #  #   #  #      #     #     #              ",
    "####   #### #     ####    ##   ####   #    # #  #   #  #### #####    #    #    #               ",
    "#         #                                               #               #                    ",
    "#         #                                            ###                                     ",
    // clang-format on
};

bool is_lit(char letter, int column, int row) {
  if (column < 0 || row < 0 || column >= glyph_width || row >= glyph_height) return false;
  const int number = letter - first_glyph;
  const int line = number / glyphs_per_band * glyph_height + row;
  const int place = number % glyphs_per_band * (glyph_width + 1) + column;
  return glyph_table[static_cast<std::size_t>(line)][static_cast<std::size_t>(place)] == '#';
}

/// Columns that a letter occupies. Digits keep the full width, so that numbers stand in columns.
struct Columns {
  int first = 0;
  int count = glyph_width;
};

Columns columns_of(char letter) {
  if (letter == ' ') return {0, 3};
  if (letter >= '0' && letter <= '9') return {};
  int first = glyph_width;
  int last = 0;
  for (int row = 0; row < glyph_height; ++row) {
    for (int column = 0; column < glyph_width; ++column) {
      if (!is_lit(letter, column, row)) continue;
      first = std::min(first, column);
      last = std::max(last, column);
    }
  }
  return {first, last - first + 1};
}

/// Blank columns between letters: strokes are round and as wide as a dot.
constexpr double gap = 1.3;

void draw_letter(Image& image, double x, double y, char letter, double dot, Color color) {
  const int first = columns_of(letter).first;
  const auto join = [&](int column, int row, int to_column, int to_row) {
    const auto center_x = [&](int c) { return x + (c - first + 0.5) * dot; };
    const auto center_y = [&](int r) { return y + (r + 0.5) * dot; };
    draw_line(image, center_x(column), center_y(row), center_x(to_column), center_y(to_row), dot, color);
  };
  for (int row = 0; row < glyph_height; ++row) {
    for (int column = 0; column < glyph_width; ++column) {
      if (!is_lit(letter, column, row)) continue;
      join(column, row, column, row);
      if (is_lit(letter, column + 1, row)) join(column, row, column + 1, row);
      if (is_lit(letter, column, row + 1)) join(column, row, column, row + 1);
      // A diagonal joins only what is not joined around the corner.
      for (const int side : {-1, 1}) {
        if (is_lit(letter, column + side, row + 1) && !is_lit(letter, column + side, row) &&
            !is_lit(letter, column, row + 1))
          join(column, row, column + side, row + 1);
      }
    }
  }
}

/// Calls visit(letter) for each: printable ASCII as it is, else '?' for each character.
template <typename Visit>
void for_each_letter(std::string_view text, const Visit& visit) {
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (!continues) visit(c >= first_glyph && c <= last_glyph ? c : '?');
  }
}

}  // namespace

void draw_text(Image& image, double x, double y, std::string_view text, double dot, Color color) {
  for_each_letter(text, [&](char letter) {
    draw_letter(image, x, y, letter, dot, color);
    x += (columns_of(letter).count + gap) * dot;
  });
}

double text_width(std::string_view text, double dot) {
  double columns = 0;
  for_each_letter(text, [&](char letter) { columns += columns_of(letter).count + gap; });
  return columns > 0 ? (columns - gap) * dot : 0;
}

std::string fitted(std::string_view text, double width, double dot) {
  if (text_width(text, dot) <= width) return std::string(text);
  const double room = width - text_width(" ...", dot);
  double columns = 0;
  std::string beginning;
  for_each_letter(text, [&](char letter) {
    columns += columns_of(letter).count + gap;
    if (columns * dot <= room) beginning += letter;
  });
  return beginning + "...";
}

}  // namespace keenline
