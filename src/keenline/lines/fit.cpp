#include "keenline/lines/fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/lines/fit_arc.h"
#include "keenline/lines/fit_spline.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

/// A curve and the points of it that stand for the vertices.
struct Candidate {
  FittedCurve curve;
  std::vector<Point> vertices;
};

bool is_within(const std::vector<Point>& moved, const std::vector<Point>& vertices, double tolerance) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!(distance(moved[i], vertices[i]) <= tolerance)) return false;
  return true;
}

Candidate straight(const Polyline& line) {
  const FittedLine chord{line.vertices.front(), line.vertices.back()};
  Candidate candidate{chord, {}};
  const Point along = difference(chord.end, chord.start);
  const double squared = dot(along, along);
  for (const Point& p : line.vertices) {
    const double part =
        squared > 0 ? std::clamp(dot(difference(p, chord.start), along) / squared, 0.0, 1.0) : 0.0;
    candidate.vertices.push_back(sum(chord.start, scaled(part, along)));
  }
  return candidate;
}

std::optional<Candidate> circular(const Polyline& line) {
  const std::optional<FittedArc> arc = fit_arc(line.vertices, line.closed);
  if (!arc) return std::nullopt;
  Candidate candidate{*arc, {}};
  for (const Point& p : line.vertices) candidate.vertices.push_back(nearest_on(*arc, p));
  return candidate;
}

std::optional<Candidate> winding(const Polyline& line, std::size_t controls) {
  std::optional<SplineFit> fit = fit_spline(line.vertices, line.closed, controls);
  if (!fit) return std::nullopt;
  Candidate candidate{{}, {}};
  for (const double parameter : fit->parameters)
    candidate.vertices.push_back(point_on(fit->spline, parameter));
  candidate.curve = std::move(fit->spline);
  return candidate;
}

/// The spline of the fewest control points: tried in growing steps, then one by one from the last that
/// failed.
std::optional<Candidate> fewest_controls(const Polyline& line, double tolerance, const Progress& progress) {
  // Round a closed line every control depends on all others: their number cubed is what a fit costs.
  constexpr std::size_t most_closed = 400;
  const std::size_t most =
      line.closed ? std::min(line.vertices.size() + 1, most_closed) : line.vertices.size();
  const auto within = [&](std::size_t controls) -> std::optional<Candidate> {
    progress.check();
    std::optional<Candidate> candidate = winding(line, controls);
    if (!candidate || !is_within(candidate->vertices, line.vertices, tolerance)) return std::nullopt;
    return candidate;
  };
  const std::size_t least = line.closed ? 5 : 4;  // a closed one of four would be a line there and back
  std::size_t failed = least - 1;
  for (std::size_t controls = least; failed < most; controls += 1 + controls / 4) {
    controls = std::min(controls, most);
    std::optional<Candidate> found = within(controls);
    if (!found) {
      failed = controls;
      continue;
    }
    for (std::size_t fewer = failed + 1; fewer < controls; ++fewer)
      if (std::optional<Candidate> candidate = within(fewer)) return candidate;
    return found;
  }
  return std::nullopt;
}

std::optional<Candidate> simplest(const Polyline& line, double tolerance, const Progress& progress) {
  if (!line.closed) {
    const Candidate candidate = straight(line);
    if (is_within(candidate.vertices, line.vertices, tolerance)) return candidate;
  }
  if (!line.closed || !line.start_corner) {
    std::optional<Candidate> candidate = circular(line);
    if (candidate && is_within(candidate->vertices, line.vertices, tolerance)) return candidate;
  }
  return fewest_controls(line, tolerance, progress);
}

void fit(Polyline& line, double tolerance, const Progress& progress) {
  line.fitted = {};
  std::optional<Candidate> candidate = simplest(line, tolerance, progress);
  if (!candidate) return;
  line.fitted = std::move(candidate->curve);
  const bool has_ends = !line.closed || line.start_corner;
  if (has_ends) candidate->vertices.front() = line.vertices.front();  // to the bit
  if (!line.closed) candidate->vertices.back() = line.vertices.back();
  line.vertices = std::move(candidate->vertices);
}

}  // namespace

FeatureGraph fit_lines(const FeatureGraph& graph, double tolerance, Progress& progress) {
  validate(graph);
  if (!(tolerance >= 0 && std::isfinite(tolerance)))
    throw InvalidArgument(fmt::format("tolerance: found {}, expected a number from 0", tolerance));
  FeatureGraph result = graph;
  progress.begin("fitting curves", graph.polylines.size());
  tbb::parallel_for(std::size_t{0}, result.polylines.size(), [&](std::size_t i) {
    progress.check();
    fit(result.polylines[i], tolerance, progress);
    progress.advance(1);
  });
  return result;
}

}  // namespace keenline
