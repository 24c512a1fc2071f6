#include "keenline/lines/fit_spline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "keenline/lines/band_least_squares.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr int corrections = 3;

/// Number of the stretch between knots that a parameter lies in; it is longer than 0.
std::size_t stretch_of(const std::vector<double>& knots, double parameter) {
  const auto after = std::upper_bound(knots.begin() + 4, knots.end() - 4, parameter);
  return static_cast<std::size_t>(after - knots.begin()) - 1;
}

/// The degree + 1 B-splines that are not 0 on a stretch (Piegl and Tiller 1997, algorithm A2.2).
std::array<double, 4> basis_on(std::size_t stretch, const std::vector<double>& knots, double parameter,
                               std::size_t degree) {
  std::array<double, 4> values{1, 0, 0, 0};
  for (std::size_t j = 1; j <= degree; ++j) {
    double carried = 0;
    for (std::size_t r = 0; r < j; ++r) {
      const double right = knots[stretch + r + 1] - parameter;
      const double left = parameter - knots[stretch + 1 + r - j];
      const double part = values[r] / (right + left);
      values[r] = carried + right * part;
      carried = left * part;
    }
    values[j] = carried;
  }
  return values;
}

struct Basis {
  std::size_t first;  // control point of the first of the four
  std::array<double, 4> values;
};

Basis basis_at(const std::vector<double>& knots, double parameter) {
  const std::size_t stretch = stretch_of(knots, parameter);
  return {stretch - 3, basis_on(stretch, knots, parameter, 3)};
}

/// By the differences of the control points (Piegl and Tiller 1997, 3.7).
Point derivative(const FittedSpline& spline, double parameter) {
  const std::vector<double>& knots = spline.knots;
  const std::size_t stretch = stretch_of(knots, parameter);
  const std::array<double, 4> values = basis_on(stretch, knots, parameter, 2);
  Point derivative{};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = stretch - 3 + k;
    const Point step = difference(spline.control_points[i + 1], spline.control_points[i]);
    derivative = sum(derivative, scaled(values[k] * 3 / (knots[i + 4] - knots[i + 1]), step));
  }
  return derivative;
}

/// Four at either end, those between so that parameters lie in every stretch that a B-spline is not 0 in.
std::vector<double> knots_for(const std::vector<double>& parameters, std::size_t controls) {
  std::vector<double> knots(4, parameters.front());
  const std::size_t stretches = controls - 3;
  const double step = static_cast<double>(parameters.size()) / static_cast<double>(stretches);
  for (std::size_t j = 1; j < stretches; ++j) {
    const double at = static_cast<double>(j) * step;
    const auto i = static_cast<std::size_t>(at);
    const double part = at - static_cast<double>(i);
    knots.push_back((1 - part) * parameters[i - 1] + part * parameters[i]);
  }
  knots.insert(knots.end(), 4, parameters.back());
  return knots;
}

/// Ends fixed; offsets from the first point.
std::optional<std::vector<Point>> open_controls(const std::vector<Point>& offsets,
                                                const std::vector<double>& parameters,
                                                const std::vector<double>& knots) {
  const std::size_t controls = knots.size() - 4;
  BandLeastSquares equations(controls - 2, std::min<std::size_t>(4, controls - 2));
  for (std::size_t p = 1; p + 1 < offsets.size(); ++p) {
    const Basis basis = basis_at(knots, parameters[p]);
    std::array<double, 4> factors{};
    std::size_t count = 0;
    std::size_t first = 0;
    Point value = offsets[p];
    for (std::size_t k = 0; k < 4; ++k) {
      const std::size_t control = basis.first + k;
      if (control == 0) continue;  // at offset 0
      if (control == controls - 1) {
        value = difference(value, scaled(basis.values[k], offsets.back()));
        continue;
      }
      if (count == 0) first = control - 1;
      factors[count++] = basis.values[k];
    }
    equations.add(first, std::span(factors).first(count), value);
  }
  std::optional<std::vector<Point>> inner = std::move(equations).solve();
  if (!inner) return std::nullopt;
  inner->insert(inner->begin(), Point{});
  inner->push_back(offsets.back());
  return inner;
}

