#include "keenline/lines/find_sides.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "keenline/kernels/symmetric3.h"
#include "keenline/lines/rim.h"
#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths are in spacings.
constexpr int most_points = 400;              // two sheets of the widest patch
constexpr std::size_t most_guesses = 32;      // half planes that are tried
constexpr std::size_t points_of_guess = 10;   // a normal from fewer scatters, from more it bends
constexpr double widest_tolerance = 0.6;      // noise of 0.1, and the sagitta of a radius of 20 at 5
constexpr double narrowest_tolerance = 0.05;  // rounding must not choose among the points of exact clouds
constexpr double largest_miss = 2;            // of a surface at the line: it would not be met there
constexpr double largest_slope_along = 0.6;   // sine: a side follows its line, give or take 37 degrees
constexpr double least_turn = 0.12;           // sine of 7 degrees between the sides
constexpr double largest_residual = 0.35;     // beyond, it is not one surface
constexpr std::size_t fewest_points = 8;
constexpr double largest_curvature = 0.15;  // half of 1 / radius: no surface of radius 3.3 is smooth
constexpr double worth_of_bending = 16.3;   // chi squared of 3 degrees of freedom at 0.1 %
constexpr double hint_of_bending = 6;       // chi squared of 2 degrees of freedom at 5 %
constexpr double tukey = 4.685;             // 95 % efficient for normal residuals
constexpr double mad_to_sigma = 1.4826;

/// The points around one place of a line, as offsets in spacings.
struct Patch {
  Point center{};
  double spacing = 1;
  Point along{};
  std::vector<Point> offsets{};
  std::vector<double> across{};  // distance of each from the line

  [[nodiscard]] std::vector<std::uint32_t> beyond(double rim) const {
    std::vector<std::uint32_t> far;
    for (std::uint32_t i = 0; i < offsets.size(); ++i)
      if (across[i] >= rim) far.push_back(i);
    return far;
  }
};

Patch patch_around(const PointCloud& cloud, const NeighborSearch& search, const Point& position,
                   const Point& direction, double spacing, const SidesOptions& options) {
  Patch patch{.center = position, .spacing = spacing, .along = direction};
  const std::vector<std::uint32_t> points = search.nearest_to(position, most_points);
  const double radius = std::sqrt(options.reach * options.reach + options.stretch * options.stretch);
  // Where the cloud is so dense that most_points do not fill the patch, the patch shrinks.
  if (points.size() == static_cast<std::size_t>(most_points)) {
    const double farthest = distance(cloud.positions[points.back()], position);
    if (farthest > 0) patch.spacing = std::min(spacing, farthest / radius);
  }
  for (const std::uint32_t point : points) {
    const Point offset = scaled(1 / patch.spacing, difference(cloud.positions[point], position));
    const double along = dot(offset, direction);
    const double across = length(difference(offset, scaled(along, direction)));
    if (!(std::abs(along) <= options.stretch && across <= options.reach)) continue;
    patch.offsets.push_back(offset);
    patch.across.push_back(across);
  }
  return patch;
}

/// A frame for a surface through `point` (or, as the height, at any level) with x into it from the line.
SideSurface plane_of(const Patch& patch, const Point& normal, double level, const Point& inside) {
  SideSurface plane{.origin = patch.center, .spacing = patch.spacing, .z = normal};
  plane.x = unit(cross(normal, patch.along));
  if (dot(plane.x, inside) < 0) plane.x = scaled(-1, plane.x);
  plane.y = cross(normal, plane.x);
  plane.height[0] = level;
  return plane;
}

bool is_inside(const SideSurface& side, const Point& offset) { return dot(side.x, offset) > 0; }

/// The plane of the nearest points around one; none if it cannot be a side of the line.
std::optional<SideSurface> guess_at(const Patch& patch, const Point& at) {
  std::array<std::pair<double, std::uint32_t>, points_of_guess> nearest;
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < patch.offsets.size(); ++i) {
    const Point d = difference(patch.offsets[i], at);
    const double square = dot(d, d);
    if (count == nearest.size() && square >= nearest.back().first) continue;  // of equal ones the first
    if (count < nearest.size()) ++count;
    std::size_t to = count - 1;
    for (; to > 0 && square < nearest[to - 1].first; --to) nearest[to] = nearest[to - 1];
    nearest[to] = {square, i};
  }
  if (count < 4) return std::nullopt;
  Point mean{};
  for (std::size_t i = 0; i < count; ++i)
    mean = sum(mean, scaled(1 / static_cast<double>(count), patch.offsets[nearest[i].second]));
  kernels::Symmetric3 scatter;
  for (std::size_t i = 0; i < count; ++i) {
    const Point d = difference(patch.offsets[nearest[i].second], mean);
    kernels::add_outer_product(scatter, d[0], d[1], d[2]);
  }
  const kernels::Eigen3 axes = kernels::eigen_decomposition(scatter);
  const Point normal = axes.vectors[2];
  const double level = dot(normal, mean);
  if (axes.values[2] > 0.2 * axes.values[1]) return std::nullopt;  // no plane, or two
  if (std::abs(dot(normal, patch.along)) > largest_slope_along || std::abs(level) > largest_miss)
    return std::nullopt;
  return plane_of(patch, normal, level, at);
}

