#include "keenline/synth/scan.h"

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "keenline/kernels/portable_math.h"
#include "keenline/synth/parallel.h"

namespace keenline::synth {
namespace {

using kernels::sin_cos;

constexpr double stand_off = 3;                    // station to middle of the shape, in bounding radii
constexpr double half_view = 0.33983690945412193;  // asin(1 / stand_off): the whole bounding sphere
constexpr double line_step = 2;                    // step between lines, in steps along a line

/// Stations look along x of their frame; lines follow y, and z leads from line to line.
std::vector<Frame> place_stations(const Shape& shape, std::uint64_t seed) {
  RandomStream random(seed, Purpose::Stations, 0);
  const Vec3 x = unit(random.normal_vector());
  const Vec3 y = unit(cross(x, random.normal_vector()));
  const std::array axes{x, y, cross(x, y)};

  const Box box = shape.bounds();
  const double away = stand_off * 0.5 * box.diagonal();
  std::vector<Frame> stations;
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double side : {-1.0, 1.0}) {
      const Vec3 outward = side * axes[i];
      stations.push_back(
          {box.center() + away * outward, -1 * outward, axes[(i + 1) % 3], -side * axes[(i + 2) % 3]});
    }
  }
  return stations;
}

/// What every station does: `lines` lines of `points` rays.
struct Raster {
  double step;  // angle between rays of a line
  std::size_t lines;
  std::size_t points;

  explicit Raster(double angle)
      : step(angle),
        lines(static_cast<std::size_t>(std::ceil(2 * half_view / (line_step * angle)))),
        points(static_cast<std::size_t>(std::ceil(2 * half_view / angle))) {}

  [[nodiscard]] Ray ray(const Frame& station, std::size_t line, std::size_t point) const {
    const auto middled = [](std::size_t i, std::size_t count) {
      return static_cast<double>(i) + 0.5 - 0.5 * static_cast<double>(count);
    };
    const auto [sin_up, cos_up] = sin_cos(middled(line, lines) * line_step * step);
    const auto [sin_side, cos_side] = sin_cos(middled(point, points) * step);
    return {station.origin, station.direction({cos_up * cos_side, cos_up * sin_side, sin_up})};
  }
};

std::optional<Sample> first_hit(const Shape& shape, const Ray& ray) {
  double nearest = std::numeric_limits<double>::infinity();
  const Face* hit_face = nullptr;
  for (const auto& face : shape.faces) {
    const double t = face->hit(ray);
    if (t >= nearest) continue;
    nearest = t;
    hit_face = face.get();
  }
  if (hit_face == nullptr) return std::nullopt;
  return Sample{ray.origin + nearest * ray.direction, 0, Sample::On::Face, hit_face->is_curved()};
}

std::size_t count_hits(const Shape& shape, const std::vector<Frame>& stations, const Raster& raster,
                       Progress& progress) {
  std::atomic<std::size_t> hits = 0;
  tbb::parallel_for(std::size_t{0}, stations.size() * raster.lines, [&](std::size_t i) {
    progress.check();
    std::size_t on_line = 0;
    for (std::size_t point = 0; point < raster.points; ++point) {
      const Ray ray = raster.ray(stations[i / raster.lines], i % raster.lines, point);
      if (first_hit(shape, ray)) ++on_line;
    }
    hits += on_line;
  });
  return hits;
}

/// From coarse passes, fine enough to hit something, the raster that will hit about `count` times.
Raster choose_raster(const Shape& shape, const std::vector<Frame>& stations, std::size_t count,
                     Progress& progress) {
  constexpr double enough = 2000;
  double step = half_view / 64;
  for (int pass = 0;; ++pass) {
    const auto hits = static_cast<double>(count_hits(shape, stations, Raster(step), progress));
    if (hits >= enough || pass == 4)
      return Raster(step * std::sqrt(std::max(hits, 1.0) / static_cast<double>(count)));
    step /= 2;
  }
}

}  // namespace

Scan scan(const Shape& shape, std::size_t count, std::uint64_t seed, Progress& progress) {
  const std::vector<Frame> stations = place_stations(shape, seed);
  const Raster raster = choose_raster(shape, stations, count, progress);

  const std::size_t line_count = stations.size() * raster.lines;
  std::vector<std::vector<Sample>> lines(line_count);
  progress.begin("scanning", line_count);
  tbb::parallel_for(std::size_t{0}, line_count, [&](std::size_t i) {
    const std::size_t station = i / raster.lines;
    for (std::size_t point = 0; point < raster.points; ++point) {
      if (point % 1024 == 0) progress.check();
      std::optional<Sample> sample = first_hit(shape, raster.ray(stations[station], i % raster.lines, point));
      if (!sample) continue;
      sample->station = static_cast<std::uint32_t>(station);
      lines[i].push_back(*sample);
    }
    progress.advance(1);
  });

  Scan result;
  for (const Frame& station : stations) result.stations.push_back(station.origin);
  for (std::vector<Sample>& line : lines) {
    result.samples.insert(result.samples.end(), line.begin(), line.end());
    line = {};
  }
  return result;
}

}  // namespace keenline::synth
