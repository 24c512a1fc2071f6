#include "keenline/report/legend.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "keenline/io/text.h"
#include "keenline/report/lettering.h"

namespace keenline {
namespace {

constexpr Color edge_color{213, 94, 0};
constexpr Color corner_color{0, 68, 158};
constexpr Color peak_color{204, 121, 167};
constexpr Color border_color{0, 140, 104};

// In dots.
constexpr double swatch_radius = 3.3;
constexpr double swatch_gap = 2.5;
constexpr double entry_gap = 6;
constexpr double side_margin = 4;

double entry_width(const LegendEntry& entry, double dot) {
  return (2 * swatch_radius + swatch_gap) * dot + text_width(entry.text, dot);
}

struct Row {
  std::size_t first = 0;
  std::size_t end = 0;
  double width = 0;
};

std::vector<Row> rows_of(std::span<const LegendEntry> entries, int width, double dot) {
  std::vector<Row> rows;
  const double room = width - 2 * side_margin * dot;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double needed = entry_width(entries[i], dot);
    if (rows.empty() || rows.back().width + entry_gap * dot + needed > room) {
      rows.push_back({i, i + 1, needed});
      continue;
    }
    rows.back().end = i + 1;
    rows.back().width += entry_gap * dot + needed;
  }
  return rows;
}

}  // namespace

Color color_of(Kind kind) {
  switch (kind) {
    case Kind::Flat: return {228, 228, 224};
    case Kind::Curved: return {139, 188, 222};
    case Kind::Edge: return edge_color;
    case Kind::Corner: return corner_color;
    case Kind::Peak: return peak_color;
    case Kind::Border: return border_color;
    case Kind::Undecided: break;
  }
  return {96, 96, 96};
}

Color color_of_number(int number) {
  constexpr std::array colors{edge_color,          corner_color,       border_color,
                              peak_color,          Color{230, 170, 0}, Color{86, 180, 233},
                              Color{122, 76, 160}, Color{90, 60, 30}};
  return colors[static_cast<std::size_t>(number) % colors.size()];
}

Color color_of_share(double share) {
  constexpr std::array<Color, 9> colors{{{68, 1, 84},
                                         {71, 44, 122},
                                         {59, 81, 139},
                                         {44, 113, 142},
                                         {33, 144, 141},
                                         {39, 173, 129},
                                         {92, 200, 99},
                                         {170, 220, 50},
                                         {253, 231, 37}}};
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), colors.size() - 2);
  return mixed(colors[lower], colors[lower + 1], place - static_cast<double>(lower));
}

std::vector<LegendEntry> legend_of(std::span<const Kind> kinds) {
  std::vector<LegendEntry> entries;
  for (const Kind kind : all_kinds) {
    const auto count = static_cast<std::uint64_t>(std::count(kinds.begin(), kinds.end(), kind));
    if (count > 0) entries.push_back({color_of(kind), fmt::format("{} {}", name_of(kind), grouped(count))});
  }
  return entries;
}

double dot_for(int width) { return std::clamp(width / 380.0, 1.2, 4.0); }

int legend_height(std::span<const LegendEntry> entries, int width) {
  const double dot = dot_for(width);
  const auto rows = static_cast<double>(rows_of(entries, width, dot).size());
  return entries.empty() ? 0 : static_cast<int>(std::ceil((rows * lettering_line + 4) * dot));
}

void draw_legend(Image& image, int top, std::span<const LegendEntry> entries) {
  const double dot = dot_for(image.width());
  double y = top;
  for (const Row& row : rows_of(entries, image.width(), dot)) {
    double x = std::max((image.width() - row.width) / 2, side_margin * dot);
    for (std::size_t i = row.first; i < row.end; ++i) {
      draw_disc(image, x + swatch_radius * dot, y + 3.5 * dot, swatch_radius * dot, entries[i].color);
      draw_text(image, x + (2 * swatch_radius + swatch_gap) * dot, y, entries[i].text, dot);
      x += entry_width(entries[i], dot) + entry_gap * dot;
    }
    y += lettering_line * dot;
  }
}

void draw_color_bar(Image& image, int top, std::string_view name, std::string_view low,
                    std::string_view high) {
  const double dot = dot_for(image.width());
  const double margin = side_margin * dot;
  const std::string title = fitted(name, 0.4 * image.width(), dot);
  double x = margin;
  draw_text(image, x, top, title, dot);
  x += text_width(title, dot) + 2 * margin;
  draw_text(image, x, top, low, dot);
  x += text_width(low, dot) + margin;
  const double end = image.width() - 2 * margin - text_width(high, dot);
  for (int column = static_cast<int>(x); column < static_cast<int>(end); ++column) {
    for (int row = top; row < top + static_cast<int>(7 * dot); ++row) {
      if (column >= 0 && column < image.width() && row >= 0 && row < image.height())
        image.at(column, row) = color_of_share((column - x) / std::max(1.0, end - x));
    }
  }
  draw_text(image, end + margin, top, high, dot);
}

int caption_height(std::string_view caption, int width) {
  return caption.empty() ? 0 : static_cast<int>(std::ceil((lettering_line + 6) * dot_for(width)));
}

void draw_caption(Image& image, std::string_view caption) {
  const double dot = dot_for(image.width());
  const std::string text = fitted(caption, image.width() - 2 * side_margin * dot, dot);
  draw_text(image, (image.width() - text_width(text, dot)) / 2, 6 * dot, text, dot);
}

}  // namespace keenline
