#include "keenline/lines/straighten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "keenline/kernels/symmetric3.h"
#include "keenline/order_statistics.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// In spacings.
constexpr double shortest_stretch = 10;
constexpr double least_uncertainty = 0.1;
constexpr double unknown = 1;        // uncertainty of vertices without a residual: as tracers place them
constexpr double unsure = 0.2;       // from here on a vertex is not known to lie where surfaces meet
constexpr double small_rise = 0.35;  // of a parabola over its chord
constexpr double unsure_corner = 0.35;
constexpr double largest_corner_move = 1;

/// Share of the eigenvalue 1 that a line contributes across itself, below which a corner is not fixed.
constexpr double least_fixed = 0.1;

struct StraightLine {
  Point through{};
  Point direction{};  // unit vector

  [[nodiscard]] Point foot(const Point& p) const {
    return sum(through, scaled(dot(difference(p, through), direction), direction));
  }
};

/// The point of least squares of the lines, as far as they fix one; else nearest to the point given.
Point nearest_to_all(const std::vector<StraightLine>& lines, const Point& point) {
  const auto count = static_cast<double>(lines.size());
  kernels::Symmetric3 across{count, 0, 0, count, 0, count};
  Point right{0, 0, 0};
  for (const StraightLine& line : lines) {
    kernels::add_square(across, line.direction, -1);
    right = sum(right, difference(line.foot(point), point));
  }
  const kernels::Eigen3 axes = kernels::eigen_decomposition(across);
  Point move{0, 0, 0};
  for (std::size_t i = 0; i < 3; ++i)
    if (axes.values[i] > least_fixed)
      move = sum(move, scaled(dot(right, axes.vectors[i]) / axes.values[i], axes.vectors[i]));
  return sum(point, move);
}

/// Vertices `first` to `last` of a line, both included.
struct Stretch {
  std::size_t first;
  std::size_t last;
};

/// One line and how well its vertices are known.
class Straightener {
 public:
  Straightener(Polyline& line, const std::vector<GraphCorner>& corners, double spacing)
      : line_(line), spacing_(spacing) {
    uncertainty_.resize(line.vertices.size(), unknown * spacing);
    weights_.resize(line.vertices.size());
    dropped_.resize(line.vertices.size(), false);
    for (std::size_t i = 0; i < line.residual.size(); ++i) uncertainty_[i] = line.residual[i];
    const auto at_corner = [&](std::optional<std::uint32_t> corner, double& uncertainty) {
      if (corner && corners[*corner].residual) uncertainty = *corners[*corner].residual;
    };
    at_corner(line.start_corner, uncertainty_.front());
    at_corner(line.end_corner, uncertainty_.back());
    for (double& uncertainty : uncertainty_) uncertainty = std::max(uncertainty, least_uncertainty * spacing);
  }

  /// Straightens what is straight; tells of the lines at the two ends, where there are such.
  std::array<std::optional<StraightLine>, 2> straighten() {
    const std::size_t last = line_.vertices.size() - 1;
    std::array<std::optional<StraightLine>, 2> at_ends;
    std::vector<std::vector<StraightLine>> at_divisions(line_.vertices.size());
    std::vector<Stretch> open{{0, last}};
    while (!open.empty()) {
      const Stretch stretch = open.back();
      open.pop_back();
      if (stretch.last < stretch.first + 2) continue;
      if (const auto straight = straight_line(stretch)) {
        move_inner(stretch, *straight);
        at_divisions[stretch.first].push_back(*straight);
        at_divisions[stretch.last].push_back(*straight);
        if (stretch.first == 0) at_ends[0] = straight;
        if (stretch.last == last) at_ends[1] = straight;
        continue;
      }
      const std::size_t middle = farthest_from_chord(stretch);
      open.push_back({stretch.first, middle});
      open.push_back({middle, stretch.last});
    }
    for (std::size_t i = 0; i <= last; ++i) {
      const bool is_shared = (i == 0 && line_.start_corner) || (i == last && line_.end_corner);
      if (!at_divisions[i].empty() && !is_shared) move(i, nearest_to_all(at_divisions[i], line_.vertices[i]));
    }
    if (has_moved_) leave_out_dropped();
    return at_ends;
  }

