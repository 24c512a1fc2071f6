#include "keenline/detect/isolated.h"

#include <algorithm>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/detect/relabel.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

constexpr std::size_t neighbors_that_support = 16;
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

/// A peak stands by itself.
bool needs_support(Kind kind) { return (is_feature(kind) && kind != Kind::Peak) || kind == Kind::Border; }

bool supports(Kind neighbor, Kind kind) {
  return kind == Kind::Border ? neighbor == Kind::Border : is_feature(neighbor);
}

bool ever_needs_support(const LabelSpectrum& spectrum, std::size_t point) {
  return std::any_of(spectrum.kind.begin() + static_cast<std::ptrdiff_t>(spectrum.offsets[point]),
                     spectrum.kind.begin() + static_cast<std::ptrdiff_t>(spectrum.offsets[point + 1]),
                     needs_support);
}

/// Appends the filtered steps of one point; `changes` is working memory.
std::size_t filter(const LabelSpectrum& spectrum, std::span<const std::uint32_t> neighbors, std::size_t point,
                   int min_support, std::vector<std::uint16_t>& changes, Steps& steps) {
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
        return supports(spectrum.kind[step_at(spectrum, q, at)], kind);
      });
      // A border is a lone face.
      if (support < min_support) kind = kind == Kind::Border ? Kind::Flat : Kind::Curved;
    }
    const bool same = steps.from.size() > before && steps.kind.back() == kind &&
                      steps.clusters.back() == spectrum.clusters[own];
    if (!same) steps.append(at, kind, spectrum.clusters[own]);
  }
  return steps.from.size() - before;
}

}  // namespace

LabelSpectrum without_isolated(const LabelSpectrum& spectrum, const Neighborhoods& neighborhoods,
                               int min_support, Progress& progress) {
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
            const auto neighbors = neighborhoods.of(i);
            result.offsets[i + 1] =
                filter(spectrum, neighbors.first(std::min(neighbors.size(), neighbors_that_support)), i,
                       min_support, changes, parts[block]);
          }
        }
      });
  for (std::size_t i = 0; i < count; ++i) result.offsets[i + 1] += result.offsets[i];
  result.from.reserve(result.offsets[count]);
  result.kind.reserve(result.offsets[count]);
  result.clusters.reserve(result.offsets[count]);
  for (const Steps& part : parts) {
    result.from.insert(result.from.end(), part.from.begin(), part.from.end());
    result.kind.insert(result.kind.end(), part.kind.begin(), part.kind.end());
    result.clusters.insert(result.clusters.end(), part.clusters.begin(), part.clusters.end());
  }
  return result;
}

}  // namespace keenline
