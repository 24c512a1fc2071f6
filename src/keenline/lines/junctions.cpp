#include "keenline/lines/junctions.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "keenline/kernels/symmetric3.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths in spacings of the points around. A walk may stop two windows' steps before a corner, or run past
// it by one: so far lines are prolonged, and taken back, to find where they meet.
constexpr double reach = 4;
constexpr double overrun = 2;
constexpr double largest_miss = 1;    // lines that pass each other this closely meet
constexpr double facing_reach = 6;    // a gap in a line, not longer than the shortest line
constexpr double parallel = 0.94;     // cosine of 20 degrees: where such lines meet is not to be told
constexpr double smooth_turn = 0.77;  // cosine of 40 degrees: two lines that turn less are one
constexpr double passes = 1.25;       // a line that passes a corner this closely goes through it
constexpr double clear = 2;           // a foot this far from a corner hardly sees past it
constexpr double trimmed = 1;         // feet this close to a corner have seen past it

struct End {
  std::size_t path;
  bool at_back;
};

const Foot& foot_of(const std::vector<Path>& paths, const End& end) {
  const std::vector<Foot>& feet = paths[end.path].feet;
  return end.at_back ? feet.back() : feet.front();
}

Point outward(const std::vector<Path>& paths, const End& end) {
  return scaled(end.at_back ? 1 : -1, foot_of(paths, end).tangent);
}

double length_of(const Path& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.feet.size(); ++i)
    length += distance(path.feet[i - 1].position, path.feet[i].position);
  return length;
}

struct Ray {
  Point start{};
  Point direction{};  // unit vector
  double scale = 1;
};

struct Approach {
  double first;   // along the first ray
  double second;  // along the second
  double miss;
};

/// Where two lines are nearest to each other. \pre they are not parallel
Approach approach_of(const Ray& a, const Ray& b) {
  const Point gap = difference(b.start, a.start);
  const double c = dot(a.direction, b.direction);
  const double on_a = dot(gap, a.direction);
  const double on_b = dot(gap, b.direction);
  const double first = (on_a - c * on_b) / (1 - c * c);
  const double second = (c * on_a - on_b) / (1 - c * c);
  const Point p = sum(a.start, scaled(first, a.direction));
  const Point q = sum(b.start, scaled(second, b.direction));
  return {first, second, distance(p, q)};
}

bool meet(const Ray& a, const Ray& b) {
  const double s = std::max(a.scale, b.scale);
  const Point gap = difference(b.start, a.start);
  const double c = dot(a.direction, b.direction);
  if (c > parallel) return false;
  if (c < -smooth_turn) {
    const double along = dot(gap, a.direction);
    const double aside = length(difference(gap, scaled(along, a.direction)));
    return along > -overrun * s && along < facing_reach * s &&
           aside < std::max(largest_miss * s, 0.3 * along);
  }
  const Approach at = approach_of(a, b);
  const double least = -overrun * s;
  const double most = reach * s;
  return at.miss < largest_miss * s && at.first > least && at.first < most && at.second > least &&
         at.second < most;
}

