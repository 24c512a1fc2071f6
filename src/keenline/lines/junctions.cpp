#include "keenline/lines/junctions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "keenline/lines/ends.h"
#include "keenline/lines/foot_grid.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// Lengths in spacings of the points around.
constexpr std::size_t fewest_feet = 3;  // of a path
constexpr double passes = 1.25;         // a line that passes a corner this closely goes through it
constexpr double clear = 2;             // a foot this far from a corner hardly sees past it
constexpr double same_corner = 1.5;     // corners this close to each other are one
constexpr double stray = 2.5;           // a loose end this close to a corner belongs to it
constexpr double trimmed = 1;           // feet nearer than this to a corner have seen past it

double length_of(const Path& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.feet.size(); ++i)
    length += distance(path.feet[i - 1].position, path.feet[i].position);
  return length;
}

/// In spacings of the points around.
double relative_length(const Path& path) {
  return path.feet.empty() ? 0 : length_of(path) * path.unit / path.feet.front().scale;
}

void remove_empty(std::vector<Path>& paths) {
  paths.erase(std::remove_if(paths.begin(), paths.end(), [](const Path& path) { return path.feet.empty(); }),
              paths.end());
}

/// The feet at an end that satisfy the predicate go, up to the first that does not.
template <typename Predicate>
void drop_feet(std::vector<Foot>& feet, bool at_back, const Predicate& goes) {
  if (at_back) {
    feet.erase(std::find_if_not(feet.rbegin(), feet.rend(), goes).base(), feet.end());
  } else {
    feet.erase(feet.begin(), std::find_if_not(feet.begin(), feet.end(), goes));
  }
}

/// Feet go that are less than `margin` before a limit, or past it.
void take_back(std::vector<Foot>& feet, bool at_back, const Point& limit, double margin) {
  drop_feet(feet, at_back, [&](const Foot& foot) {
    const Point ahead = scaled(at_back ? 1 : -1, difference(limit, foot.position));
    return dot(ahead, foot.tangent) < margin * foot.scale && length(ahead) < 2 * line_reach * foot.scale;
  });
}

void reverse(Path& path) {
  std::reverse(path.feet.begin(), path.feet.end());
  for (Foot& foot : path.feet) foot.tangent = scaled(-1, foot.tangent);
}

/// Makes one path of two whose ends face each other, or closes the one that both belong to.
void join(std::vector<Path>& paths, const PathEnd& a, const PathEnd& b) {
  constexpr double margin = 0.25;  // where the two overlap, they must not zigzag
  const Point middle = scaled(0.5, sum(foot_at(paths, a).position, foot_at(paths, b).position));
  Path& first = paths[a.path];
  Path& second = paths[b.path];
  if (&first == &second) {
    take_back(first.feet, true, middle, margin);
    take_back(first.feet, false, middle, margin);
    first.closed = true;
    return;
  }
  if (!a.at_back) reverse(first);
  if (b.at_back) reverse(second);
  take_back(first.feet, true, middle, margin);
  take_back(second.feet, false, middle, margin);
  first.feet.insert(first.feet.end(), second.feet.begin(), second.feet.end());
  second.feet.clear();
}

/// \pre two ends, of paths that have feet
bool is_gap(const std::vector<Path>& paths, const std::vector<PathEnd>& ends) {
  if (paths[ends[0].path].kind != paths[ends[1].path].kind) return false;
  return dot(ray_from(paths, ends[0]).direction, ray_from(paths, ends[1]).direction) < -smooth_turn;
}

/// Closes the gaps in lines. Each join moves the ends of a path: the others wait for the next round.
void close_gaps(std::vector<Path>& paths, const Progress& progress) {
  for (bool changed = true; changed;) {
    progress.check();
    changed = false;
    std::vector<bool> touched(paths.size(), false);
    for (const std::vector<PathEnd>& ends : gather_ends(paths)) {
      // Those that a join of this round has moved or emptied have no end to look at.
      if (ends.size() != 2 || touched[ends[0].path] || touched[ends[1].path]) continue;
      if (!is_gap(paths, ends)) continue;
      touched[ends[0].path] = touched[ends[1].path] = true;
      join(paths, ends[0], ends[1]);
      changed = true;
    }
    remove_empty(paths);
  }
}

/// A place where a path passes a corner: that foot is the nearest.
struct Passage {
  std::size_t path;
  std::size_t foot;
};

