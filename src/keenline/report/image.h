#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace keenline {

/// sRGB.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  friend bool operator==(const Color&, const Color&) = default;
};

inline constexpr Color white{255, 255, 255};
inline constexpr Color ink{38, 42, 48};  ///< of text and lines

/// `share` of b in a, 0 to 1.
[[nodiscard]] Color mixed(Color a, Color b, double share);

/// Pixels in rows from the top left. Shapes are placed in pixels from the upper left corner of the image: the
/// centre of its first pixel is (0.5, 0.5). What lies outside is not drawn.
class Image {
 public:
  Image() = default;
  /// \throw InvalidArgument unless both are 1 to largest_side.
  Image(int width, int height, Color color = white);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::span<const Color> pixels() const { return pixels_; }
  /// \pre 0 <= x < width(), 0 <= y < height()
  [[nodiscard]] Color& at(int x, int y) { return pixels_[index(x, y)]; }
  [[nodiscard]] Color at(int x, int y) const { return pixels_[index(x, y)]; }

  static constexpr int largest_side = 32768;

 private:
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<Color> pixels_;
};

/// A line with round ends, smooth at its rim. Of length 0: a disc.
void draw_line(Image& image, double x0, double y0, double x1, double y1, double thickness, Color color,
               double opacity = 1);
void draw_disc(Image& image, double x, double y, double radius, Color color, double opacity = 1);

/// Copies `part` so that its upper left corner comes to (x, y).
void paste(Image& image, const Image& part, int x, int y);

/// Images in rows of `columns`, left to right, every row as high as its highest, every column as wide as its
/// widest. \throw InvalidArgument when the sheet would be larger than an image may be, or there is nothing to
/// put on it.
[[nodiscard]] Image sheet_of(std::span<const Image> images, int columns);

}  // namespace keenline