/// How well points agree with a half plane, but for those that `other` explains.
double score_of(const SideSurface& guess, const Patch& patch, std::span<const std::uint32_t> points,
                const SideSurface* other) {
  double score = 0;
  for (const std::uint32_t i : points) {
    const Point& q = patch.offsets[i];
    if (!is_inside(guess, q)) continue;
    if (other != nullptr && is_inside(*other, q) && std::abs(other->above(q)) < widest_tolerance) continue;
    const double miss = guess.above(q) / widest_tolerance;
    score += std::max(0.0, 1 - miss * miss);
  }
  return score;
}

/// Neither one surface that goes on across the line nor the same one twice.
bool is_turn(const SideSurface& a, const SideSurface& b) { return length(cross(a.x, b.x)) > least_turn; }

const SideSurface* best_of(std::span<const SideSurface> guesses, const Patch& patch,
                           std::span<const std::uint32_t> points, const SideSurface* other) {
  const SideSurface* best = nullptr;
  double best_score = 0.5 * static_cast<double>(fewest_points);
  for (const SideSurface& guess : guesses) {
    if (other != nullptr && !is_turn(guess, *other)) continue;
    const double score = score_of(guess, patch, points, other);
    if (score <= best_score) continue;
    best_score = score;
    best = &guess;
  }
  return best;
}

std::vector<SideSurface> guess_sides(const Patch& patch, std::span<const std::uint32_t> points,
                                     std::size_t wanted) {
  std::vector<SideSurface> guesses;
  const std::size_t step = points.size() / most_guesses + 1;
  for (std::size_t i = 0; i < points.size(); i += step)
    if (const auto guess = guess_at(patch, patch.offsets[points[i]])) guesses.push_back(*guess);
  std::vector<SideSurface> sides;
  for (const SideSurface* other = nullptr; sides.size() < wanted;) {
    const SideSurface* const best = best_of(guesses, patch, points, other);
    if (best == nullptr) break;
    sides.push_back(*best);
    other = best;
  }
  return sides;
}

/// The points of a patch that could be of one side, as that side sees them.
struct View {
  std::vector<Point> places;     // in the frame of the side
  std::vector<double> across;    // distance of each from the line
  std::vector<double> to_rival;  // and from the nearest other side that it could be of
};

/// Fits the sides of a line robustly: points go to the side that they are nearest to.
class Refinement {
 public:
  /// Points nearer to the line than `rim` say nothing of what the sides are like.
  Refinement(const Patch& patch, double rim, const std::vector<SideSurface>& sides)
      : patch_(patch), rim_(rim) {
    for (const SideSurface& side : sides) fits_.push_back({side, widest_tolerance, SurfaceTerms::Plane});
  }

