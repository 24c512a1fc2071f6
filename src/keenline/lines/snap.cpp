#include "keenline/lines/snap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/lines/arc_length.h"
#include "keenline/lines/sides.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths are in spacings.
constexpr double largest_residual = 0.35;    // of what is credible: see find_sides()
constexpr double least_determined = 0.0025;  // of the squares of unit normals: two that differ by 6 degrees
constexpr double least_step = 0.05;          // of a line from vertex to vertex
constexpr double far_apart = 3;              // of vertices that cannot have changed places
constexpr double neighbors = 3;              // along the line, whose sides are heard as well

using Sides = std::vector<std::optional<LineSides>>;  // of the vertices of a line

void check(const SnapOptions& options, double spacing) {
  const auto require = [](bool is_right, std::string_view name, double found, std::string_view expected) {
    if (!is_right) throw InvalidArgument(fmt::format("{}: found {}, expected {}", name, found, expected));
  };
  const auto is_positive = [](double x) { return x > 0 && std::isfinite(x); };
  require(is_positive(spacing), "spacing", spacing, "a number above 0");
  require(is_positive(options.largest_move), "largest move", options.largest_move, "a number above 0");
  require(is_positive(options.largest_corner_move), "largest move of a corner", options.largest_corner_move,
          "a number above 0");
  require(options.rounds >= 1 && options.rounds <= 10, "rounds", options.rounds, "1 to 10");
  require(options.sides.rim >= 0, "rim", options.sides.rim, "0 or more");
  require(options.sides.reach > options.sides.rim && std::isfinite(options.sides.reach), "reach",
          options.sides.reach, "more than rim");
  require(is_positive(options.sides.stretch), "stretch", options.sides.stretch, "a number above 0");
}

/// A place and by how much surfaces miss it.
struct Meeting {
  Point place;
  double residual;  // root mean square
};

/// Root mean square distance of a place from surfaces.
double miss_of(const Point& place, std::span<const SideSurface> surfaces) {
  double squares = 0;
  for (const SideSurface& surface : surfaces) {
    const double miss = surface.distance(surface.offset_of(place)) * surface.spacing;
    squares += miss * miss;
  }
  return std::sqrt(squares / static_cast<double>(surfaces.size()));
}

/// From a place towards where surfaces meet, by Gauss and Newton: the shortest way among those that come as
/// near to all of them. Surfaces that lie apart from the others count less (Cauchy's weights).
Meeting meet(const Point& start, std::span<const SideSurface> surfaces, double spacing) {
  Point place = start;
  constexpr int steps = 8;
  for (int step = 0; step < steps; ++step) {
    kernels::Symmetric3 normals;
    Point pull{};
    for (const SideSurface& surface : surfaces) {
      const Point offset = surface.offset_of(place);
      const Point normal = surface.normal(offset);
      const double miss = surface.distance(offset) * (surface.spacing / spacing);
      const double weight = 1 / (1 + miss * miss / (largest_residual * largest_residual));
      const Point n = scaled(std::sqrt(weight), normal);
      kernels::add_outer_product(normals, n[0], n[1], n[2]);
      pull = sum(pull, scaled(-weight * miss, normal));
    }
    const kernels::Eigen3 axes = kernels::eigen_decomposition(normals);
    const double trace = axes.values[0] + axes.values[1] + axes.values[2];
    Point way{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!(axes.values[axis] > least_determined * trace)) continue;
      way = sum(way, scaled(dot(axes.vectors[axis], pull) / axes.values[axis], axes.vectors[axis]));
    }
    place = sum(place, scaled(spacing, way));
  }
  return {place, miss_of(place, surfaces)};
}

std::vector<SideSurface> surfaces_of(const LineSides& sides) {
  return {sides.left.surface, sides.right.surface};
}

/// What is left of a line after it has moved.
struct Moved {
  Polyline line;
  std::vector<Point> traced;  // where its vertices were at first
  Sides sides;
  KnownSides known;
};

/// Numbers of the vertices that lie ahead of the ones before them. Of two in the wrong order the one goes
/// that moved farther; the ends of an open line stay.
std::vector<std::size_t> ones_in_order(const Polyline& before, const Polyline& after, double spacing) {
  const ArcLength arc(before);
  const std::size_t count = after.vertices.size();
  const auto is_ahead = [&](std::size_t i, std::size_t j) {
    const Point way = difference(after.vertices[j], after.vertices[i]);
    if (dot(way, way) > far_apart * far_apart * spacing * spacing) return true;  // and may be round a bend
    const double step = least_step * spacing;
    return dot(way, arc.direction(arc.at(i), far_apart * spacing)) > step &&
           dot(way, arc.direction(arc.at(j), far_apart * spacing)) > step;
  };
  const auto moved = [&](std::size_t i) { return distance(before.vertices[i], after.vertices[i]); };
  std::vector<std::size_t> kept{0};
  for (std::size_t i = 1; i < count; ++i) {
    const bool is_end = !after.closed && i == count - 1;
    while (kept.size() > 1 && !is_ahead(kept.back(), i) && (is_end || moved(kept.back()) > moved(i)))
      kept.pop_back();
    if (is_end || is_ahead(kept.back(), i)) kept.push_back(i);
  }
  while (after.closed && kept.size() > 1 && !is_ahead(kept.back(), 0)) kept.pop_back();
  return kept;
}

