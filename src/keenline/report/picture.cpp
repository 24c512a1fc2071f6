#include "keenline/report/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/feature_graph.h"
#include "keenline/io/text.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/order_statistics.h"
#include "keenline/report/legend.h"
#include "keenline/report/splats.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// --- colours
// -------------------------------------------------------------------------------------------------

/// Of attribute values: what the ends of the colour bar stand for.
struct ValueRange {
  double low = 0;
  double high = 0;
};

struct Paint {
  std::vector<Color> colors;  // of every point
  std::vector<Kind> kinds;    // of every point where the paint shows kinds, else empty
  std::vector<LegendEntry> legend;
  std::optional<ValueRange> range;  // of a colour bar
};

constexpr Color plain_color{150, 172, 196};
constexpr Color no_value_color{200, 200, 200};

/// \throw InvalidArgument
const Column& column_to_show(const PointCloud& cloud, const std::string& name) {
  const Column* const column = cloud.attribute(name);
  if (column != nullptr && !column->is_list()) return *column;
  std::string known;
  for (const Column& attribute : cloud.attributes)
    if (!attribute.is_list()) known += (known.empty() ? "" : ", ") + escaped(attribute.name());
  throw InvalidArgument(fmt::format("--color: found {}, expected a numeric attribute of the cloud ({})",
                                    keenline::quoted(name), known.empty() ? "it has none" : known));
}

Kind kind_from(double value, const Column& column) {
  for (const Kind kind : all_kinds)
    if (value == static_cast<double>(kind)) return kind;
  throw InvalidArgument(fmt::format("attribute {}: found {}, expected a kind, 0 to 5 or 255",
                                    keenline::quoted(column.name()), value));
}

Paint paint_kinds(const Column& column) {
  Paint paint;
  paint.kinds.reserve(column.rows());
  for (std::size_t i = 0; i < column.rows(); ++i) paint.kinds.push_back(kind_from(column.value(i), column));
  for (const Kind kind : paint.kinds) paint.colors.push_back(color_of(kind));
  paint.legend = legend_of(paint.kinds);
  return paint;
}

Paint paint_values(const Column& column) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  ValueRange range{infinity, -infinity};
  std::size_t without_value = 0;
  for (std::size_t i = 0; i < column.rows(); ++i) {
    const double value = column.value(i);
    if (!std::isfinite(value)) {
      ++without_value;
      continue;
    }
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  Paint paint;
  // Halves: the difference of two large numbers may leave the range of doubles.
  const double extent = range.high / 2 - range.low / 2;
  for (std::size_t i = 0; i < column.rows(); ++i) {
    const double value = column.value(i);
    if (!std::isfinite(value)) paint.colors.push_back(no_value_color);
    else paint.colors.push_back(color_of_share(extent > 0 ? (value / 2 - range.low / 2) / extent : 0));
  }
  if (without_value > 0) paint.legend = {{no_value_color, "no value " + grouped(without_value)}};
  if (range.low <= range.high) paint.range = range;
  return paint;
}

Paint paint_of(const PointCloud& cloud, const std::string& color, bool with_lines) {
  const bool has_kind = cloud.attribute("kind") != nullptr;
  if (color.empty() && (with_lines || !has_kind)) {
    Paint paint;
    paint.colors.assign(cloud.size(), plain_color);
    paint.legend = {{plain_color, grouped(cloud.size()) + " points"}};
    return paint;
  }
  const Column& column = column_to_show(cloud, color.empty() ? "kind" : color);
  return column.name() == "kind" || column.name() == "truth_kind" ? paint_kinds(column)
                                                                  : paint_values(column);
}

// --- geometry
// -------------------------------------------------------------------------------------------------