  /// Empty where a side has too few points.
  std::vector<Side> run() {
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round) {
      for (std::size_t s = 0; s < fits_.size(); ++s)
        if (!fit_plane(s)) return {};
    }
    std::vector<std::optional<Fit>> quadrics(fits_.size());
    std::vector<Fit> bent = fits_;
    bool are_planes = true;
    for (std::size_t s = 0; s < fits_.size(); ++s) {
      look(s);
      quadrics[s] = bend(bent[s]);
      are_planes = are_planes && bent[s].terms == SurfaceTerms::Plane;
    }
    fits_ = bent;
    std::vector<Fit> grown = fits_;
    for (std::size_t s = 0; s < fits_.size(); ++s) {
      look(s);
      // Where no side has been bent the quadric would be the same again.
      grown[s] =
          grown_to_line(fits_[s], are_planes ? quadrics[s] : with_terms(fits_[s], SurfaceTerms::Quadric));
    }
    fits_ = grown;
    rim_ = 0;
    std::vector<Side> result;
    for (std::size_t s = 0; s < fits_.size(); ++s) result.push_back(side(s));
    return result;
  }

 private:
  struct Fit {
    SideSurface surface;
    double tolerance;
    SurfaceTerms terms;
  };

  /// Takes the view of side `s`. It holds for all surfaces over its plane, until another side changes.
  void look(std::size_t s) {
    const SideSurface& frame = fits_[s].surface;
    for (auto* list : {&view_.across, &view_.to_rival}) list->clear();
    view_.places.clear();
    for (std::size_t i = 0; i < patch_.offsets.size(); ++i) {
      const Point& q = patch_.offsets[i];
      if (!is_inside(frame, q)) continue;
      double to_rival = std::numeric_limits<double>::infinity();
      for (std::size_t other = 0; other < fits_.size(); ++other) {
        const SideSurface& rival = fits_[other].surface;
        if (other != s && is_inside(rival, q)) to_rival = std::min(to_rival, std::abs(rival.distance(q)));
      }
      view_.places.push_back(frame.in_frame(q));
      view_.across.push_back(patch_.across[i]);
      view_.to_rival.push_back(to_rival);
    }
  }

  /// Distance of point `i` of the view from a surface; nothing for points that are not of that side, or
  /// farther from it than its tolerance.
  [[nodiscard]] std::optional<double> residual(const Fit& fit, std::size_t i) const {
    if (view_.across[i] < rim_) return std::nullopt;
    const double distance = fit.surface.distance_in_frame(view_.places[i]);
    if (std::abs(distance) >= fit.tolerance || view_.to_rival[i] < std::abs(distance)) return std::nullopt;
    return distance;
  }

  /// Weighs the points and narrows the tolerance to what their residuals justify; how many points count.
  std::size_t weigh(Fit& fit) {
    residuals_.clear();
    squares_ = 0;
    weights_.assign(view_.places.size(), 0);
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const std::optional<double> r = residual(fit, i);
      if (!r) continue;
      const double part = *r / fit.tolerance;
      weights_[i] = (1 - part * part) * (1 - part * part);
      residuals_.push_back(std::abs(*r));
      squares_ += *r * *r;  // here, because a median leaves the order of the residuals open
    }
    const std::size_t count = residuals_.size();
    if (count > 0) {
      fit.tolerance =
          std::clamp(tukey * mad_to_sigma * median(residuals_), narrowest_tolerance, widest_tolerance);
    }
    return count;
  }

  bool fit_plane(std::size_t s) {
    look(s);
    Fit& plane = fits_[s];
    if (weigh(plane) < fewest_points) return false;
    const auto tilted = fit_surface(plane.surface, view_.places, weights_, SurfaceTerms::Plane);
    if (!tilted) return false;
    const Point normal = tilted->normal({});
    if (std::abs(dot(normal, patch_.along)) > largest_slope_along) return false;
    const double level = tilted->height[0] * dot(normal, tilted->z);
    plane.surface = plane_of(patch_, normal, level, tilted->x);
    return true;
  }

  bool fit(Fit& surface) {
    if (weigh(surface) < fewest_points) return false;
    const auto fitted = fit_surface(surface.surface, view_.places, weights_, surface.terms);
    if (fitted) surface.surface = *fitted;
    return fitted.has_value();
  }

  /// Gives the plane of the side in view the curvature that its points ask for. Returns the quadric.
  std::optional<Fit> bend(Fit& bent) {
    const Fit plane = bent;
    std::optional<Fit> candidate;
    for (const SurfaceTerms terms : {SurfaceTerms::BentAlongY, SurfaceTerms::Quadric}) {
      candidate = with_terms(plane, terms);
      if (candidate && gain(*candidate, bent, plane) > worth_of_bending) bent = *candidate;
    }
    return candidate;
  }

  std::optional<Fit> with_terms(const Fit& side, SurfaceTerms terms) {
    Fit candidate{side.surface, widest_tolerance, terms};
    constexpr int rounds = 6;
    for (int round = 0; round < rounds; ++round)
      if (!fit(candidate)) return std::nullopt;
    if (!is_smooth(candidate.surface)) return std::nullopt;
    return candidate;
  }

  /// The side in view with the points nearer to the line that lie on it: as near as they come they keep it
  /// from swaying there. If it takes a quadric to reach them, a quadric it is; what is rounded no quadric
  /// follows.
  Fit grown_to_line(const Fit& side, std::optional<Fit> quadric) {
    const double rim = rim_;
    if (quadric && gain(*quadric, side, *quadric) < hint_of_bending) quadric.reset();
    Fit grown = side;
    for (const double part : {0.6, 0.3, 0.0}) {
      rim_ = part * rim;
      fit(grown);
      if (quadric && !fit(*quadric)) quadric.reset();
    }
    if (quadric && is_smooth(quadric->surface) && gain(*quadric, grown, *quadric) > worth_of_bending)
      grown = *quadric;
    rim_ = rim;
    return grown;
  }

  static bool is_smooth(const SideSurface& surface) {
    return std::all_of(surface.height.begin() + 3, surface.height.end(),
                       [](double factor) { return std::abs(factor) <= largest_curvature; });
  }

  /// Does a surface with more terms explain the points of `asked` significantly better than one with fewer?
  /// Other points must not be asked: a third face near a corner is easily had by bending.
  double gain(const Fit& more, const Fit& fewer, const Fit& asked) {
    std::vector<std::pair<double, double>> squares;
    residuals_.clear();
    for (std::size_t i = 0; i < view_.places.size(); ++i) {
      if (!residual(asked, i)) continue;
      const double of_more = more.surface.distance_in_frame(view_.places[i]);
      const double of_fewer = fewer.surface.distance_in_frame(view_.places[i]);
      squares.emplace_back(of_more * of_more, of_fewer * of_fewer);
      residuals_.push_back(std::abs(of_more));
    }
    const auto count = static_cast<double>(squares.size());
    const auto terms = static_cast<double>(more.terms);
    if (count <= terms + 1) return 0;
    constexpr double finest = 0.03;  // smaller differences matter to nobody
    const double sigma =
        std::max(finest, mad_to_sigma * median(residuals_) * std::sqrt(count / (count - terms)));
    double gain = 0;
    constexpr double most = 4;  // what a single point can say
    for (const auto& [of_more, of_fewer] : squares)
      gain += std::min(most, of_fewer / (sigma * sigma)) - std::min(most, of_more / (sigma * sigma));
    return gain;
  }

  Side side(std::size_t s) {
    look(s);
    Side result{.surface = fits_[s].surface, .inward = fits_[s].surface.x};
    result.support = weigh(fits_[s]);
    if (result.support > 0)
      result.residual = patch_.spacing * std::sqrt(squares_ / static_cast<double>(result.support));
    return result;
  }

  const Patch& patch_;
  double rim_;
  std::vector<Fit> fits_;
  View view_;
  std::vector<double> weights_;  // of the points in view
  std::vector<double> residuals_;
  double squares_ = 0;  // sum of those of the residuals
};

