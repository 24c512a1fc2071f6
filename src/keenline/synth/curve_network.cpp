#include "keenline/synth/curve_network.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::radians;

// Ends that were computed in two ways differ by rounding only.
constexpr double same_place = 1e-9;

bool is_among(std::span<const Vec3> points, const Vec3& p) {
  return std::any_of(points.begin(), points.end(),
                     [&](const Vec3& q) { return distance(p, q) < same_place; });
}

/// A curve as seen from one of its ends.
struct Departure {
  const Curve* curve;
  bool backwards;

  [[nodiscard]] const Vec3& start() const { return backwards ? curve->end() : curve->start(); }
  [[nodiscard]] const Vec3& end() const { return backwards ? curve->start() : curve->end(); }
  [[nodiscard]] Vec3 direction() const {
    return backwards ? -1 * curve->end_direction() : curve->start_direction();
  }
};

std::vector<Departure> departures_from(std::span<const Curve> curves, const Vec3& node) {
  std::vector<Departure> departures;
  for (const Curve& curve : curves) {
    if (curve.is_circle()) continue;
    for (const bool backwards : {false, true}) {
      const Departure way{&curve, backwards};
      if (distance(way.start(), node) < same_place) departures.push_back(way);
    }
  }
  return departures;
}

/// Appends the curve's vertices without its last.
void append_vertices(const Departure& way, double step, std::vector<Point>& vertices) {
  const Curve& curve = *way.curve;
  const double steps = std::max(curve.length() / step, 2 * curve.half_angle() / radians(5));
  const std::size_t parts = curve.is_straight() ? 1 : static_cast<std::size_t>(std::ceil(steps));
  for (std::size_t i = 0; i < parts; ++i) {
    const auto numerator = static_cast<double>(way.backwards ? parts - i : i);
    vertices.push_back(curve.at(numerator / static_cast<double>(parts)).point());
  }
}

class Chaining {
 public:
  Chaining(std::span<const Curve> curves, std::span<const Vec3> stops, double step)
      : curves_(curves), stops_(stops), step_(step), used_(curves.size(), false) {}

  std::vector<TruthCurve> run() {
    for (const Vec3& node : ends_of(curves_)) {
      const auto departures = departures_from(curves_, node);
      if (departures.size() == 2 && !is_among(stops_, node)) continue;
      for (const Departure& way : departures) follow(way);
    }
    // What is left has no end to start from: whole circles and smooth closed chains.
    for (const Curve& curve : curves_) follow({&curve, false});
    return std::move(polylines_);
  }

 private:
  void follow(Departure way) {
    if (is_used(way)) return;
    TruthCurve polyline;
    const Vec3 origin = way.start();
    for (;;) {
      used_[number_of(way)] = true;
      append_vertices(way, step_, polyline.vertices);
      const auto onward = departures_from(curves_, way.end());
      const auto next =
          std::find_if(onward.begin(), onward.end(), [&](const Departure& d) { return !is_used(d); });
      if (next == onward.end() || onward.size() != 2 || is_among(stops_, way.end())) break;
      way = *next;
    }
    polyline.closed = distance(way.end(), origin) < same_place;
    if (!polyline.closed) polyline.vertices.push_back(way.end().point());
    polylines_.push_back(std::move(polyline));
  }

  [[nodiscard]] std::size_t number_of(const Departure& way) const {
    return static_cast<std::size_t>(way.curve - curves_.data());
  }
  [[nodiscard]] bool is_used(const Departure& way) const { return used_[number_of(way)]; }

  std::span<const Curve> curves_;
  std::span<const Vec3> stops_;
  double step_;
  std::vector<bool> used_;
  std::vector<TruthCurve> polylines_;
};

}  // namespace

std::vector<Vec3> ends_of(std::span<const Curve> curves) {
  std::vector<Vec3> ends;
  for (const Curve& curve : curves) {
    if (curve.is_circle()) continue;
    for (const Vec3& end : {curve.start(), curve.end()})
      if (!is_among(ends, end)) ends.push_back(end);
  }
  return ends;
}

std::vector<Vec3> corners_of(std::span<const Curve> edges) {
  std::vector<Vec3> corners;
  for (const Vec3& node : ends_of(edges)) {
    const auto departures = departures_from(edges, node);
    const bool turns =
        departures.size() == 2 && length(departures[0].direction() + departures[1].direction()) > same_place;
    if (departures.size() > 2 || turns) corners.push_back(node);
  }
  return corners;
}

std::vector<TruthCurve> polylines_of(std::span<const Curve> curves, std::span<const Vec3> stops,
                                     double step) {
  return Chaining(curves, stops, step).run();
}

}  // namespace keenline::synth
