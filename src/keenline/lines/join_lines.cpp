#include "keenline/lines/join_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

// In spacings.
constexpr double widest_gap = 6;  // that tracers bridge as well
constexpr double widest_overlap = 1;
constexpr double largest_offset = 0.35;
constexpr double reach = 2;  // along which an end's direction is taken

constexpr double cosine_of_10_degrees = 0.98480775301220802;
constexpr int ends_nearby = 9;  // itself among them
constexpr std::uint32_t none = 0xFFFF'FFFFU;

/// Ends 2 i and 2 i + 1 are the start and the end of line i.
struct End {
  Point position{};
  Point outward{};  // unit vector
};

std::size_t line_of(std::uint32_t end) { return end / 2; }
std::uint32_t other_end(std::uint32_t end) { return end ^ 1U; }

std::optional<End> loose_end(const Polyline& line, bool at_start, double spacing) {
  if (line.closed || (at_start ? line.start_corner : line.end_corner)) return std::nullopt;
  const std::vector<Point>& vertices = line.vertices;
  const auto vertex = [&](std::size_t i) {
    return at_start ? vertices[i] : vertices[vertices.size() - 1 - i];
  };
  const Point end = vertex(0);
  std::size_t inner = 1;
  while (inner + 1 < vertices.size() && distance(end, vertex(inner)) < reach * spacing) ++inner;
  const Point outward = difference(end, vertex(inner));
  if (!(length(outward) > 0)) return std::nullopt;
  return End{end, unit(outward)};
}

bool face_each_other(const End& a, const End& b, double spacing) {
  const Point across = difference(b.position, a.position);
  if (!(length(across) <= widest_gap * spacing)) return false;
  if (dot(a.outward, b.outward) > -cosine_of_10_degrees) return false;
  const auto is_ahead = [&](const Point& outward, const Point& gap) {
    const double along = dot(gap, outward);
    const Point offset = difference(gap, scaled(along, outward));
    return along >= -widest_overlap * spacing && length(offset) <= largest_offset * spacing;
  };
  return is_ahead(a.outward, across) && is_ahead(b.outward, scaled(-1, across));
}

/// For each end the one that it is joined to, or none.
std::vector<std::uint32_t> partners_of(const std::vector<Polyline>& lines, double spacing) {
  std::vector<std::uint32_t> numbers;
  std::vector<End> ends;
  std::vector<Point> positions;
  for (std::uint32_t end = 0; end < 2 * lines.size(); ++end) {
    const auto found = loose_end(lines[line_of(end)], end % 2 == 0, spacing);
    if (!found) continue;
    numbers.push_back(end);
    ends.push_back(*found);
    positions.push_back(found->position);
  }
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> pairs;  // of places in `ends`, by gap
  const NeighborSearch search(positions);
  for (std::uint32_t a = 0; a < ends.size(); ++a) {
    for (const std::uint32_t b : search.nearest_to(positions[a], ends_nearby)) {
      if (a == b) continue;
      if (lines[line_of(numbers[a])].kind != lines[line_of(numbers[b])].kind) continue;
      if (!face_each_other(ends[a], ends[b], spacing)) continue;
      pairs.emplace_back(distance(positions[a], positions[b]), std::min(a, b), std::max(a, b));
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<std::uint32_t> partners(2 * lines.size(), none);
  for (const auto& [gap, a, b] : pairs) {
    if (partners[numbers[a]] != none || partners[numbers[b]] != none) continue;
    partners[numbers[a]] = numbers[b];
    partners[numbers[b]] = numbers[a];
  }
  return partners;
}

Polyline reversed(Polyline line) {
  std::reverse(line.vertices.begin(), line.vertices.end());
  std::reverse(line.dihedral_deg.begin(), line.dihedral_deg.end());
  std::reverse(line.residual.begin(), line.residual.end());
  std::reverse(line.normals.begin(), line.normals.end());
  for (SideNormals& sides : line.normals) std::swap(sides.left, sides.right);
  std::swap(line.start_corner, line.end_corner);
  return line;
}

/// Adds what is known of the vertices from `first` on; where only one of both knows something, nobody does.
template <typename T>
void append(std::vector<T>& values, const std::vector<T>& more, std::size_t first) {
  if (values.empty() || more.empty()) values.clear();
  else values.insert(values.end(), std::next(more.begin(), static_cast<std::ptrdiff_t>(first)), more.end());
}

/// Adds the vertices of `next` but for those that the overlap puts behind the last one of `line`; one at
/// least.
void append(Polyline& line, const Polyline& next, double spacing) {
  const Point last = line.vertices.back();
  const auto end = loose_end(line, false, spacing);
  const auto is_behind = [&](const Point& p) {
    const Point step = difference(p, last);
    return end && dot(step, end->outward) <= 0 && length(step) <= 2 * widest_overlap * spacing;
  };
  std::size_t first = 0;
  while (first + 1 < next.vertices.size() && is_behind(next.vertices[first])) ++first;
  append(line.vertices, next.vertices, first);
  append(line.dihedral_deg, next.dihedral_deg, first);
  append(line.normals, next.normals, first);
  append(line.residual, next.residual, first);
  line.support += next.support;
  line.end_corner = next.end_corner;
  line.fitted = {};
}

/// Closes a line whose ends meet, without the vertices at its end that lie past its start.
void close(Polyline& line) {
  const auto drop_last = [](auto& values) {
    if (!values.empty()) values.pop_back();
  };
  const Point start = line.vertices.front();
  const Point along = difference(line.vertices[1], start);
  while (line.vertices.size() > 3 && dot(difference(start, line.vertices.back()), along) <= 0) {
    drop_last(line.vertices);
    drop_last(line.dihedral_deg);
    drop_last(line.normals);
    drop_last(line.residual);
  }
  line.closed = line.vertices.size() > 2;
  line.fitted = {};
}

}  // namespace

FeatureGraph join_lines(const FeatureGraph& graph, double spacing) {
  validate(graph);
  const std::vector<std::uint32_t> partners = partners_of(graph.polylines, spacing);
  FeatureGraph result;
  result.corners = graph.corners;
  result.crs = graph.crs;
  std::vector<bool> is_done(graph.polylines.size(), false);
  for (std::uint32_t line = 0; line < graph.polylines.size(); ++line) {
    if (is_done[line]) continue;
    // Back to where the chain of lines begins, or once around.
    std::uint32_t start = 2 * line;
    while (partners[start] != none && line_of(partners[start]) != line) start = other_end(partners[start]);
    const auto oriented = [&](std::uint32_t from) {
      const Polyline& part = graph.polylines[line_of(from)];
      return from % 2 == 0 ? part : reversed(part);
    };
    Polyline joined = oriented(start);
    is_done[line_of(start)] = true;
    std::uint32_t next = partners[other_end(start)];
    for (; next != none && !is_done[line_of(next)]; next = partners[other_end(next)]) {
      append(joined, oriented(next), spacing);
      is_done[line_of(next)] = true;
    }
    if (next != none) close(joined);
    result.polylines.push_back(std::move(joined));
  }
  return result;
}

}  // namespace keenline
