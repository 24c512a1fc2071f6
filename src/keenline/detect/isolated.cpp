#include "keenline/detect/isolated.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/detect/relabel.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr std::size_t block_size = 4096;

struct Steps {
  std::vector<std::uint16_t> from;
  std::vector<Kind> kind;
  std::vector<std::uint8_t> clusters;

  void append(std::uint16_t at, Kind k, std::uint8_t c) {
    from.push_back(at);
    kind.push_back(k);
    clusters.push_back(c);
  }
};

/// Everything that the filter looks at.
struct Cloud {
  const LabelSpectrum& spectrum;
  const Neighborhoods& neighborhoods;
  const std::vector<Point>& positions;
  const std::vector<CreaseDirection>& directions;
  int min_support;
};

/// Is `way` within 35 degrees of the crease that a point of this kind lies on?
bool runs_along(const Point& way, Kind kind, const CreaseDirection& direction) {
  const Point d{static_cast<double>(direction.x), static_cast<double>(direction.y),
                static_cast<double>(direction.z)};
  const double square = dot(d, d);
  if (kind != Kind::Edge || square == 0) return true;
  constexpr double smallest_square_of_cosine = 0.67101007166283433;  // 35 degrees
  const double product = dot(way, d);
  return product * product >= smallest_square_of_cosine * square * dot(way, way);
}

/// Its direction, with a largest coordinate of 1: squares of the largest and smallest clouds leave the range
/// of doubles. Halves, because the difference of the largest does too.
Point way_between(const Point& from, const Point& to) {
  Point way;
  double largest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    way[axis] = to[axis] * 0.5 - from[axis] * 0.5;
    largest = std::max(largest, std::abs(way[axis]));
  }
  if (largest > 0)
    for (double& c : way) c /= largest;
  return way;
}

bool supports(const Cloud& cloud, std::size_t point, Kind kind, std::uint32_t neighbor, Kind neighbor_kind) {
  if (kind == Kind::Border) return neighbor_kind == Kind::Border;
  if (!is_feature(neighbor_kind)) return false;
  const Point way = way_between(cloud.positions[point], cloud.positions[neighbor]);
  return runs_along(way, kind, cloud.directions[point]) &&
         runs_along(way, neighbor_kind, cloud.directions[neighbor]);
}

/// Support that comes or goes at a sensitivity.
struct Change {
  std::uint16_t at;
  int support;
};

/// Steps of a point, of which those that change nothing are left out.
class Filtered {
 public:
  explicit Filtered(Steps& steps) : steps_(steps), before_(steps.from.size()) {}

  void append(std::uint16_t at, Kind kind, std::uint8_t clusters) {
    if (count() > 0 && steps_.kind.back() == kind && steps_.clusters.back() == clusters) return;
    steps_.append(at, kind, clusters);
  }
  [[nodiscard]] std::size_t count() const { return steps_.from.size() - before_; }

 private:
  Steps& steps_;
  std::size_t before_;
};

/// A step of a point from one sensitivity to another, without the second.
struct Range {
  std::uint32_t from;
  std::uint32_t to;
};

Range range_of(const LabelSpectrum& spectrum, std::size_t point, std::size_t step) {
  constexpr std::uint32_t beyond_all = 0x10000;
  return {spectrum.from[step], step + 1 < spectrum.offsets[point + 1] ? spectrum.from[step + 1] : beyond_all};
}

/// Adds where a neighbour begins and ends to support a step of the point.
void add_changes(const Cloud& cloud, std::size_t point, Kind kind, const Range& range, std::uint32_t neighbor,
                 std::vector<Change>& changes) {
  const LabelSpectrum& spectrum = cloud.spectrum;
  for (std::size_t s = spectrum.offsets[neighbor]; s < spectrum.offsets[neighbor + 1]; ++s) {
    const Range other = range_of(spectrum, neighbor, s);
    if (other.from >= range.to) return;
    if (other.to <= range.from || !supports(cloud, point, kind, neighbor, spectrum.kind[s])) continue;
    changes.push_back({static_cast<std::uint16_t>(std::max(range.from, other.from)), 1});
    if (other.to < range.to) changes.push_back({static_cast<std::uint16_t>(other.to), -1});
  }
}

/// Appends the filtered steps of one point; `changes` is working memory.
std::size_t filter(const Cloud& cloud, std::size_t point, std::vector<Change>& changes, Steps& steps) {
  const LabelSpectrum& spectrum = cloud.spectrum;
  const auto all_neighbors = cloud.neighborhoods.of(point);
  const auto neighbors = all_neighbors.first(std::min(all_neighbors.size(), neighbors_that_support));
  Filtered filtered(steps);
  for (std::size_t s = spectrum.offsets[point]; s < spectrum.offsets[point + 1]; ++s) {
    const Kind kind = spectrum.kind[s];
    const std::uint8_t clusters = spectrum.clusters[s];
    if (!needs_support(kind)) {
      filtered.append(spectrum.from[s], kind, clusters);
      continue;
    }
    changes.clear();
    changes.push_back({spectrum.from[s], 0});
    for (const std::uint32_t q : neighbors)
      add_changes(cloud, point, kind, range_of(spectrum, point, s), q, changes);
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
    int support = 0;
    for (std::size_t c = 0; c < changes.size(); ++c) {
      support += changes[c].support;
      if (c + 1 < changes.size() && changes[c + 1].at == changes[c].at) continue;
      // A border is a lone face.
      const Kind alone = kind == Kind::Border ? Kind::Flat : Kind::Curved;
      filtered.append(changes[c].at, support < cloud.min_support ? alone : kind, clusters);
    }
  }
  return filtered.count();
}

}  // namespace

CreaseDirection quantized(const Point& direction) {
  const auto whole = [](double c) { return static_cast<std::int8_t>(std::lround(127 * c)); };
  return {whole(direction[0]), whole(direction[1]), whole(direction[2])};
}

LabelSpectrum without_isolated(const LabelSpectrum& spectrum, const Neighborhoods& neighborhoods,
                               const std::vector<Point>& positions,
                               const std::vector<CreaseDirection>& directions, int min_support,
                               Progress& progress) {
  const Cloud cloud{spectrum, neighborhoods, positions, directions, min_support};
  const std::size_t count = spectrum.size();
  const std::size_t blocks = (count + block_size - 1) / block_size;
  std::vector<Steps> parts(blocks);
  LabelSpectrum result;
  result.offsets.resize(count + 1);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<Change> changes;
        for (std::size_t block = range.begin(); block < range.end(); ++block) {
          progress.check();
          for (std::size_t i = block * block_size; i < std::min(count, (block + 1) * block_size); ++i) {
            result.offsets[i + 1] = filter(cloud, i, changes, parts[block]);
          }
        }
      });
  for (std::size_t i = 0; i < count; ++i) result.offsets[i + 1] += result.offsets[i];
  result.from.reserve(result.offsets[count]);
  result.kind.reserve(result.offsets[count]);
  result.clusters.reserve(result.offsets[count]);
  for (Steps& part : parts) {
    result.from.insert(result.from.end(), part.from.begin(), part.from.end());
    result.kind.insert(result.kind.end(), part.kind.begin(), part.kind.end());
    result.clusters.insert(result.clusters.end(), part.clusters.begin(), part.clusters.end());
    part = {};  // no two copies of everything at once
  }
  return result;
}

}  // namespace keenline
