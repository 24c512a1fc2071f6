#include "keenline/report/image.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {

Color mixed(Color a, Color b, double share) {
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(from + (to - from) * std::clamp(share, 0.0, 1.0)));
  };
  return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

Image::Image(int width, int height, Color color) : width_(width), height_(height) {
  if (width < 1 || height < 1 || width > largest_side || height > largest_side)
    throw InvalidArgument(
        fmt::format("an image of {} x {} pixels; expected 1 to {} each way", width, height, largest_side));
  pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), color);
}

void draw_line(Image& image, double x0, double y0, double x1, double y1, double thickness, Color color,
               double opacity) {
  const double radius = thickness / 2;
  // Clamped as doubles: what lies far outside has no whole number.
  const auto pixel = [](double place, int size) {
    return static_cast<int>(std::clamp(std::floor(place), 0.0, static_cast<double>(size)));
  };
  const int left = pixel(std::min(x0, x1) - radius - 1, image.width());
  const int right = pixel(std::max(x0, x1) + radius + 2, image.width());
  const int top = pixel(std::min(y0, y1) - radius - 1, image.height());
  const int bottom = pixel(std::max(y0, y1) + radius + 2, image.height());
  const double along_x = x1 - x0;
  const double along_y = y1 - y0;
  const double squared_length = along_x * along_x + along_y * along_y;
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double from_x = x + 0.5 - x0;
      const double from_y = y + 0.5 - y0;
      const double share = squared_length > 0
                               ? std::clamp((from_x * along_x + from_y * along_y) / squared_length, 0.0, 1.0)
                               : 0;
      const double off_x = from_x - share * along_x;
      const double off_y = from_y - share * along_y;
      const double coverage = radius + 0.5 - std::sqrt(off_x * off_x + off_y * off_y);
      if (coverage > 0) image.at(x, y) = mixed(image.at(x, y), color, std::min(1.0, coverage) * opacity);
    }
  }
}

void draw_disc(Image& image, double x, double y, double radius, Color color, double opacity) {
  draw_line(image, x, y, x, y, 2 * radius, color, opacity);
}

void paste(Image& image, const Image& part, int x, int y) {
  for (int row = std::max(0, -y); row < part.height() && y + row < image.height(); ++row)
    for (int column = std::max(0, -x); column < part.width() && x + column < image.width(); ++column)
      image.at(x + column, y + row) = part.at(column, row);
}

Image sheet_of(std::span<const Image> images, int columns) {
  if (images.empty() || columns < 1)
    throw InvalidArgument(fmt::format("a sheet of {} pictures in {} columns", images.size(), columns));
  const std::size_t across = std::min(images.size(), static_cast<std::size_t>(columns));
  std::vector<std::int64_t> widths(across);
  std::vector<std::int64_t> heights((images.size() + across - 1) / across);
  for (std::size_t i = 0; i < images.size(); ++i) {
    widths[i % across] = std::max<std::int64_t>(widths[i % across], images[i].width());
    heights[i / across] = std::max<std::int64_t>(heights[i / across], images[i].height());
  }
  const std::int64_t width = std::accumulate(widths.begin(), widths.end(), std::int64_t{0});
  const std::int64_t height = std::accumulate(heights.begin(), heights.end(), std::int64_t{0});
  if (width > Image::largest_side || height > Image::largest_side) {
    throw InvalidArgument(fmt::format("a sheet of {} x {} pixels; expected up to {} each way", width, height,
                                      Image::largest_side));
  }
  Image sheet(static_cast<int>(width), static_cast<int>(height));
  std::int64_t y = 0;
  for (std::size_t row = 0; row < heights.size(); ++row) {
    std::int64_t x = 0;
    for (std::size_t column = 0; column < across && row * across + column < images.size(); ++column) {
      paste(sheet, images[row * across + column], static_cast<int>(x), static_cast<int>(y));
      x += widths[column];
    }
    y += heights[row];
  }
  return sheet;
}

}  // namespace keenline
