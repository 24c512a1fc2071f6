#include "keenline/lines/wedge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/lines/least_squares.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths in units of the view: the spacing of the points around, and more where they are noisy.
constexpr std::size_t hypotheses = 24;  // from the points nearest to the middle
constexpr double smallest_sine = 0.17;  // planes within 10 degrees are one
constexpr double near_crease = 1;       // planes of a candidate's crease pass so near to it
constexpr double largest_shift = 1.5;   // from where a crease was expected
constexpr double side_overlap = 0.5;    // by so much noise may carry points past the crease
constexpr int least_points = 4;         // that fix a plane

struct Plane {
  Point normal{};
  double offset = 0;  // normal . x = offset
};

double height(const Plane& plane, const Point& p) { return dot(plane.normal, p) - plane.offset; }

/// The points around a place, as seen from there.
struct Window {
  const WedgeView& view;
  std::vector<std::uint32_t> points;
  std::vector<Point> offsets;  // of the points
  double scale = 1;            // unit of the view in spacings of the cloud
};

/// About a place in the frame. Fewer points than the view asks for are no window.
std::optional<Window> window_at(const Point& place, const PointCloud& cloud, const NeighborSearch& search,
                                const TraceFrame& frame, const WedgeView& view) {
  const Point middle = frame.global(place);
  Window window{view, search.nearest_to(middle, view.points), {}, 1};
  if (window.points.size() < static_cast<std::size_t>(view.points)) return std::nullopt;
  const double radius = distance(cloud.positions[window.points.back()], middle);
  const double scale = view.unit * radius * std::sqrt(kernels::pi / (view.points - 0.5));
  if (!(scale > 0)) return std::nullopt;
  window.offsets.reserve(window.points.size());
  for (const std::uint32_t q : window.points)
    window.offsets.push_back(scaled(1 / scale, difference(cloud.positions[q], middle)));
  window.scale = scale / frame.spacing;
  return window;
}

/// Weighted sums of points, for planes.
struct PlaneSums {
  double weight = 0;
  int count = 0;
  Point first{};  // sum of w p
  kernels::Symmetric3 second;

  void add(const Point& p, double w) {
    weight += w;
    ++count;
    first = sum(first, scaled(w, p));
    add_square(second, p, w);
  }

  /// None where the points lie on one line.
  [[nodiscard]] std::optional<Plane> plane() const {
    if (count < least_points || !(weight > 0)) return std::nullopt;
    const Point mean = scaled(1 / weight, first);
    kernels::Symmetric3 scatter = second;
    add_square(scatter, mean, -weight);
    const kernels::Eigen3 eigen = kernels::eigen_decomposition(scatter);
    constexpr double thinnest = 0.01;  // squared: a strip ten times as long as wide
    if (!(eigen.values[1] > thinnest * eigen.values[0])) return std::nullopt;
    const Point& normal = eigen.vectors[2];
    return Plane{normal, dot(normal, mean)};
  }
};

/// What a plane explains of a point: 1 on it, falling to 0 at the tolerance.
double explained(double height, double tolerance) {
  return std::max(0.0, 1 - height * height / (tolerance * tolerance));
}

/// The plane of a point of the window and its nearest there. `order` is room to work in.
std::optional<Plane> plane_at(const Window& window, std::size_t i,
                              std::vector<std::pair<double, std::size_t>>& order) {
  order.resize(window.offsets.size());
  for (std::size_t j = 0; j < window.offsets.size(); ++j) {
    const Point d = difference(window.offsets[j], window.offsets[i]);
    order[j] = {dot(d, d), j};
  }
  const int size = window.view.points_of_hypothesis;
  std::nth_element(order.begin(), order.begin() + size - 1, order.end());
  std::sort(order.begin(), order.begin() + size);
  PlaneSums sums;
  for (std::size_t j = 0; j < static_cast<std::size_t>(size); ++j)
    sums.add(window.offsets[order[j].second], 1);
  return sums.plane();
}

using Planes = std::array<Plane, 2>;

/// Of all pairs of hypotheses that pass near the middle the one that explains most.
std::optional<Planes> best_pair(const Window& window) {
  std::vector<Plane> planes;
  std::vector<std::vector<float>> scores;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < hypotheses; ++i) {
    const std::optional<Plane> plane = plane_at(window, i, order);
    if (!plane || std::abs(plane->offset) > near_crease) continue;
    planes.push_back(*plane);
    auto& score = scores.emplace_back(window.offsets.size());
    for (std::size_t j = 0; j < score.size(); ++j)
      score[j] = static_cast<float>(explained(height(*plane, window.offsets[j]), window.view.tolerance));
  }
  std::optional<Planes> best;
  float most = 0;
  for (std::size_t a = 0; a < planes.size(); ++a) {
    for (std::size_t b = a + 1; b < planes.size(); ++b) {
      if (length(cross(planes[a].normal, planes[b].normal)) < smallest_sine) continue;
      float total = 0;
      for (std::size_t j = 0; j < window.offsets.size(); ++j) total += std::max(scores[a][j], scores[b][j]);
      if (total > most) {
        most = total;
        best = Planes{planes[a], planes[b]};
      }
    }
  }
  return best;
}