template <typename T>
void keep_only(std::vector<T>& values, const std::vector<std::size_t>& kept) {
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

class Snapping {
 public:
  Snapping(const FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search, double spacing,
           const SnapOptions& options, Progress& progress)
      : graph_(graph),
        first_corners_(graph.corners),
        cloud_(cloud),
        search_(search),
        spacing_(spacing),
        options_(options),
        progress_(progress) {
    for (const Polyline& line : graph.polylines) lines_.push_back({line, line.vertices, {}, {}});
  }

  FeatureGraph run() {
    for (int round = 0; round < options_.rounds; ++round) {
      std::size_t vertices = 0;
      for (const Moved& moved : lines_) vertices += moved.line.vertices.size();
      progress_.begin("snapping", vertices);
      tbb::parallel_for(std::size_t{0}, lines_.size(), [&](std::size_t i) {
        Moved& moved = lines_[i];
        moved.sides =
            sides_along(moved.line, cloud_, search_, spacing_, options_.sides, progress_, &moved.known);
      });
      move_corners();
      tbb::parallel_for(std::size_t{0}, lines_.size(), [&](std::size_t i) { move(lines_[i]); });
    }
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      finish(lines_[i]);
      graph_.polylines[i] = std::move(lines_[i].line);
    }
    return std::move(graph_);
  }

 private:
  void move_corners() {
    std::vector<std::vector<SideSurface>> surfaces(graph_.corners.size());
    const auto add = [&](const std::optional<std::uint32_t>& corner, const std::optional<LineSides>& sides) {
      if (!corner || !sides) return;
      for (const SideSurface& surface : surfaces_of(*sides)) surfaces[*corner].push_back(surface);
    };
    for (const Moved& moved : lines_) {
      add(moved.line.start_corner, moved.sides.front());
      add(moved.line.end_corner, moved.sides.back());
    }
    for (std::size_t c = 0; c < surfaces.size(); ++c) {
      progress_.check();
      if (surfaces[c].empty()) continue;
      GraphCorner& corner = graph_.corners[c];
      const Point& first = first_corners_[c].position;
      const Meeting meeting = meet(corner.position, surfaces[c], spacing_);
      const bool is_credible = distance(meeting.place, first) <= options_.largest_corner_move * spacing_ &&
                               meeting.residual <= largest_residual * spacing_;
      corner.position = is_credible ? meeting.place : first;
      corner.residual = is_credible ? meeting.residual : miss_of(first, surfaces[c]);
    }
  }

  void move(Moved& moved) const {
    const Polyline before = moved.line;
    const ArcLength arc(before);
    Polyline& line = moved.line;
    for (std::size_t i = 0; i < line.vertices.size(); ++i) {
      progress_.check();
      if (!moved.sides[i]) continue;
      const Meeting meeting = meet(line.vertices[i], surfaces_around(i, arc, before, moved.sides), spacing_);
      const bool is_credible = distance(meeting.place, moved.traced[i]) <= options_.largest_move * spacing_ &&
                               meeting.residual <= largest_residual * spacing_;
      line.vertices[i] = is_credible ? meeting.place : moved.traced[i];
    }
    if (line.start_corner) line.vertices.front() = graph_.corners[*line.start_corner].position;
    if (line.end_corner && !line.closed) line.vertices.back() = graph_.corners[*line.end_corner].position;

    const std::vector<std::size_t> kept = ones_in_order(before, line, spacing_);
    if (kept.size() < (line.closed ? 3U : 2U)) return;
    keep_only(line.vertices, kept);
    keep_only(moved.traced, kept);
    keep_only(moved.sides, kept);
  }

  /// The sides of a vertex and those near it along the line: one of them may be mistaken.
  [[nodiscard]] std::vector<SideSurface> surfaces_around(std::size_t i, const ArcLength& arc,
                                                         const Polyline& line, const Sides& sides) const {
    const std::size_t count = sides.size();
    std::vector<SideSurface> surfaces = surfaces_of(*sides[i]);
    const auto listen_to = [&](std::size_t j) {
      double way = std::abs(arc.at(i) - arc.at(j));
      if (line.closed) way = std::min(way, arc.total() - way);
      if (way > neighbors * spacing_) return false;
      if (!sides[j]) return true;
      for (const SideSurface& surface : surfaces_of(*sides[j])) surfaces.push_back(surface);
      return true;
    };
    for (std::size_t step = 1; step < count; ++step) {
      if (!line.closed && step > i) break;
      if (!listen_to((i + count - step) % count)) break;
    }
    for (std::size_t step = 1; step < count; ++step) {
      if (!line.closed && i + step >= count) break;
      if (!listen_to((i + step) % count)) break;
    }
    return surfaces;
  }

  static void finish(Moved& moved) {
    Polyline& line = moved.line;
    line.fitted = {};
    describe(line, moved.sides);
    for (std::size_t i = 0; i < line.residual.size(); ++i) {
      if (!moved.sides[i]) continue;
      line.residual[i] = std::max(line.residual[i], miss_of(line.vertices[i], surfaces_of(*moved.sides[i])));
    }
  }

  FeatureGraph graph_;
  std::vector<GraphCorner> first_corners_;
  std::vector<Moved> lines_;
  const PointCloud& cloud_;
  const NeighborSearch& search_;
  double spacing_;
  const SnapOptions& options_;
  Progress& progress_;
};

}  // namespace

FeatureGraph snap_lines(const FeatureGraph& graph, const PointCloud& cloud, const NeighborSearch& search,
                        double spacing, const SnapOptions& options, Progress& progress) {
  check(options, spacing);
  validate(graph);
  return Snapping(graph, cloud, search, spacing, options, progress).run();
}

}  // namespace keenline