/// Which things belong together.
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The smallest member names the group.
  void unite(std::size_t i, std::size_t j) {
    const std::size_t a = find(i);
    const std::size_t b = find(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Ends that come together.
struct Junction {
  std::vector<End> ends;
  Point position{};
  double residual = 0;
};

Ray ray_of(const std::vector<Path>& paths, const End& end) {
  return {foot_of(paths, end).position, outward(paths, end), foot_of(paths, end).scale};
}

/// Every end of an open path, in exactly one junction; a loose one alone.
std::vector<Junction> junctions_of(const std::vector<Path>& paths) {
  std::vector<End> ends;
  FootGrid grid;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    if (paths[p].closed) continue;
    for (const bool at_back : {false, true}) {
      const End end{p, at_back};
      grid.insert({ends.size(), 0, foot_of(paths, end)});
      ends.push_back(end);
    }
  }
  Groups groups(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Ray ray = ray_of(paths, ends[i]);
    grid.near(ray.start, 2 * reach * ray.scale, [&](const FootGrid::Entry& entry) {
      const std::size_t j = entry.path;
      if (j == i) return;
      if (ends[i].path == ends[j].path && length_of(paths[ends[i].path]) < 3 * reach * ray.scale) return;
      if (meet(ray, ray_of(paths, ends[j]))) groups.unite(i, j);
    });
  }
  std::vector<Junction> junctions(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) junctions[groups.find(i)].ends.push_back(ends[i]);
  junctions.erase(std::remove_if(junctions.begin(), junctions.end(),
                                 [](const Junction& junction) { return junction.ends.empty(); }),
                  junctions.end());
  return junctions;
}

/// The feet that have passed `limit` in the direction of the end go.
void take_back(std::vector<Foot>& feet, bool at_back, const Point& limit, double margin) {
  const auto is_past = [&](const Foot& foot) {
    const Point out = scaled(at_back ? 1 : -1, foot.tangent);
    return dot(difference(limit, foot.position), out) < margin * foot.scale &&
           distance(limit, foot.position) < 2 * reach * foot.scale;
  };
  if (at_back) {
    while (!feet.empty() && is_past(feet.back())) feet.pop_back();
  } else {
    const auto first = std::find_if_not(feet.begin(), feet.end(), is_past);
    feet.erase(feet.begin(), first);
  }
}

/// What leads to no corner ends where the detector saw it last.
void forget_unbacked(std::vector<Foot>& feet, bool at_back) {
  const auto is_backed = [](const Foot& foot) { return foot.is_backed; };
  if (at_back) {
    while (!feet.empty() && !is_backed(feet.back())) feet.pop_back();
  } else {
    feet.erase(feet.begin(), std::find_if(feet.begin(), feet.end(), is_backed));
  }
}

void reverse(Path& path) {
  std::reverse(path.feet.begin(), path.feet.end());
  for (Foot& foot : path.feet) foot.tangent = scaled(-1, foot.tangent);
}

/// Makes one path of two whose ends face each other; or closes the one that both belong to.
void join(std::vector<Path>& paths, const End& a, const End& b) {
  const Point middle = scaled(0.5, sum(foot_of(paths, a).position, foot_of(paths, b).position));
  Path& first = paths[a.path];
  if (a.path == b.path) {
    take_back(first.feet, true, middle, 0.25);
    take_back(first.feet, false, middle, 0.25);
    first.closed = true;
    return;
  }
  Path& second = paths[b.path];
  if (!a.at_back) reverse(first);
  if (b.at_back) reverse(second);
  take_back(first.feet, true, middle, 0.25);
  take_back(second.feet, false, middle, 0.25);
  first.feet.insert(first.feet.end(), second.feet.begin(), second.feet.end());
  second.feet.clear();
}

bool is_smooth(const std::vector<Path>& paths, const Junction& junction) {
  return junction.ends.size() == 2 &&
         paths[junction.ends[0].path].kind == paths[junction.ends[1].path].kind &&
         dot(outward(paths, junction.ends[0]), outward(paths, junction.ends[1])) < -smooth_turn;
}

void remove_empty(std::vector<Path>& paths) {
  paths.erase(std::remove_if(paths.begin(), paths.end(), [](const Path& path) { return path.feet.empty(); }),
              paths.end());
}

/// Closes one gap after another: each join moves the ends of a path.
void close_gaps(std::vector<Path>& paths) {
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<bool> touched(paths.size(), false);
    for (const Junction& junction : junctions_of(paths)) {
      if (!is_smooth(paths, junction)) continue;
      const End& a = junction.ends[0];
      const End& b = junction.ends[1];
      if (touched[a.path] || touched[b.path]) continue;
      touched[a.path] = touched[b.path] = true;
      join(paths, a, b);
      changed = true;
    }
    remove_empty(paths);
  }
}

/// Where the planes of the feet come together: least squares, drawn weakly to the mean of the feet where
/// they leave it open.
Point common_point(const std::vector<const Foot*>& feet, double& residual) {
  Point mean{};
  for (const Foot* foot : feet)
    mean = sum(mean, scaled(1 / static_cast<double>(feet.size()), foot->position));
  kernels::Symmetric3 matrix;
  Point right{};
  for (const Foot* foot : feet) {
    for (const Point& normal : foot->normals) {
      add_square(matrix, normal, 1);
      right = sum(right, scaled(dot(normal, difference(foot->position, mean)), normal));
    }
  }
  const kernels::Eigen3 eigen = kernels::eigen_decomposition(matrix);
  const double draw = 0.001 * static_cast<double>(feet.size());
  Point offset{};
  for (std::size_t i = 0; i < 3; ++i)
    offset = sum(offset, scaled(dot(eigen.vectors[i], right) / (eigen.values[i] + draw), eigen.vectors[i]));
  double squares = 0;
  for (const Foot* foot : feet) {
    for (const Point& normal : foot->normals) {
      const double miss = dot(normal, difference(difference(foot->position, mean), offset));
      squares += miss * miss;
    }
  }
  residual = std::sqrt(squares / (2 * static_cast<double>(feet.size())));
  return sum(mean, offset);
}

/// A place where a path is cut: before foot `at` comes the corner.
struct Cut {
  std::size_t path;
  std::size_t foot;
};

