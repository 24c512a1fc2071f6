#include "keenline/report/splats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/memory.h"

namespace keenline {
namespace {

constexpr float nothing_there = -std::numeric_limits<float>::infinity();

/// What is seen at one sample.
struct Sample {
  float depth = nothing_there;
  Color color;
};

class SampleGrid {
 public:
  SampleGrid(int width, int height)
      : width_(width),
        height_(height),
        samples_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Sample& at(int x, int y) {
    return samples_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x)];
  }
  [[nodiscard]] const Sample& at(int x, int y) const { return const_cast<SampleGrid&>(*this).at(x, y); }
  /// Depth, or nothing_there outside the grid.
  [[nodiscard]] float depth(int x, int y) const {
    return x < 0 || y < 0 || x >= width_ || y >= height_ ? nothing_there : at(x, y).depth;
  }

 private:
  int width_;
  int height_;
  std::vector<Sample> samples_;
};

/// Light from the upper left in steps: few different colours make small files.
float light_on(const std::array<float, 3>& normal) {
  const float lambert = std::max(0.0F, -0.42F * normal[0] + 0.55F * normal[1] + 0.72F * normal[2]);
  return std::min(1.0F, 0.7F + 0.34F * std::round(lambert * 16) / 16);
}

Color dimmed(Color color, float light) {
  const auto dim = [light](std::uint8_t part) {
    return static_cast<std::uint8_t>(std::lround(part * light));
  };
  return {dim(color.red), dim(color.green), dim(color.blue)};
}

/// Discs seen from the side keep this share of their breadth: a surface seen from the side stays closed.
constexpr float narrowest = 0.3F;

/// In samples.
void draw(const Splat& splat, SampleGrid& grid) {
  const bool is_disc = !splat.is_marker && splat.normal != std::array<float, 3>{};
  const float facing = std::max(splat.normal[2], narrowest);
  // Depth of the disc's plane where it leaves the centre; y of the normal points up.
  const float slope_x = is_disc ? -splat.normal[0] / facing : 0;
  const float slope_y = is_disc ? splat.normal[1] / facing : 0;
  const float squared_radius = splat.radius * splat.radius;
  const Color color = is_disc ? dimmed(splat.color, light_on(splat.normal)) : splat.color;
  const Color rim = dimmed(splat.color, 0.72F);

  // Clamped as numbers: what lies far outside has no whole number.
  const auto sample = [](float place, int size) {
    return static_cast<int>(std::clamp(std::floor(place), 0.0F, static_cast<float>(size)));
  };
  const int left = sample(splat.x - splat.radius, grid.width());
  const int right = sample(splat.x + splat.radius + 1, grid.width());
  const int top = sample(splat.y - splat.radius, grid.height());
  const int bottom = sample(splat.y + splat.radius + 1, grid.height());
  const auto put = [&](int x, int y, float depth, Color seen) {
    Sample& nearest = grid.at(x, y);
    if (depth > nearest.depth) nearest = {depth, seen};
  };
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const float dx = static_cast<float>(x) + 0.5F - splat.x;
      const float dy = static_cast<float>(y) + 0.5F - splat.y;
      const float rise = slope_x * dx + slope_y * dy;
      const float squared_distance = dx * dx + dy * dy + rise * rise;
      if (squared_distance > squared_radius) continue;
      if (!splat.is_marker) {
        put(x, y, splat.depth + rise, color);
        continue;
      }
      const float height = std::sqrt(squared_radius - squared_distance);
      put(x, y, splat.depth + height, squared_distance > 0.62F * squared_radius ? rim : color);
    }
  }
}

/// In samples; the splats' own unit is the pixel.
Splat scaled(Splat splat, float factor) {
  splat.x *= factor;
  splat.y *= factor;
  splat.depth *= factor;
  // Nothing is so small that it falls between the samples.
  splat.radius = std::max(splat.radius * factor, 0.75F);
  return splat;
}

bool is_drawable(const Splat& splat) {
  return std::isfinite(splat.x) && std::isfinite(splat.y) && std::isfinite(splat.depth) &&
         std::isfinite(splat.radius);
}

/// How much nearer the surroundings are, 0 to 1.
float shadow_at(const SampleGrid& grid, int x, int y, int reach) {
  const float depth = grid.at(x, y).depth;
  constexpr std::array<std::array<int, 2>, 8> directions{
      {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};
  float shadow = 0;
  for (const auto& [dx, dy] : directions) {
    const float nearer = grid.depth(x + dx * reach, y + dy * reach) - depth;
    // A slope of one in three to one in one is still a surface; what rises faster is a rim.
    const float steps = nearer / static_cast<float>(reach);
    shadow += std::clamp((steps - 3) / 9, 0.0F, 1.0F);
  }
  return std::round(std::min(1.0F, shadow / 4) * 8) / 8;
}

Color pixel_at(const SampleGrid& grid, int x, int y, const SplatOptions& options) {
  const int n = options.supersampling;
  std::array<int, 3> sum{};
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      const Sample& sample = grid.at(x * n + i, y * n + j);
      Color color = options.background;
      if (sample.depth > nothing_there) {
        const auto darkness = static_cast<float>(options.rim_darkness);
        const float shadow = darkness > 0 ? shadow_at(grid, x * n + i, y * n + j, 2 * n) : 0;
        color = dimmed(sample.color, 1 - 0.45F * std::min(1.0F, darkness * shadow));
      }
      sum[0] += color.red;
      sum[1] += color.green;
      sum[2] += color.blue;
    }
  }
  // Rounded to fours where colours mix: nobody sees it, and the file is a quarter smaller.
  const int count = n * n;
  const auto mean = [count](int total) {
    if (total % count == 0) return static_cast<std::uint8_t>(total / count);
    return static_cast<std::uint8_t>(std::min(255, (total + 2 * count) / (4 * count) * 4));
  };
  return {mean(sum[0]), mean(sum[1]), mean(sum[2])};
}

}  // namespace

Image draw_splats(std::span<const Splat> splats, const SplatOptions& options, Progress& progress) {
  const int n = options.supersampling;
  if (n < 1 || n > 8) throw InvalidArgument(fmt::format("{} samples per pixel; expected 1 to 8", n));
  Image image(options.width, options.height, options.background);
  const std::uint64_t samples = static_cast<std::uint64_t>(options.width) *
                                static_cast<std::uint64_t>(options.height) *
                                static_cast<std::uint64_t>(n * n);
  require_memory(samples * sizeof(Sample),
                 fmt::format("a picture of {} x {} pixels", options.width, options.height));
  SampleGrid grid(options.width * n, options.height * n);
  progress.begin("drawing", splats.size());
  for (std::size_t i = 0; i < splats.size(); ++i) {
    progress.check();
    if (i % 256 == 0) progress.advance(std::min<std::size_t>(256, splats.size() - i));
    const Splat splat = scaled(splats[i], static_cast<float>(n));
    if (is_drawable(splat)) draw(splat, grid);
  }
  for (int y = 0; y < options.height; ++y) {
    progress.check();
    for (int x = 0; x < options.width; ++x) image.at(x, y) = pixel_at(grid, x, y, options);
  }
  return image;
}

}  // namespace keenline