/// Coordinates about 1 in size around 0, whatever they were: no difference of them overflows or vanishes.
class Frame {
 public:
  explicit Frame(const PointCloud& cloud) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Point low{infinity, infinity, infinity};
    Point high{-infinity, -infinity, -infinity};
    for (const Point& p : cloud.positions) {
      if (!is_finite(p)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis] / 2);
        high[axis] = std::max(high[axis], p[axis] / 2);
      }
    }
    double extent = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(low[axis] <= high[axis])) continue;  // no finite point
      half_center_[axis] = low[axis] / 2 + high[axis] / 2;
      extent = std::max(extent, high[axis] - half_center_[axis]);
    }
    exponent_ = extent > 0 ? -std::ilogb(extent) : 0;
  }

  [[nodiscard]] Point normalized(const Point& p) const {
    Point result;
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] = std::ldexp(p[axis] / 2 - half_center_[axis], exponent_);
    return result;
  }

 private:
  Point half_center_{};
  int exponent_ = 0;
};

Point in_view(const CameraAxes& axes, const Point& v) {
  return {dot(axes.right, v), dot(axes.up, v), dot(axes.toward, v)};
}

/// Where and how large the cloud appears in `width` x `height` pixels.
struct Placement {
  double scale = 1;
  Point center{};  // in view coordinates
};

Placement placement_of(std::span<const Point> seen, int width, int height) {
  if (seen.empty()) return {};
  Point low = seen.front();
  Point high = seen.front();
  for (const Point& p : seen) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  constexpr double share = 0.92;  // the rest is margin for the discs
  const double across = high[0] - low[0];
  const double down = high[1] - low[1];
  constexpr double most = 1e6;  // of a cloud seen as one point
  Placement placement;
  placement.scale =
      std::min({across > 0 ? share * width / across : most, down > 0 ? share * height / down : most, most});
  for (std::size_t axis = 0; axis < 3; ++axis) placement.center[axis] = (low[axis] + high[axis]) / 2;
  return placement;
}

constexpr int neighbors_for_discs = 12;
/// On a random surface the discs up to the eighth neighbour leave less than a thousandth of it open.
constexpr std::size_t neighbor_at_rim = 8;

struct Disc {
  double radius = 0;  // 0: the point has no neighbours
  Point normal{};     // in view coordinates, towards the viewer; 0 when there are too few neighbours
};

/// \pre offsets are those of the nearest neighbours, in view coordinates, nearest first
Disc disc_of(std::span<const Point> offsets) {
  Disc disc;
  if (offsets.empty()) return disc;
  const Point& rim = offsets[std::min(offsets.size(), neighbor_at_rim) - 1];
  disc.radius = length(rim);
  if (offsets.size() < 3 || disc.radius == 0) return disc;
  Point mean{};
  for (const Point& offset : offsets)
    for (std::size_t axis = 0; axis < 3; ++axis) mean[axis] += offset[axis];
  // The point itself is one of them, at 0.
  for (double& coordinate : mean) coordinate /= static_cast<double>(offsets.size() + 1);
  kernels::Symmetric3 spread;
  const auto add = [&](const Point& offset) {
    const double x = (offset[0] - mean[0]) / disc.radius;
    const double y = (offset[1] - mean[1]) / disc.radius;
    const double z = (offset[2] - mean[2]) / disc.radius;
    spread.xx += x * x;
    spread.xy += x * y;
    spread.xz += x * z;
    spread.yy += y * y;
    spread.yz += y * z;
    spread.zz += z * z;
  };
  add(Point{});
  for (const Point& offset : offsets) add(offset);
  const kernels::Eigen3 eigen = kernels::eigen_decomposition(spread);
  disc.normal = eigen.vectors[2];
  // Where surfaces meet a disc lies in neither of them, and in a cloud without surfaces nowhere: a smaller
  // one stands out less.
  const double thickness = eigen.values[2] / (eigen.values[0] + eigen.values[1] + eigen.values[2]);
  disc.radius *= 1 - 0.4 * std::clamp(thickness / 0.06, 0.0, 1.0) -
                 0.4 * std::clamp((thickness - 0.06) / 0.14, 0.0, 1.0);
  if (disc.normal[2] < 0)
    for (double& coordinate : disc.normal) coordinate = -coordinate;
  return disc;
}