/// The last control point is the first, and the line through the two beside it goes through it.
std::optional<std::vector<Point>> closed_controls(const std::vector<Point>& offsets,
                                                  const std::vector<double>& parameters,
                                                  const std::vector<double>& knots) {
  const std::size_t unknowns = knots.size() - 5;
  BandLeastSquares equations(unknowns, unknowns);
  std::vector<double> factors(unknowns, 0.0);
  for (std::size_t p = 0; p + 1 < offsets.size(); ++p) {
    const Basis basis = basis_at(knots, parameters[p]);
    std::fill(factors.begin(), factors.end(), 0.0);
    for (std::size_t k = 0; k < 4; ++k) factors[(basis.first + k) % unknowns] += basis.values[k];
    equations.add(0, factors, offsets[p]);
  }
  // Equal derivatives at both ends, as good as exactly.
  const double after = knots[4] - knots[3];
  const double before = knots[knots.size() - 4] - knots[knots.size() - 5];
  std::fill(factors.begin(), factors.end(), 0.0);
  factors[1] += before;
  factors[unknowns - 1] += after;
  factors[0] -= before + after;
  constexpr double much = 1e6;
  equations.add(0, factors, {},
                much * static_cast<double>(offsets.size()) / (before * before + after * after));
  std::optional<std::vector<Point>> controls = std::move(equations).solve();
  if (controls) controls->push_back(controls->front());
  return controls;
}

/// Arc length, from 0 to 1; rising strictly, even where points coincide.
std::vector<double> chord_parameters(const std::vector<Point>& offsets) {
  double total = 0;
  for (std::size_t i = 1; i < offsets.size(); ++i) total += distance(offsets[i - 1], offsets[i]);
  const double least = 1e-6 * total / static_cast<double>(offsets.size());
  std::vector<double> parameters{0};
  for (std::size_t i = 1; i < offsets.size(); ++i)
    parameters.push_back(parameters.back() + std::max(least, distance(offsets[i - 1], offsets[i])));
  for (double& parameter : parameters) parameter /= std::max(parameters.back(), total);
  return parameters;
}

/// Each a step of Newton's nearer to where the curve is nearest to its point; still rising.
void correct(std::vector<double>& parameters, const FittedSpline& spline, const std::vector<Point>& offsets) {
  for (std::size_t p = 1; p + 1 < parameters.size(); ++p) {
    const Point along = derivative(spline, parameters[p]);
    const double squared = dot(along, along);
    const double gap = std::min(parameters[p] - parameters[p - 1], parameters[p + 1] - parameters[p]);
    if (!(squared > 0)) continue;
    const double step = dot(difference(offsets[p], point_on(spline, parameters[p])), along) / squared;
    parameters[p] += std::clamp(step, -0.4 * gap, 0.4 * gap);
  }
}

}  // namespace

Point point_on(const FittedSpline& spline, double parameter) {
  const Basis basis = basis_at(spline.knots, parameter);
  Point point{};
  for (std::size_t k = 0; k < 4; ++k)
    point = sum(point, scaled(basis.values[k], spline.control_points[basis.first + k]));
  return point;
}

std::optional<SplineFit> fit_spline(std::span<const Point> points, bool closed, std::size_t controls) {
  std::vector<Point> offsets;
  for (const Point& p : points) offsets.push_back(difference(p, points.front()));
  if (closed) offsets.push_back({});
  if (std::all_of(offsets.begin(), offsets.end(), [](const Point& p) { return dot(p, p) == 0; }))
    return std::nullopt;
  SplineFit fit;
  fit.parameters = chord_parameters(offsets);
  for (int round = 0; round <= corrections; ++round) {
    if (round > 0) correct(fit.parameters, fit.spline, offsets);
    fit.spline.knots = knots_for(fit.parameters, controls);
    auto found = closed ? closed_controls(offsets, fit.parameters, fit.spline.knots)
                        : open_controls(offsets, fit.parameters, fit.spline.knots);
    if (!found) return std::nullopt;
    fit.spline.control_points = std::move(*found);
  }
  for (Point& control : fit.spline.control_points) control = sum(points.front(), control);
  if (!closed) fit.spline.control_points.back() = points.back();  // to the bit
  if (closed) fit.parameters.pop_back();
  return fit;
}

}  // namespace keenline
