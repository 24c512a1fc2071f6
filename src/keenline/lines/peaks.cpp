#include "keenline/lines/peaks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "keenline/detect/cone.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths are in spacings: of the cloud between peaks and lines, of the points around in a fit.
constexpr double apart = 3;            // peaks from each other and from lines
constexpr double beside_failed = 1.5;  // around a place where there was none the next is looked for
constexpr double largest_move = 3;
constexpr double largest_gap = 2;  // between the apex and the nearest point: else the tip is cut off
constexpr double largest_residual = 0.15;
/// Compared with that from the paraboloid: 0.3 to 0.65 with noise of 0.1 and openings up to 90 degrees.
constexpr double largest_ratio = 0.65;
constexpr int window_size = 80;
constexpr double least_weight = 0.75 * window_size;  // of the points that count; with normal errors 0.91

struct Window {
  std::vector<Point> points;  // from where the peak is looked for, in spacings of the cloud
  std::vector<double> weights;
};

/// The points around a place; without weights yet.
Window window_at(const Point& place, const Point& origin, const PointCloud& cloud,
                 const NeighborSearch& search, const TraceFrame& frame) {
  Window window;
  for (const std::uint32_t q : search.nearest_to(frame.global(sum(origin, place)), window_size)) {
    const Point offset = difference(frame.local(cloud.positions[q]), origin);
    if (is_drawable(offset)) window.points.push_back(offset);  // others cannot be squared
  }
  window.weights.assign(window.points.size(), 1);
  return window;
}

/// Points far off the cone, compared with the others, do not count: Tukey's weights.
void weigh(Window& window, const Cone& cone) {
  constexpr double cut = 4.685;
  constexpr double to_deviation = 1.4826;  // from the median, of normal errors
  constexpr double least_deviation = 0.02;
  const double steepness = std::sqrt(dot(cone.slope, cone.slope) - 1);
  std::vector<double> misses;
  misses.reserve(window.points.size());
  for (const Point& q : window.points) {
    const Point u = difference(q, cone.apex);
    misses.push_back(std::abs(length(u) - dot(u, cone.slope)) / steepness);
  }
  std::vector<double> sorted = misses;
  const double limit = cut * std::max(to_deviation * median(sorted), least_deviation);
  for (std::size_t i = 0; i < misses.size(); ++i) {
    const double r = misses[i] / limit;
    window.weights[i] = r < 1 ? (1 - r * r) * (1 - r * r) : 0;
  }
}

/// Is the cone a tip of the surface, to which the window's points belong?
bool is_tip(const Cone& cone, const Window& window, double mean_square) {
  const auto is_nearer = [&](const Point& a, const Point& b) {
    return distance(a, cone.apex) < distance(b, cone.apex);
  };
  const auto [nearest, farthest] = std::minmax_element(window.points.begin(), window.points.end(), is_nearer);
  const double reach = distance(*farthest, cone.apex);
  const double spacing = reach * std::sqrt(kernels::pi * std::sqrt(cone.squared_sine()) / window_size);
  const double smooth = mean_square_off_paraboloid(cone, window.points, window.weights);
  return std::accumulate(window.weights.begin(), window.weights.end(), 0.0) >= least_weight &&
         length(cone.apex) <= largest_move * spacing &&
         distance(*nearest, cone.apex) <= largest_gap * spacing &&
         mean_square <= largest_residual * largest_residual * spacing * spacing &&
         mean_square <= largest_ratio * largest_ratio * smooth && encloses_axis(cone, window.points);
}

/// Looks for a peak at a place of the frame. The window follows the apex: not to lie on one side of it.
std::optional<GraphCorner> peak_near(const Point& place, const PointCloud& cloud,
                                     const NeighborSearch& search, const TraceFrame& frame) {
  constexpr int rounds = 4;
  Cone cone;
  Window window;
  for (int round = 0; round < rounds; ++round) {
    Window next = window_at(cone.apex, place, cloud, search, frame);
    if (next.points.size() < window_size) return std::nullopt;
    if (round > 0) weigh(next, cone);
    window = std::move(next);
    const std::optional<Cone> fitted = fitted_cone(window.points, window.weights, cone.apex);
    if (!fitted || !is_pointed(*fitted)) return std::nullopt;
    cone = *fitted;
    if (!is_drawable(frame.global(sum(place, cone.apex)))) return std::nullopt;
  }
  const double mean_square = mean_square_off(cone, window.points, window.weights);
  if (!is_tip(cone, window, mean_square)) return std::nullopt;
  return GraphCorner{frame.global(sum(place, cone.apex)), frame.spacing * std::sqrt(mean_square)};
}

/// Places of the frame, each of which keeps others off.
class Places {
 public:
  explicit Places(double reach) : reach_(reach) {}

  void add(const Point& place) {
    Foot foot;
    foot.position = place;
    grid_.insert({0, 0, foot});
  }
  [[nodiscard]] bool are_near(const Point& place) const {
    bool found = false;
    grid_.near(place, reach_, [&](const FootGrid::Entry& entry) {
      found = found || distance(entry.foot.position, place) <= reach_;
    });
    return found;
  }

 private:
  double reach_;
  FootGrid grid_;
};

/// Sharp points, those labelled Peak first, and of like ones the sharpest.
std::vector<std::uint32_t> candidates_of(const PointCloud& cloud, const FeatureLabels& labels) {
  std::vector<std::uint32_t> candidates;
  for (std::uint32_t i = 0; i < labels.size(); ++i)
    if (is_feature(labels.kind[i]) && is_drawable(cloud.positions[i])) candidates.push_back(i);
  const bool has_scores = labels.score.size() == labels.size();
  std::stable_sort(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
    const bool is_peak = labels.kind[a] == Kind::Peak;
    if (is_peak != (labels.kind[b] == Kind::Peak)) return is_peak;
    return has_scores && labels.score[a] > labels.score[b];
  });
  return candidates;
}

}  // namespace

void add_peaks(FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search,
               const FeatureLabels& labels, const TraceFrame& frame, const Progress& progress) {
  Places features(apart);
  for (const Polyline& line : graph.polylines)
    for (const Point& vertex : line.vertices) features.add(frame.local(vertex));
  Places failures(beside_failed);
  for (const std::uint32_t candidate : candidates_of(cloud, labels)) {
    const Point& position = cloud.positions[candidate];
    const Point place = frame.local(position);
    if (features.are_near(place) || failures.are_near(place)) continue;
    progress.check();
    std::optional<GraphCorner> peak = peak_near(place, cloud, search, frame);
    if (peak && features.are_near(frame.local(peak->position))) peak.reset();
    if (!peak && labels.kind[candidate] == Kind::Peak) peak = {position, std::nullopt};
    if (!peak) {
      failures.add(place);
      continue;
    }
    features.add(frame.local(peak->position));
    graph.corners.push_back(*peak);
  }
}

}  // namespace keenline