/// Two half-planes that end at one line.
struct Wedge {
  Planes planes;
  Point foot{};                   // on the line, nearest to the middle of the window
  Point tangent{};                // of the line
  std::array<Point, 2> inward{};  // in each plane, away from the line
};

/// The line in which the planes meet; the half-planes are still unknown.
std::optional<Wedge> meet(const Planes& planes) {
  const Point along = cross(planes[0].normal, planes[1].normal);
  const double sine = length(along);
  if (sine < smallest_sine) return std::nullopt;
  Wedge wedge{planes, {}, scaled(1 / sine, along), {}};
  const double cosine = dot(planes[0].normal, planes[1].normal);
  const double first = planes[0].offset;
  const double second = planes[1].offset;
  const double a = (first - cosine * second) / (sine * sine);
  const double b = (second - cosine * first) / (sine * sine);
  wedge.foot = sum(scaled(a, planes[0].normal), scaled(b, planes[1].normal));
  return wedge;
}

std::size_t nearer_plane(const Planes& planes, const Point& p) {
  return std::abs(height(planes[0], p)) <= std::abs(height(planes[1], p)) ? 0 : 1;
}

/// On which side of the line each plane has its points: by the sum of their coordinates.
void choose_sides(Wedge& wedge, const Window& window) {
  std::array<double, 2> balance{};
  for (std::size_t i = 0; i < 2; ++i) wedge.inward[i] = cross(wedge.tangent, wedge.planes[i].normal);
  for (const Point& p : window.offsets) {
    const std::size_t i = nearer_plane(wedge.planes, p);
    const double share = explained(height(wedge.planes[i], p), window.view.tolerance);
    balance[i] += share * dot(wedge.inward[i], difference(p, wedge.foot));
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (balance[i] < 0) wedge.inward[i] = scaled(-1, wedge.inward[i]);
}

/// Fades out towards the border of the window, and sooner along the line, where planes cannot follow a bend.
double weight_of(const Point& from_foot, const Point& tangent) {
  constexpr double reach = 4.5;
  constexpr double reach_along = 3;
  const double u = dot(tangent, from_foot);
  const double along = u * u / (reach_along * reach_along);
  const double across = (dot(from_foot, from_foot) - u * u) / (reach * reach);
  return along < 1 && across < 1 ? (1 - along) * (1 - along) * (1 - across) * (1 - across) : 0;
}

/// Points go to the half-plane that they are nearest to, planes to their points, by turns.
std::optional<Wedge> refine(const Planes& start, const Window& window) {
  constexpr int rounds = 4;
  std::optional<Wedge> wedge = meet(start);
  for (int round = 0; round < rounds && wedge; ++round) {
    choose_sides(*wedge, window);
    std::array<PlaneSums, 2> sums;
    for (const Point& p : window.offsets) {
      const std::size_t i = nearer_plane(wedge->planes, p);
      const Point from_foot = difference(p, wedge->foot);
      if (std::abs(height(wedge->planes[i], p)) > window.view.tolerance) continue;
      if (dot(wedge->inward[i], from_foot) < -side_overlap) continue;
      sums[i].add(p, weight_of(from_foot, wedge->tangent));
    }
    const auto first = sums[0].plane();
    const auto second = sums[1].plane();
    if (!first || !second) return std::nullopt;
    wedge = meet({*first, *second});
  }
  if (wedge) choose_sides(*wedge, window);
  return wedge;
}

/// Do both planes end at the line, and are there points of both beside the foot? The share of the window
/// that the half-planes explain; 0 if not.
double share_explained(const Wedge& wedge, const Window& window) {
  constexpr double beside = 1.25;  // along the line
  constexpr double across = 2.5;
  constexpr double wrong_side = 0.25;  // share of a plane's points that chance may put past the line
  double total = 0;
  std::array<int, 2> all{};
  std::array<int, 2> past{};
  std::array<int, 2> close{};
  for (const Point& p : window.offsets) {
    const std::size_t i = nearer_plane(wedge.planes, p);
    const double share = explained(height(wedge.planes[i], p), window.view.tolerance);
    if (share == 0) continue;
    const Point from_foot = difference(p, wedge.foot);
    const double inward = dot(wedge.inward[i], from_foot);
    ++all[i];
    if (inward < -side_overlap) {
      ++past[i];
      continue;
    }
    total += share;
    if (inward < across && std::abs(dot(wedge.tangent, from_foot)) < beside) ++close[i];
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (close[i] == 0 || past[i] > wrong_side * all[i]) return 0;
  return total / static_cast<double>(window.offsets.size());
}

/// How much better a crease explains the points than a smooth surface of as many parameters, as a difference
/// of chi squared. Over the plane between the two: w = k |v| + rest against w = k v^2 + rest, with v across
/// the line, u along it, and rest = a + b u + c v + d u v + e u^2.
double evidence_of(const Wedge& wedge, const Window& window) {
  // What turns by more than 60 degrees within the window is sharp, even if it is rounded.
  constexpr double obtuse = -0.5;
  constexpr double sharp = 25;
  if (dot(wedge.inward[0], wedge.inward[1]) > obtuse) return sharp;
  // Along the bisector of the two sides, and up.
  const Point across = unit(difference(wedge.inward[0], wedge.inward[1]));
  const Point up = cross(wedge.tangent, across);
  LeastSquares<6> kink;
  LeastSquares<6> smooth;
  for (const Point& p : window.offsets) {
    const std::size_t i = nearer_plane(wedge.planes, p);
    if (std::abs(height(wedge.planes[i], p)) > 2 * window.view.tolerance) continue;
    const Point d = difference(p, wedge.foot);
    const double u = dot(wedge.tangent, d);
    const double v = dot(across, d);
    const double w = dot(up, d);
    kink.add({std::abs(v), 1, u, v, u * v, u * u}, w);
    smooth.add({v * v, 1, u, v, u * v, u * u}, w);
  }
  return (smooth.residual() - kink.residual()) / (window.view.noise * window.view.noise);
}

/// In the frame of the trace, of a window about `middle`. Nothing if it is no wedge.
std::optional<Foot> foot_of(const Wedge& wedge, const Window& window, const FeatureLabels& labels,
                            const Point& middle) {
  Foot foot;
  foot.quality = share_explained(wedge, window);
  if (foot.quality == 0) return std::nullopt;
  foot.evidence = evidence_of(wedge, window);
  foot.position = sum(middle, scaled(window.scale, wedge.foot));
  foot.tangent = wedge.tangent;
  foot.normals = {wedge.planes[0].normal, wedge.planes[1].normal};
  foot.scale = window.scale;
  constexpr double nearby = 1.5;
  for (std::size_t j = 0; j < window.points.size() && !foot.is_backed; ++j) {
    const Kind kind = labels.kind[window.points[j]];
    foot.is_backed =
        (kind == Kind::Edge || kind == Kind::Corner) && distance(window.offsets[j], wedge.foot) < nearby;
  }
  return foot;
}

}  // namespace

WedgeView view_of(double noise) {
  constexpr double seen_well = 0.06;  // noise that the default view is made for
  constexpr double most = 2;          // times the points: with more, small faces are lost
  constexpr double noises_within = 3.5;
  WedgeView view;
  const double more = std::clamp(noise / seen_well, 1.0, most);
  view.unit = std::sqrt(more);
  view.points = static_cast<int>(view.points * more);
  view.points_of_hypothesis = static_cast<int>(view.points_of_hypothesis * more);
  view.noise = std::max(view.noise, noise / view.unit);
  view.tolerance = std::max(view.tolerance, noises_within * view.noise);
  return view;
}

std::optional<Foot> WedgeTracker::find(std::uint32_t point) const {
  const Point middle = frame_.local(cloud_.positions[point]);
  const auto window = window_at(middle, cloud_, search_, frame_, view_);
  if (!window) return std::nullopt;
  const auto pair = best_pair(*window);
  if (!pair) return std::nullopt;
  const auto wedge = refine(*pair, *window);
  if (!wedge || length(wedge->foot) > largest_shift) return std::nullopt;
  const std::optional<Foot> foot = foot_of(*wedge, *window, labels_, middle);
  return foot && foot->evidence > 0 ? foot : std::nullopt;
}

std::optional<Foot> WedgeTracker::follow(const Foot& from, const Point& expected) const {
  constexpr double steady = 0.97;  // where a line bends the old planes hold on to too few points
  const auto window = window_at(expected, cloud_, search_, frame_, view_);
  if (!window) return std::nullopt;
  const auto foot_by = [&](const Planes& planes) -> std::optional<Foot> {
    const auto wedge = refine(planes, *window);
    if (!wedge || length(wedge->foot) > near_crease) return std::nullopt;
    std::optional<Foot> foot = foot_of(*wedge, *window, labels_, expected);
    if (foot && dot(foot->tangent, from.tangent) < 0) foot->tangent = scaled(-1, foot->tangent);
    return foot;
  };
  const Point back = scaled(1 / window->scale, difference(from.position, expected));
  const auto old_plane = [&](const Point& normal) { return Plane{normal, dot(normal, back)}; };
  std::optional<Foot> foot = foot_by({old_plane(from.normals[0]), old_plane(from.normals[1])});
  if (foot && foot->evidence > 0 && foot->quality > steady * from.quality) return foot;
  const auto pair = best_pair(*window);
  const std::optional<Foot> fresh = pair ? foot_by(*pair) : std::nullopt;
  const auto rank = [](const Foot& f) { return std::pair(f.evidence > 0, f.quality); };
  return fresh && (!foot || rank(*fresh) > rank(*foot)) ? fresh : foot;
}

}  // namespace keenline