struct Corner {
  Point position{};
  double residual = 0;
  std::vector<End> ends;
  std::vector<Cut> cuts;
};

class Connector {
 public:
  Connector(std::vector<Path>&& paths, double shortest) : paths_(std::move(paths)), shortest_(shortest) {
    for (std::size_t p = 0; p < paths_.size(); ++p)
      for (std::size_t f = 0; f < paths_[p].feet.size(); ++f)
        grid_.insert({p, static_cast<std::ptrdiff_t>(f), paths_[p].feet[f]});
  }

  void find_corners() {
    for (const Junction& junction : junctions_of(paths_)) {
      Corner corner;
      corner.ends = junction.ends;
      std::vector<const Foot*> feet;
      for (const End& end : junction.ends) feet.push_back(&foot_of(paths_, end));
      if (feet.size() == 1) {
        if (length_of(paths_[junction.ends[0].path]) < shortest_ * feet[0]->scale) continue;
        const auto hit = line_ahead(junction.ends[0]);
        if (!hit) continue;
        feet.push_back(&paths_[hit->path].feet[hit->foot]);
      }
      corner.position = common_point(feet, corner.residual);
      corner.cuts = cuts_at(corner);
      corner.position = common_point(clear_feet(corner), corner.residual);
      corners_.push_back(std::move(corner));
    }
  }

  std::vector<Path> paths_;
  std::vector<Corner> corners_;

 private:
  /// The line that an end runs into.
  [[nodiscard]] std::optional<Cut> line_ahead(const End& end) const {
    const Ray ray = ray_of(paths_, end);
    std::optional<Cut> best;
    double nearest = reach * ray.scale;
    grid_.near(ray.start, 1.5 * reach * ray.scale, [&](const FootGrid::Entry& entry) {
      if (entry.path == end.path) return;
      const Ray other{entry.foot.position, entry.foot.tangent, entry.foot.scale};
      if (std::abs(dot(other.direction, ray.direction)) > parallel) return;
      const Approach at = approach_of(ray, other);
      if (at.miss > largest_miss * ray.scale || at.first < -overrun * ray.scale || at.first > nearest) return;
      if (std::abs(at.second) > 0.75 * other.scale) return;
      nearest = at.first;
      best = Cut{entry.path, static_cast<std::size_t>(entry.place)};
    });
    return best;
  }

  /// Of every line, to both sides where it passes, the foot that is nearest to the corner and does not see
  /// far beyond it.
  [[nodiscard]] std::vector<const Foot*> clear_feet(const Corner& corner) const {
    std::vector<const Foot*> feet;
    const auto add = [&](const std::vector<Foot>& path, std::size_t from, bool forward) {
      std::size_t i = from;
      const auto is_clear = [&] {
        return distance(path[i].position, corner.position) >= clear * path[i].scale;
      };
      const std::size_t last = forward ? path.size() - 1 : 0;
      while (i != last && !is_clear()) i = forward ? i + 1 : i - 1;
      feet.push_back(&path[i]);
    };
    for (const End& end : corner.ends) {
      const std::vector<Foot>& path = paths_[end.path].feet;
      add(path, end.at_back ? path.size() - 1 : 0, !end.at_back);
    }
    for (const Cut& cut : corner.cuts) {
      add(paths_[cut.path].feet, cut.foot, true);
      add(paths_[cut.path].feet, cut.foot, false);
    }
    return feet;
  }

  /// The lines that pass the corner without ending there.
  [[nodiscard]] std::vector<Cut> cuts_at(const Corner& corner) const {
    std::vector<std::pair<Cut, double>> nearest;  // of each path
    grid_.near(corner.position, 2, [&](const FootGrid::Entry& entry) {
      const double d = distance(entry.foot.position, corner.position);
      if (d > passes * entry.foot.scale) return;
      for (const End& end : corner.ends)
        if (end.path == entry.path) return;
      const Cut cut{entry.path, static_cast<std::size_t>(entry.place)};
      const auto known = std::find_if(nearest.begin(), nearest.end(),
                                      [&](const auto& other) { return other.first.path == cut.path; });
      if (known == nearest.end()) nearest.emplace_back(cut, d);
      else if (d < known->second) *known = {cut, d};
    });
    std::vector<Cut> cuts;
    for (const auto& [cut, d] : nearest) cuts.push_back(cut);
    return cuts;
  }

  FootGrid grid_;
  double shortest_;
};

/// A part of a path between two corners, or its loose end.
struct Piece {
  Path path;
  std::optional<std::size_t> start;
  std::optional<std::size_t> end;
};

