#include "keenline/lines/rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr double piece = 1.6;
constexpr std::size_t pieces = 5;
constexpr double largest_gap = 1;  // between the outermost points; beyond, the second is no neighbour

struct Outermost {
  double first = std::numeric_limits<double>::infinity();
  double second = std::numeric_limits<double>::infinity();

  void include(double x) {
    second = std::min(second, std::max(first, x));
    first = std::min(first, x);
  }
  [[nodiscard]] bool is_known() const { return second < std::numeric_limits<double>::infinity(); }
  [[nodiscard]] double end() const { return first - std::min(second - first, largest_gap); }
};

}  // namespace

std::optional<Side> rim_of(const Side& side, std::span<const Point> offsets) {
  const SideSurface& surface = side.surface;
  const double tolerance = std::max(0.3, 3 * side.residual / surface.spacing);
  std::array<Outermost, pieces> outermost;
  for (const Point& q : offsets) {
    const double at = std::floor(dot(q, surface.y) / piece + 0.5 * static_cast<double>(pieces));
    if (!(at >= 0 && at < static_cast<double>(pieces)) || std::abs(surface.distance(q)) > tolerance) continue;
    outermost[static_cast<std::size_t>(at)].include(dot(q, surface.x));
  }
  // Pieces are counted from the middle one: the sum of y is small, that of 1 is how many are known.
  double count = 0, sum_y = 0, sum_yy = 0, sum_x = 0, sum_xy = 0;
  for (std::size_t i = 0; i < pieces; ++i) {
    if (!outermost[i].is_known()) continue;
    const double y = piece * (static_cast<double>(i) - 0.5 * static_cast<double>(pieces - 1));
    const double x = outermost[i].end();
    count += 1;
    sum_y += y;
    sum_yy += y * y;
    sum_x += x;
    sum_xy += x * y;
  }
  if (count < 3) return std::nullopt;
  const double determinant = count * sum_yy - sum_y * sum_y;
  const double slope = (count * sum_xy - sum_x * sum_y) / determinant;
  const double level = (sum_x - slope * sum_y) / count;

  Side rim = side;
  rim.surface.z = scaled(-1, surface.x);
  rim.surface.x = surface.z;
  rim.inward = scaled(-1, surface.z);
  rim.surface.height = {-level, 0, -slope, 0, 0, 0};
  return rim;
}

}  // namespace keenline