bool is_credible(const std::vector<Side>& sides, std::size_t wanted, double spacing) {
  if (sides.size() < wanted) return false;
  const bool all_fit = std::all_of(sides.begin(), sides.end(), [&](const Side& side) {
    return side.support >= fewest_points && side.residual <= largest_residual * spacing;
  });
  if (!all_fit || wanted == 1) return all_fit;
  // Bent surfaces may turn out to be one where they meet.
  const Point left = sides[0].surface.normal({});
  const Point right = sides[1].surface.normal({});
  return length(cross(left, right)) > least_turn;
}

/// The body is in the smaller angle between the sides: outside is where neither goes.
LineSides ordered(const Side& a, const Side& b, const Point& along) {
  const Point outward = scaled(-1, sum(a.inward, b.inward));
  const Point leftward = cross(outward, along);
  const bool a_is_left = dot(a.inward, leftward) > dot(b.inward, leftward);
  LineSides sides{a_is_left ? a : b, a_is_left ? b : a};
  for (Side* const side : {&sides.left, &sides.right}) {
    SideSurface& surface = side->surface;
    if (dot(surface.z, outward) >= 0) continue;
    surface.y = scaled(-1, surface.y);
    surface.z = scaled(-1, surface.z);
    // z is now the negative of what it was, and so is y.
    for (const std::size_t even_in_y : {0U, 1U, 3U, 5U})
      surface.height[even_in_y] = -surface.height[even_in_y];
  }
  return sides;
}

}  // namespace

std::optional<LineSides> find_sides(const PointCloud& cloud, const NeighborSearch& search,
                                    const Point& position, const Point& direction, LineKind kind,
                                    double spacing, const SidesOptions& options) {
  if (dot(direction, direction) == 0) return std::nullopt;
  SidesOptions within = options;
  if (kind == LineKind::Border) within.stretch = options.reach;  // one line of points is little to go by
  const Patch patch = patch_around(cloud, search, position, direction, spacing, within);
  const std::size_t wanted = kind == LineKind::Crease ? 2 : 1;
  for (const double rim : {options.rim, 0.5 * options.rim, 0.2 * options.rim}) {
    const std::vector<std::uint32_t> points = patch.beyond(rim);
    const std::vector<Side> sides = Refinement(patch, rim, guess_sides(patch, points, wanted)).run();
    if (!is_credible(sides, wanted, patch.spacing)) continue;
    if (kind == LineKind::Crease) return ordered(sides[0], sides[1], direction);
    const std::optional<Side> rim_side = rim_of(sides[0], patch.offsets);
    if (rim_side) return LineSides{sides[0], *rim_side};
  }
  return std::nullopt;
}

}  // namespace keenline