/// Cuts the paths at the corners.
std::vector<Piece> pieces_of(const std::vector<Path>& paths, const std::vector<Corner>& corners) {
  struct Place {
    std::size_t foot;
    std::size_t corner;
  };
  std::vector<std::optional<std::size_t>> starts(paths.size());
  std::vector<std::optional<std::size_t>> ends(paths.size());
  std::vector<std::vector<Place>> cuts(paths.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const End& end : corners[c].ends) (end.at_back ? ends : starts)[end.path] = c;
    for (const Cut& cut : corners[c].cuts) cuts[cut.path].push_back({cut.foot, c});
  }
  std::vector<Piece> pieces;
  for (std::size_t p = 0; p < paths.size(); ++p) {
    Path path = paths[p];
    auto& places = cuts[p];
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return a.foot < b.foot || (a.foot == b.foot && a.corner < b.corner);
    });
    if (path.closed && !places.empty()) {
      // Opened at the first corner.
      const std::size_t first = places[0].foot;
      std::rotate(path.feet.begin(), path.feet.begin() + static_cast<std::ptrdiff_t>(first), path.feet.end());
      for (Place& place : places) place.foot -= first;
      starts[p] = ends[p] = places[0].corner;
      places.erase(places.begin());
      path.closed = places.empty();
    }
    std::size_t begin = 0;
    std::optional<std::size_t> start = starts[p];
    for (const Place& place : places) {
      Piece piece{{{}, false, path.kind}, start, place.corner};
      piece.path.feet.assign(path.feet.begin() + static_cast<std::ptrdiff_t>(begin),
                             path.feet.begin() + static_cast<std::ptrdiff_t>(place.foot + 1));
      pieces.push_back(std::move(piece));
      begin = place.foot;
      start = place.corner;
    }
    Piece last{{{}, path.closed, path.kind}, start, ends[p]};
    last.path.feet.assign(path.feet.begin() + static_cast<std::ptrdiff_t>(begin), path.feet.end());
    pieces.push_back(std::move(last));
  }
  for (Piece& piece : pieces) {
    if (piece.path.closed && !piece.start) continue;
    if (!piece.start) forget_unbacked(piece.path.feet, false);
    if (!piece.end) forget_unbacked(piece.path.feet, true);
    if (piece.start) take_back(piece.path.feet, false, corners[*piece.start].position, trimmed);
    if (piece.end) take_back(piece.path.feet, true, corners[*piece.end].position, trimmed);
  }
  return pieces;
}

Polyline polyline_of(const Piece& piece, const std::vector<Corner>& corners, const TraceFrame& frame) {
  Polyline line;
  line.kind = piece.path.kind;
  line.closed = piece.path.closed;
  if (piece.start) line.vertices.push_back(frame.global(corners[*piece.start].position));
  for (const Foot& foot : piece.path.feet) line.vertices.push_back(frame.global(foot.position));
  if (piece.end && !piece.path.closed) line.vertices.push_back(frame.global(corners[*piece.end].position));
  if (piece.start) line.start_corner = static_cast<std::uint32_t>(*piece.start);
  if (piece.end) line.end_corner = static_cast<std::uint32_t>(*piece.end);
  return line;
}

bool is_noise(const Piece& piece, double min_length) {
  if (piece.path.closed) return piece.path.feet.size() < 3;
  const bool is_loose = !piece.start || !piece.end || piece.start == piece.end;
  return is_loose &&
         length_of(piece.path) < min_length * (piece.path.feet.empty() ? 1 : piece.path.feet[0].scale);
}

}  // namespace

FeatureGraph connect_paths(std::vector<Path> paths, const TraceFrame& frame, double min_length) {
  constexpr std::size_t fewest_feet = 3;
  paths.erase(std::remove_if(paths.begin(), paths.end(),
                             [](const Path& path) { return path.feet.size() < fewest_feet; }),
              paths.end());
  for (;;) {
    close_gaps(paths);
    Connector connector(std::move(paths), min_length);
    connector.find_corners();
    std::vector<Piece> pieces = pieces_of(connector.paths_, connector.corners_);
    const auto is_bad = [&](const Piece& piece) { return is_noise(piece, min_length); };
    if (std::none_of(pieces.begin(), pieces.end(), is_bad)) {
      FeatureGraph graph;
      for (const Corner& corner : connector.corners_)
        graph.corners.push_back({frame.global(corner.position), corner.residual * frame.spacing});
      for (const Piece& piece : pieces)
        graph.polylines.push_back(polyline_of(piece, connector.corners_, frame));
      return graph;
    }
    paths.clear();
    for (Piece& piece : pieces)
      if (!is_bad(piece)) paths.push_back(std::move(piece.path));
    paths.erase(
        std::remove_if(paths.begin(), paths.end(), [](const Path& path) { return path.feet.empty(); }),
        paths.end());
  }
}

}  // namespace keenline
