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

bool ever_needs_support(const LabelSpectrum& spectrum, std::size_t point) {
  return std::any_of(spectrum.kind.begin() + static_cast<std::ptrdiff_t>(spectrum.offsets[point]),
                     spectrum.kind.begin() + static_cast<std::ptrdiff_t>(spectrum.offsets[point + 1]),
                     needs_support);
}

/// Appends the filtered steps of one point; `changes` is working memory.
std::size_t filter(const Cloud& cloud, std::size_t point, std::vector<std::uint16_t>& changes, Steps& steps) {
  const LabelSpectrum& spectrum = cloud.spectrum;
  const auto all_neighbors = cloud.neighborhoods.of(point);
  const auto neighbors = all_neighbors.first(std::min(all_neighbors.size(), neighbors_that_support));
  const std::size_t first = spectrum.offsets[point];
  const std::size_t last = spectrum.offsets[point + 1];
  const std::size_t before = steps.from.size();
  if (!ever_needs_support(spectrum, point)) {
    for (std::size_t s = first; s < last; ++s)
      steps.append(spectrum.from[s], spectrum.kind[s], spectrum.clusters[s]);
    return last - first;
  }
  changes.assign(spectrum.from.begin() + static_cast<std::ptrdiff_t>(first),
                 spectrum.from.begin() + static_cast<std::ptrdiff_t>(last));
  for (const std::uint32_t q : neighbors)
    for (std::size_t s = spectrum.offsets[q]; s < spectrum.offsets[q + 1]; ++s)
      changes.push_back(spectrum.from[s]);
  std::sort(changes.begin(), changes.end());
  changes.erase(std::unique(changes.begin(), changes.end()), changes.end());
  for (const std::uint16_t at : changes) {
    const std::size_t own = step_at(spectrum, point, at);
    Kind kind = spectrum.kind[own];
    if (needs_support(kind)) {
      const auto support = std::count_if(neighbors.begin(), neighbors.end(), [&](std::uint32_t q) {
        return supports(cloud, point, kind, q, spectrum.kind[step_at(spectrum, q, at)]);
      });
      // A border is a lone face.
      if (support < cloud.min_support) kind = kind == Kind::Border ? Kind::Flat : Kind::Curved;
    }
    const bool same = steps.from.size() > before && steps.kind.back() == kind &&
                      steps.clusters.back() == spectrum.clusters[own];
    if (!same) steps.append(at, kind, spectrum.clusters[own]);
  }
  return steps.from.size() - before;
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
        std::vector<std::uint16_t> changes;
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