double median_radius(std::span<const Disc> discs) {
  std::vector<double> radii;
  for (const Disc& disc : discs)
    if (disc.radius > 0) radii.push_back(disc.radius);
  return radii.empty() ? 0 : median(radii);
}

/// Appends the lines and corners of the graph as rows of balls. `place` puts a position into the picture.
template <typename Place>
void append_lines(const FeatureGraph& graph, const Place& place, double marker, double lift,
                  std::vector<Splat>& splats) {
  const auto position = [](const Splat& splat) {
    return Point{static_cast<double>(splat.x), static_cast<double>(splat.y),
                 static_cast<double>(splat.depth)};
  };
  const auto append = [&](const Splat& at, double radius, Color color) {
    Splat& splat = splats.emplace_back(at);
    splat.radius = static_cast<float>(radius);
    splat.depth += static_cast<float>(lift);
    splat.color = color;
    splat.is_marker = true;
  };
  // A drawing far larger than the cloud must not become more balls than a picture can hold.
  constexpr double most_balls = 1e6;
  double total = 0;
  for (const Polyline& line : graph.polylines)
    for (std::size_t i = 0; i < segment_count(line); ++i)
      total += distance(position(place(line.vertices[i])), position(place(segment_end(line, i))));
  if (!std::isfinite(total)) return;
  const double step_length = std::max(0.5 * marker, total / most_balls);
  for (const Polyline& line : graph.polylines) {
    const Color color = color_of(line.kind == LineKind::Border ? Kind::Border : Kind::Edge);
    for (std::size_t i = 0; i < segment_count(line); ++i) {
      const Splat from = place(line.vertices[i]);
      const Splat to = place(segment_end(line, i));
      const int steps = static_cast<int>(std::ceil(distance(position(from), position(to)) / step_length));
      for (int step = 0; step <= steps; ++step) {
        const float share = steps > 0 ? static_cast<float>(step) / static_cast<float>(steps) : 0.0F;
        Splat at;
        at.x = from.x + share * (to.x - from.x);
        at.y = from.y + share * (to.y - from.y);
        at.depth = from.depth + share * (to.depth - from.depth);
        append(at, 0.6 * marker, color);
      }
    }
  }
  for (const GraphCorner& corner : graph.corners)
    append(place(corner.position), 1.3 * marker, color_of(Kind::Corner));
}