 private:
  /// The straight line that the stretch is taken for; none where it is not to be, or is known well.
  [[nodiscard]] std::optional<StraightLine> straight_line(const Stretch& stretch) {
    const double usual = usual_uncertainty(stretch);
    if (usual < unsure * spacing_) return std::nullopt;
    // Where most vertices are on no surfaces, those that are may be on others than their neighbours.
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
      const double known_to = std::max(uncertainty_[i], usual) / spacing_;
      weights_[i] = 1 / (known_to * known_to);
    }
    const StraightLine fitted = best_line(stretch);
    const double way =
        dot(difference(line_.vertices[stretch.last], line_.vertices[stretch.first]), fitted.direction);
    if (std::abs(way) < shortest_stretch * spacing_) return std::nullopt;
    double squares = 0;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
      const double off = distance(line_.vertices[i], fitted.foot(line_.vertices[i])) / spacing_;
      if (off * off * weights_[i] > 9) return std::nullopt;
      squares += off * off * weights_[i];
    }
    if (squares > static_cast<double>(stretch.last + 1 - stretch.first)) return std::nullopt;
    if (is_bent(stretch, fitted, std::abs(way))) return std::nullopt;
    return fitted;
  }

  /// The lower median.
  [[nodiscard]] double usual_uncertainty(const Stretch& stretch) const {
    std::vector<double> values(uncertainty_.begin() + static_cast<std::ptrdiff_t>(stretch.first),
                               uncertainty_.begin() + static_cast<std::ptrdiff_t>(stretch.last + 1));
    return lower_median(values);
  }

  [[nodiscard]] StraightLine best_line(const Stretch& stretch) const {
    const Point origin = line_.vertices[stretch.first];
    Point mean{0, 0, 0};
    double weights = 0;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
      mean = sum(mean, scaled(weights_[i], difference(line_.vertices[i], origin)));
      weights += weights_[i];
    }
    mean = scaled(1 / weights, mean);
    kernels::Symmetric3 scatter;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
      const Point offset = difference(difference(line_.vertices[i], origin), mean);
      kernels::add_square(scatter, scaled(1 / spacing_, offset), weights_[i]);
    }
    return {sum(origin, mean), kernels::eigen_decomposition(scatter).vectors[0]};
  }

  /// Whether a parabola explains half of what the line leaves, and rises visibly. Its term in t² is the
  /// Legendre polynomial, of which the straight line already has the first two.
  [[nodiscard]] bool is_bent(const Stretch& stretch, const StraightLine& fitted, double way) const {
    const double middle =
        0.5 * (dot(difference(line_.vertices[stretch.first], fitted.through), fitted.direction) +
               dot(difference(line_.vertices[stretch.last], fitted.through), fitted.direction));
    Point with_square{0, 0, 0};
    double square_of_square = 0;
    double squares = 0;
    for (std::size_t i = stretch.first; i <= stretch.last; ++i) {
      const Point& vertex = line_.vertices[i];
      const double t = 2 * (dot(difference(vertex, fitted.through), fitted.direction) - middle) / way;
      const double bend = t * t - 1.0 / 3;
      const Point off = scaled(1 / spacing_, difference(vertex, fitted.foot(vertex)));
      with_square = sum(with_square, scaled(weights_[i] * bend, off));
      square_of_square += weights_[i] * bend * bend;
      squares += weights_[i] * dot(off, off);
    }
    if (!(square_of_square > 0)) return false;
    const double rise = length(with_square) / square_of_square;
    return rise > small_rise && dot(with_square, with_square) / square_of_square > 0.5 * squares;
  }

  [[nodiscard]] std::size_t farthest_from_chord(const Stretch& stretch) const {
    const Point& start = line_.vertices[stretch.first];
    const Point chord = difference(line_.vertices[stretch.last], start);
    const double square = dot(chord, chord);
    std::size_t farthest = stretch.first + 1;
    double largest = -1;
    for (std::size_t i = stretch.first + 1; i < stretch.last; ++i) {
      const Point offset = difference(line_.vertices[i], start);
      const Point across =
          square > 0 ? difference(offset, scaled(dot(offset, chord) / square, chord)) : offset;
      if (dot(across, across) <= largest) continue;
      largest = dot(across, across);
      farthest = i;
    }
    return farthest;
  }

  void move(std::size_t i, const Point& there) {
    if (!line_.residual.empty())
      line_.residual[i] = std::max(line_.residual[i], distance(there, line_.vertices[i]));
    line_.vertices[i] = there;
    has_moved_ = true;
  }

  /// Drops those that would go back, or on past the end.
  void move_inner(const Stretch& stretch, const StraightLine& straight) {
    const Point start = line_.vertices[stretch.first];
    const double end = dot(difference(line_.vertices[stretch.last], start), straight.direction);
    double so_far = 0;
    for (std::size_t i = stretch.first + 1; i < stretch.last; ++i) {
      const double place = dot(difference(line_.vertices[i], start), straight.direction) / end;
      move(i, straight.foot(line_.vertices[i]));
      if (place > so_far && place < 1) so_far = place;
      else dropped_[i] = true;
    }
  }

  void leave_out_dropped() {
    const auto keep = [&](auto& values) {
      std::size_t kept = 0;
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!dropped_[i]) values[kept++] = values[i];
      values.resize(kept);
    };
    keep(line_.vertices);
    keep(line_.dihedral_deg);
    keep(line_.normals);
    keep(line_.residual);
    line_.fitted = {};
  }

  Polyline& line_;
  double spacing_;
  std::vector<double> uncertainty_;
  std::vector<double> weights_;  // of the stretch that is looked at, per square of a spacing
  std::vector<bool> dropped_;
  bool has_moved_ = false;
};

}  // namespace

FeatureGraph straighten_lines(const FeatureGraph& graph, double spacing) {
  validate(graph);
  FeatureGraph result = graph;
  std::vector<std::vector<StraightLine>> at_corner(graph.corners.size());
  for (Polyline& line : result.polylines) {
    if (line.closed) continue;
    const auto at_ends = Straightener(line, graph.corners, spacing).straighten();
    if (line.start_corner && at_ends[0]) at_corner[*line.start_corner].push_back(*at_ends[0]);
    if (line.end_corner && at_ends[1]) at_corner[*line.end_corner].push_back(*at_ends[1]);
  }
  for (std::size_t c = 0; c < result.corners.size(); ++c) {
    GraphCorner& corner = result.corners[c];
    if (at_corner[c].empty() || (corner.residual && *corner.residual < unsure_corner * spacing)) continue;
    const Point there = nearest_to_all(at_corner[c], corner.position);
    const double way = distance(there, corner.position);
    if (way > largest_corner_move * spacing) continue;
    corner.position = there;
    if (corner.residual) corner.residual = std::max(*corner.residual, way);
  }
  for (Polyline& line : result.polylines) {
    if (line.start_corner) line.vertices.front() = result.corners[*line.start_corner].position;
    if (line.end_corner && !line.closed) line.vertices.back() = result.corners[*line.end_corner].position;
  }
  return result;
}

}  // namespace keenline
