#include "keenline/lines/arc_length.h"

#include <algorithm>
#include <cmath>

#include "keenline/vectors.h"

namespace keenline {

ArcLength::ArcLength(const Polyline& line) : line_(line), at_vertex_{0} {
  for (std::size_t i = 0; i < segment_count(line); ++i)
    at_vertex_.push_back(at_vertex_.back() + distance(line.vertices[i], segment_end(line, i)));
}

ArcLength::Spot ArcLength::spot(double place) const {
  if (line_.closed && total() > 0) place -= total() * std::floor(place / total());
  place = std::clamp(place, 0.0, total());
  const auto after = std::upper_bound(at_vertex_.begin() + 1, at_vertex_.end() - 1, place);
  const auto segment = static_cast<std::size_t>(after - at_vertex_.begin()) - 1;
  const double length = at_vertex_[segment + 1] - at_vertex_[segment];
  return {segment, length > 0 ? std::min(1.0, (place - at_vertex_[segment]) / length) : 0.0};
}

Point ArcLength::point(double place) const {
  const auto [segment, part] = spot(place);
  const Point& start = line_.vertices[segment];
  return sum(start, scaled(part, difference(segment_end(line_, segment), start)));
}

Point ArcLength::direction(double place, double window) const {
  // On a closed line half of it looks the same both ways.
  const double half = line_.closed ? std::min(0.5 * window, 0.25 * total()) : 0.5 * window;
  const Point along = difference(point(place + half), point(place - half));
  const double size = length(along);
  return size > 0 ? scaled(1 / size, along) : Point{};
}

}  // namespace keenline