struct Corner {
  CommonPoint at;
  std::vector<PathEnd> ends;
  std::vector<Passage> passages;
};

/// Finds the corners of paths.
class CornerFinder {
 public:
  /// Paths shorter than this have a corner only with ends of other paths.
  CornerFinder(const std::vector<Path>& paths, double shortest) : paths_(paths), shortest_(shortest) {
    for (std::size_t p = 0; p < paths.size(); ++p)
      for (std::size_t f = 0; f < paths[p].feet.size(); ++f)
        grid_.insert({p, static_cast<std::ptrdiff_t>(f), paths[p].feet[f]});
  }

  [[nodiscard]] std::vector<Corner> find(const Progress& progress) const {
    std::vector<Corner> corners;
    FootGrid places;
    for (std::vector<PathEnd>& ends : gather_ends(paths_)) {
      progress.check();
      std::vector<const Foot*> feet;
      feet.reserve(ends.size() + 1);
      for (const PathEnd& end : ends) feet.push_back(&foot_at(paths_, end));
      if (ends.size() == 1) {
        const Foot* const ahead = line_ahead(ends[0]);
        if (ahead == nullptr) continue;
        feet.push_back(ahead);
      }
      Corner corner{common_point(feet), std::move(ends), {}};
      settle(corner);
      const auto same = corner_near(places, corner.at.position, same_corner * feet[0]->scale);
      if (same) {
        corners[*same].ends.insert(corners[*same].ends.end(), corner.ends.begin(), corner.ends.end());
        settle(corners[*same]);
        continue;
      }
      Foot place;
      place.position = corner.at.position;
      places.insert({corners.size(), 0, place});
      corners.push_back(std::move(corner));
    }
    attach_strays(corners, places);
    return corners;
  }

 private:
  /// Which lines pass the corner, and where all of its lines come together.
  void settle(Corner& corner) const {
    corner.passages = passages_at(corner);
    corner.at = common_point(clear_feet(corner));
  }

  /// The corner nearest to a position, by the place where it was first.
  [[nodiscard]] static std::optional<std::size_t> corner_near(const FootGrid& places, const Point& position,
                                                              double reach) {
    std::optional<std::size_t> nearest;
    places.near(position, reach, [&](const FootGrid::Entry& entry) {
      const double d = distance(entry.foot.position, position);
      if (d >= reach) return;
      reach = d;
      nearest = entry.path;
    });
    return nearest;
  }

  /// The last feet of a walk have seen past the corner, and may point past it. So a loose end belongs to a
  /// corner that is close to it in any direction, or ahead.
  void attach_strays(std::vector<Corner>& corners, const FootGrid& places) const {
    std::vector<std::array<bool, 2>> is_loose(paths_.size(), {true, true});
    for (const Corner& corner : corners)
      for (const PathEnd& end : corner.ends) is_loose[end.path][end.at_back ? 1 : 0] = false;
    for (std::size_t p = 0; p < paths_.size(); ++p) {
      if (paths_[p].closed || relative_length(paths_[p]) < shortest_) continue;
      for (const bool at_back : {false, true}) {
        if (!is_loose[p][at_back ? 1 : 0]) continue;
        const Ray ray = ray_from(paths_, {p, at_back});
        auto corner = corner_near(places, ray.start, stray * ray.scale);
        const Point ahead = sum(ray.start, scaled(line_reach * ray.scale, ray.direction));
        if (!corner) corner = corner_near(places, ahead, stray * ray.scale);
        if (!corner) continue;
        corners[*corner].ends.push_back({p, at_back});
        settle(corners[*corner]);
      }
    }
  }

  /// The place on another line that an end runs into.
  [[nodiscard]] const Foot* line_ahead(const PathEnd& end) const {
    if (relative_length(paths_[end.path]) < shortest_) return nullptr;
    const Ray ray = ray_from(paths_, end);
    const Foot* found = nullptr;
    double nearest = line_reach * ray.scale;
    grid_.near(ray.start, (line_reach + 2) * ray.scale, [&](const FootGrid::Entry& entry) {
      const Foot& foot = entry.foot;
      if (entry.path == end.path || std::abs(dot(foot.tangent, ray.direction)) > parallel) return;
      const Approach at = approach_of(ray, {foot.position, foot.tangent, foot.scale});
      if (at.miss > largest_miss * ray.scale || std::abs(at.second) > 0.75 * foot.scale) return;
      if (at.first < -line_overrun * ray.scale || at.first > nearest) return;
      nearest = at.first;
      found = &paths_[entry.path].feet[static_cast<std::size_t>(entry.place)];
    });
    return found;
  }