/// All finite points in the order of the cloud, as they are to be drawn in width x height pixels.
std::vector<Splat> splats_of(const PointCloud& cloud, const Paint& paint, const Camera& camera,
                             const FeatureGraph* lines, int width, int height, Progress& progress) {
  const CameraAxes axes = axes_of(camera);
  const Frame frame(cloud);
  const auto view = [&](std::size_t i) { return in_view(axes, frame.normalized(cloud.positions[i])); };
  std::vector<std::size_t> points;
  std::vector<Point> seen;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!is_finite(cloud.positions[i])) continue;
    points.push_back(i);
    seen.push_back(view(i));
  }
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, neighbors_for_discs, progress);
  std::vector<Disc> discs;
  std::vector<Point> offsets;
  discs.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k % 1024 == 0) progress.check();
    offsets.clear();
    for (const std::uint32_t q : neighborhoods.of(points[k])) {
      const Point there = view(q);
      offsets.push_back({there[0] - seen[k][0], there[1] - seen[k][1], there[2] - seen[k][2]});
    }
    discs.push_back(disc_of(offsets));
  }

  const Placement placement = placement_of(seen, width, height);
  const double side = std::min(width, height);
  // Neither a stray point nor a handful of points may cover the picture.
  const double median = median_radius(discs) * placement.scale;
  const double largest = median > 0 ? std::min(3 * median, 0.06 * side) : 0.015 * side;
  const double marker = std::clamp(0.5 * median, 0.004 * side, 0.011 * side);
  const auto place = [&](const Point& in_view) {
    Splat splat;
    splat.x = static_cast<float>(width / 2.0 + (in_view[0] - placement.center[0]) * placement.scale);
    splat.y = static_cast<float>(height / 2.0 - (in_view[1] - placement.center[1]) * placement.scale);
    splat.depth = static_cast<float>((in_view[2] - placement.center[2]) * placement.scale);
    return splat;
  };
  std::vector<Splat> splats;
  splats.reserve(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    Splat& splat = splats.emplace_back(place(seen[k]));
    const double radius = discs[k].radius * placement.scale;
    splat.radius = static_cast<float>(std::clamp(radius > 0 ? radius : largest, 0.7, std::max(0.7, largest)));
    for (std::size_t axis = 0; axis < 3; ++axis)
      splat.normal[axis] = static_cast<float>(discs[k].normal[axis]);
    splat.color = paint.colors[points[k]];
    if (paint.kinds.empty()) continue;
    const Kind kind = paint.kinds[points[k]];
    if (!is_feature(kind) && kind != Kind::Border) continue;
    splat.is_marker = true;
    splat.depth += splat.radius;  // the discs around it do not bury it
    splat.radius = static_cast<float>(kind == Kind::Corner || kind == Kind::Peak ? 1.15 * marker : marker);
  }
  if (lines != nullptr) {
    // The discs of the surface do not bury them.
    const double lift = std::min(largest, 1.5 * median) + marker;
    append_lines(
        *lines, [&](const Point& p) { return place(in_view(axes, frame.normalized(p))); }, marker, lift,
        splats);
  }
  return splats;
}

std::vector<LegendEntry> legend_of_lines(const FeatureGraph& graph) {
  const auto borders = static_cast<std::size_t>(
      std::count_if(graph.polylines.begin(), graph.polylines.end(),
                    [](const Polyline& line) { return line.kind == LineKind::Border; }));
  std::vector<LegendEntry> legend{
      {color_of(Kind::Edge), grouped(graph.polylines.size() - borders) + " creases"}};
  if (borders > 0) legend.push_back({color_of(Kind::Border), grouped(borders) + " borders"});
  legend.push_back({color_of(Kind::Corner), grouped(graph.corners.size()) + " corners"});
  return legend;
}

}  // namespace

Image draw_cloud(const PointCloud& cloud, const PictureOptions& options, Progress& progress) {
  constexpr int smallest_side = 64;
  constexpr int largest_side = 8192;
  if (std::min(options.width, options.height) < smallest_side ||
      std::max(options.width, options.height) > largest_side) {
    throw InvalidArgument(fmt::format("--size: found {},{}, expected {} to {} pixels each", options.width,
                                      options.height, smallest_side, largest_side));
  }
  Paint paint = paint_of(cloud, options.color, options.lines != nullptr);
  if (options.lines != nullptr)
    for (LegendEntry& entry : legend_of_lines(*options.lines)) paint.legend.push_back(std::move(entry));
  const double line = 12 * dot_for(options.width);
  const int bar = paint.range ? static_cast<int>(1.4 * line) : 0;
  const int above = caption_height(options.caption, options.width);
  const int legend = legend_height(paint.legend, options.width);
  SplatOptions splat_options;
  splat_options.width = options.width;
  splat_options.height = std::max(smallest_side / 4, options.height - above - legend - bar);
  const std::vector<Splat> splats = splats_of(cloud, paint, options.camera, options.lines,
                                              splat_options.width, splat_options.height, progress);

  Image image(options.width, options.height);
  paste(image, draw_splats(splats, splat_options, progress), 0, above);
  draw_caption(image, options.caption);
  if (paint.range) {
    draw_color_bar(image, options.height - legend - bar, options.color,
                   fmt::format("{:.4g}", paint.range->low), fmt::format("{:.4g}", paint.range->high));
  }
  draw_legend(image, options.height - legend, paint.legend);
  return image;
}

}  // namespace keenline
