#include "keenline/report/gauss_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "keenline/detect/gauss.h"
#include "keenline/errors.h"
#include "keenline/report/legend.h"
#include "keenline/report/lettering.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr Color insignificant_color{150, 150, 150};
constexpr Color circle_color{120, 128, 138};

Color color_of_cluster(int cluster) { return cluster < 0 ? insignificant_color : color_of_number(cluster); }

std::vector<LegendEntry> legend_of(const PointGaussMap& map) {
  const auto lines = [](int count) { return fmt::format("{} line{}", count, count == 1 ? "" : "s"); };
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < map.sizes.size(); ++i)
    entries.push_back({color_of_number(static_cast<int>(i)), lines(map.sizes[i])});
  const auto others = static_cast<int>(std::count(map.cluster.begin(), map.cluster.end(), -1));
  if (others > 0 || entries.empty())
    entries.push_back({insignificant_color, lines(others) + " in small clusters"});
  return entries;
}

class Sphere {
 public:
  Sphere(Image& image, const Camera& camera, double x, double y, double radius)
      : image_(image), axes_(axes_of(camera)), x_(x), y_(y), radius_(radius) {}

  /// White where it faces the light, greyer to the rim.
  void draw_ball() {
    constexpr Color bright{250, 251, 252};
    constexpr Color dark{216, 221, 227};
    draw_disc(image_, x_, y_, radius_, dark);
    for (int y = 0; y < image_.height(); ++y) {
      for (int x = 0; x < image_.width(); ++x) {
        const double u = (x + 0.5 - x_) / radius_;
        const double v = (y_ - y - 0.5) / radius_;
        const double squared = u * u + v * v;
        if (squared > 1) continue;
        const double light = -0.35 * u + 0.45 * v + 0.82 * std::sqrt(1 - squared);
        image_.at(x, y) = mixed(dark, bright, std::max(0.0, light));
      }
    }
    draw_circle(axes_.right, axes_.up, 1);
  }

  /// The circles of the three coordinate planes, on one half of the sphere.
  void draw_planes(bool front) {
    constexpr Point x{1, 0, 0};
    constexpr Point y{0, 1, 0};
    constexpr Point z{0, 0, 1};
    const double opacity = front ? 0.55 : 0.16;
    draw_half_circle(x, y, opacity, front);
    draw_half_circle(y, z, opacity, front);
    draw_half_circle(z, x, opacity, front);
  }

  /// Names at the ends of the coordinate axes that face the viewer.
  void draw_names(double pixel) {
    constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        Point end{};
        end[axis] = sign;
        if (dot(axes_.toward, end) < 0.05) continue;
        const auto [x, y] = place(end);
        const std::string name = fmt::format("{}{}", sign > 0 ? "+" : "-", names[axis]);
        // Clear of the dots, which gather where faces are parallel to the coordinate planes.
        const double away = radius_ / 9 / std::max(1.0, std::hypot(x - x_, y - y_));
        const double left = x + (x - x_) * away - text_width(name, pixel) / 2;
        draw_text(image_, left, y + (y - y_) * away - 3.5 * pixel, name, pixel, circle_color);
      }
    }
  }

  /// Every line is seen at both its ends; one of them faces the viewer.
  void draw_lines(const PointGaussMap& map, bool front, double size) {
    // Dots that would cover each other within a pixel are one larger dot.
    std::map<std::tuple<int, int, int>, int> counts;
    for (std::size_t i = 0; i < map.lines.size(); ++i) {
      Point direction{};
      for (std::size_t axis = 0; axis < 3; ++axis) direction[axis] = static_cast<double>(map.lines[i][axis]);
      const bool faces_viewer = dot(axes_.toward, direction) >= 0;
      if (faces_viewer != front)
        for (double& coordinate : direction) coordinate = -coordinate;
      const auto [x, y] = place(direction);
      ++counts[{map.cluster[i], static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))}];
    }
    // Thin white rims set clusters off from each other, not the dots of one.
    const int clusters = static_cast<int>(map.sizes.size());
    for (int shown = -1; shown < clusters; ++shown) {
      for (const bool rim : {true, false}) {
        for (const auto& [key, count] : counts) {
          const auto& [cluster, x, y] = key;
          if (cluster != shown) continue;
          const double radius = size * (1 + 0.35 * std::log2(count)) * (front ? 1 : 0.8);
          if (!rim) draw_disc(image_, x, y, radius, color_of_cluster(cluster), front ? 1 : 0.28);
          else if (front) draw_disc(image_, x, y, radius + 0.25 * size, white, 0.85);
        }
      }
    }
  }

 private:
  struct Place {
    double x;
    double y;
  };
  [[nodiscard]] Place place(const Point& direction) const {
    return {x_ + radius_ * dot(axes_.right, direction), y_ - radius_ * dot(axes_.up, direction)};
  }

  static constexpr int steps = 180;
  static Point on_circle(const Point& a, const Point& b, int step) {
    const double angle = 2 * std::numbers::pi * step / steps;
    Point p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = std::cos(angle) * a[axis] + std::sin(angle) * b[axis];
    return p;
  }

  void draw_circle(const Point& a, const Point& b, double opacity) {
    for (int step = 0; step < steps; ++step) draw_arc(a, b, step, opacity);
  }
  void draw_half_circle(const Point& a, const Point& b, double opacity, bool front) {
    for (int step = 0; step < steps; ++step)
      if ((dot(axes_.toward, on_circle(a, b, step)) >= 0) == front) draw_arc(a, b, step, opacity);
  }
  void draw_arc(const Point& a, const Point& b, int step, double opacity) {
    const Place from = place(on_circle(a, b, step));
    const Place to = place(on_circle(a, b, step + 1));
    draw_line(image_, from.x, from.y, to.x, to.y, radius_ / 160, circle_color, opacity);
  }

  Image& image_;
  CameraAxes axes_;
  double x_;
  double y_;
  double radius_;
};

}  // namespace

Image draw_gauss_sphere(const PointGaussMap& map, const GaussSphereOptions& options) {
  constexpr int smallest_side = 64;
  constexpr int largest_side = 8192;
  if (std::min(options.width, options.height) < smallest_side ||
      std::max(options.width, options.height) > largest_side) {
    throw InvalidArgument(fmt::format("--size: found {},{}, expected {} to {} pixels each", options.width,
                                      options.height, smallest_side, largest_side));
  }
  const std::vector<LegendEntry> entries = legend_of(map);
  const int above = caption_height(options.caption, options.width);
  const int legend = legend_height(entries, options.width);
  const double room = std::max(smallest_side / 4, options.height - above - legend);
  const double radius = 0.44 * std::min(static_cast<double>(options.width), room);

  Image image(options.width, options.height);
  Sphere sphere(image, options.camera, options.width / 2.0, above + room / 2, radius);
  const double dot_size = radius / 46;
  sphere.draw_ball();
  sphere.draw_planes(false);
  sphere.draw_lines(map, false, dot_size);
  sphere.draw_planes(true);
  sphere.draw_names(dot_for(options.width));
  sphere.draw_lines(map, true, dot_size);
  draw_caption(image, options.caption);
  draw_legend(image, options.height - legend, entries);
  return image;
}

}  // namespace keenline