  /// The lines that pass the corner without ending there.
  [[nodiscard]] std::vector<Passage> passages_at(const Corner& corner) const {
    std::vector<std::pair<double, Passage>> nearest;  // of each path
    double scale = 0;
    for (const PathEnd& end : corner.ends) scale = std::max(scale, foot_at(paths_, end).scale);
    // Twice as far: the points around the lines that pass may be wider apart.
    grid_.near(corner.at.position, 2 * passes * scale, [&](const FootGrid::Entry& entry) {
      const double d = distance(entry.foot.position, corner.at.position);
      if (d > passes * entry.foot.scale) return;
      const auto is_it = [&](const PathEnd& end) { return end.path == entry.path; };
      if (std::any_of(corner.ends.begin(), corner.ends.end(), is_it)) return;
      const Passage passage{entry.path, static_cast<std::size_t>(entry.place)};
      const auto known = std::find_if(nearest.begin(), nearest.end(),
                                      [&](const auto& other) { return other.second.path == passage.path; });
      if (known == nearest.end()) nearest.emplace_back(d, passage);
      else if (d < known->first) *known = {d, passage};
    });
    std::vector<Passage> passages;
    passages.reserve(nearest.size());
    for (const auto& [d, passage] : nearest) passages.push_back(passage);
    return passages;
  }

  /// Of every line, to both sides where it passes, the foot nearest to the corner that does not see past it.
  [[nodiscard]] std::vector<const Foot*> clear_feet(const Corner& corner) const {
    std::vector<const Foot*> feet;
    const auto add = [&](const std::vector<Foot>& path, std::size_t i, bool forward) {
      const std::size_t last = forward ? path.size() - 1 : 0;
      while (i != last && distance(path[i].position, corner.at.position) < clear * path[i].scale)
        i = forward ? i + 1 : i - 1;
      feet.push_back(&path[i]);
    };
    for (const PathEnd& end : corner.ends) {
      const std::vector<Foot>& path = paths_[end.path].feet;
      add(path, end.at_back ? path.size() - 1 : 0, !end.at_back);
    }
    for (const Passage& passage : corner.passages) {
      add(paths_[passage.path].feet, passage.foot, true);
      add(paths_[passage.path].feet, passage.foot, false);
    }
    return feet;
  }

  const std::vector<Path>& paths_;
  double shortest_;
  FootGrid grid_;
};

/// A path from corner to corner, or to a loose end.
struct Piece {
  Path path;
  std::optional<std::size_t> start;
  std::optional<std::size_t> end;
};

/// Where one path meets corners.
struct Stops {
  struct Stop {
    std::size_t foot;
    std::size_t corner;
  };
  std::optional<std::size_t> start;
  std::optional<std::size_t> end;
  std::vector<Stop> between;
};

std::vector<Stops> stops_of(const std::vector<Path>& paths, const std::vector<Corner>& corners) {
  std::vector<Stops> stops(paths.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    for (const PathEnd& end : corners[c].ends)
      (end.at_back ? stops[end.path].end : stops[end.path].start) = c;
    for (const Passage& passage : corners[c].passages)
      stops[passage.path].between.push_back({passage.foot, c});
  }
  for (Stops& of_path : stops) {
    std::sort(of_path.between.begin(), of_path.between.end(), [](const Stops::Stop& a, const Stops::Stop& b) {
      return std::pair(a.foot, a.corner) < std::pair(b.foot, b.corner);
    });
  }
  return stops;
}

/// Cuts a path at its corners. A closed one is opened at the first.
void cut(Path path, Stops stops, std::vector<Piece>& pieces) {
  if (path.closed && !stops.between.empty()) {
    const Stops::Stop first = stops.between.front();
    std::rotate(path.feet.begin(), path.feet.begin() + static_cast<std::ptrdiff_t>(first.foot),
                path.feet.end());
    stops.between.erase(stops.between.begin());
    for (Stops::Stop& stop : stops.between) stop.foot -= first.foot;
    stops.start = stops.end = first.corner;
    path.closed = stops.between.empty();
  }
  Piece piece{{{}, path.closed, path.kind, path.unit}, stops.start, {}};
  std::size_t next = 0;
  for (const Stops::Stop& stop : stops.between) {
    for (; next <= stop.foot; ++next) piece.path.feet.push_back(path.feet[next]);
    piece.end = stop.corner;
    pieces.push_back(piece);
    piece = {{{}, false, path.kind, path.unit}, stop.corner, {}};
  }
  for (; next < path.feet.size(); ++next) piece.path.feet.push_back(path.feet[next]);
  piece.end = stops.end;
  if (!piece.path.feet.empty() || stops.end) pieces.push_back(std::move(piece));
}

/// Ends pieces where their corners begin. What leads to no corner ends where the detector saw it last.
void trim(Piece& piece, const std::vector<Corner>& corners) {
  std::vector<Foot>& feet = piece.path.feet;
  if (piece.path.closed && !piece.start) return;
  for (const bool at_back : {false, true}) {
    const std::optional<std::size_t>& corner = at_back ? piece.end : piece.start;
    if (corner) take_back(feet, at_back, corners[*corner].at.position, trimmed);
    else drop_feet(feet, at_back, [](const Foot& foot) { return !foot.is_backed; });
  }
}

std::vector<Piece> pieces_of(const std::vector<Path>& paths, const std::vector<Corner>& corners) {
  std::vector<Piece> pieces;
  const std::vector<Stops> stops = stops_of(paths, corners);
  for (std::size_t p = 0; p < paths.size(); ++p) cut(paths[p], stops[p], pieces);
  for (Piece& piece : pieces) trim(piece, corners);
  return pieces;
}

/// Too short for a line that leads nowhere.
bool is_noise(const Piece& piece, double min_length) {
  if (piece.path.closed) return piece.path.feet.size() < fewest_feet;
  const std::size_t corners = (piece.start ? 1U : 0U) + (piece.end ? 1U : 0U);
  if (piece.path.feet.size() + corners < 2) return true;
  const bool leads_on = piece.start && piece.end && piece.start != piece.end;
  return !leads_on && (piece.path.feet.empty() || relative_length(piece.path) < min_length);
}

Polyline polyline_of(const Piece& piece, const std::vector<Corner>& corners, const TraceFrame& frame) {
  Polyline line;
  line.kind = piece.path.kind;
  line.closed =
      piece.path.closed || (piece.start && piece.start == piece.end && piece.path.feet.size() >= fewest_feet);
  const auto add_corner = [&](std::optional<std::size_t> corner) {
    if (corner) line.vertices.push_back(frame.global(corners[*corner].at.position));
  };
  add_corner(piece.start);
  for (const Foot& foot : piece.path.feet) line.vertices.push_back(frame.global(foot.position));
  if (!line.closed) add_corner(piece.end);
  if (piece.start) line.start_corner = static_cast<std::uint32_t>(*piece.start);
  if (piece.end) line.end_corner = static_cast<std::uint32_t>(*piece.end);
  return line;
}

FeatureGraph graph_of(const std::vector<Piece>& pieces, const std::vector<Corner>& corners,
                      const TraceFrame& frame) {
  FeatureGraph graph;
  for (const Corner& corner : corners)
    graph.corners.push_back({frame.global(corner.at.position), corner.at.residual * frame.spacing});
  for (const Piece& piece : pieces) graph.polylines.push_back(polyline_of(piece, corners, frame));
  return graph;
}

}  // namespace

FeatureGraph connect_paths(std::vector<Path> paths, const TraceFrame& frame, double min_length,
                           const Progress& progress) {
  const auto is_scrap = [](const Path& path) { return path.feet.size() < fewest_feet; };
  paths.erase(std::remove_if(paths.begin(), paths.end(), is_scrap), paths.end());
  for (;;) {
    close_gaps(paths, progress);
    const std::vector<Corner> corners = CornerFinder(paths, min_length).find(progress);
    std::vector<Piece> pieces = pieces_of(paths, corners);
    const auto is_bad = [&](const Piece& piece) { return is_noise(piece, min_length); };
    if (std::none_of(pieces.begin(), pieces.end(), is_bad)) return graph_of(pieces, corners, frame);
    // Without the noise some corners are none, and gaps may be left where they were.
    paths.clear();
    for (Piece& piece : pieces)
      if (!is_bad(piece)) paths.push_back(std::move(piece.path));
    remove_empty(paths);
  }
}

}  // namespace keenline
