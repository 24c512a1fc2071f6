#include "keenline/detect/gauss.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "keenline/cloud.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/detect/isolated.h"
#include "keenline/detect/point_labeler.h"
#include "keenline/detect/relabel.h"
#include "keenline/errors.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/require.h"

namespace keenline {
namespace {

using kernels::angle_units_per_degree;

void require_usable(const GaussOptions& options) {
  require_in_range("neighbors", options.neighbors, min_neighbors, max_neighbors);
  require_in_range("scales", options.scales, 1, 5);
  if (options.sigma_rule == SigmaRule::Given) (void)sensitivity_of(options.sigma_deg);
  if (options.min_cluster)
    require_in_range("min_cluster", *options.min_cluster, 1, std::numeric_limits<double>::infinity());
  if (options.max_clusters) require_in_range("max_clusters", *options.max_clusters, 2, 255);
  require_in_range("min_support", options.min_support, 0, static_cast<double>(neighbors_that_support));
  if (options.persistence) require_in_range("persistence", *options.persistence, 1, 90);
  require_in_range("min_sine", options.min_sine, 0, 1);
  if (options.triangles) require_in_range("triangles", *options.triangles, 3, 32385);
}

void require_match(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
}

bool filters_isolated(const GaussOptions& options) { return !options.plain && options.min_support > 0; }

/// For each line the smallest line of the cluster that it is in when merging stops at the sensitivity.
std::vector<std::uint32_t> clusters_of_lines(const GaussMap& map, std::uint16_t sensitivity) {
  std::vector<std::uint32_t> names(static_cast<std::size_t>(map.lines().count));
  std::iota(names.begin(), names.end(), 0U);
  // Backwards: a cluster's last merge names it, before its parts take over the name.
  for (auto merge = map.merges().rbegin(); merge != map.merges().rend(); ++merge)
    if (merge->height <= sensitivity) names[merge->second] = names[merge->first];
  return names;
}

/// Calls a function with all points, in blocks, and the neighbours of each.
using ForEachBlock = std::function<void(const NeighborSearch::Visit& visit)>;

/// Blocks of a table, in its order.
void for_each_block(const Neighborhoods& table, const NeighborSearch::Visit& visit, Progress& progress) {
  constexpr std::size_t block_size = 1024;
  const std::size_t blocks = (table.size() + block_size - 1) / block_size;
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    const std::size_t first = b * block_size;
    std::vector<std::uint32_t> points(std::min(block_size, table.size() - first));
    std::iota(points.begin(), points.end(), static_cast<std::uint32_t>(first));
    Neighborhoods block;
    for (const std::uint32_t point : points) {
      const auto neighbors = table.of(point);
      block.indices.insert(block.indices.end(), neighbors.begin(), neighbors.end());
      block.offsets.push_back(block.indices.size());
    }
    visit(points, block);
    progress.advance(points.size());
  });
}

/// What was found out about the points of a block.
struct LabeledBlock {
  std::vector<std::uint32_t> points;
  std::vector<std::uint16_t> step_counts;  // of each point
  std::vector<LabelStep> steps;            // of all, one point after the other
  std::vector<std::uint32_t> supporters;   // neighbours of those that need support, likewise
  std::vector<std::uint16_t> supporter_counts;
};

/// What was found out about all points.
struct LabeledPoints {
  LabelSpectrum spectrum;
  std::vector<float> score;
  std::vector<CreaseDirection> directions;
  Neighborhoods supporters;  ///< of points that need support; empty for the others
};

/// Brings what the blocks hold into the order of the points; a point of no block is undecided.
void join_blocks(std::vector<LabeledBlock>& blocks, LabeledPoints& labeled) {
  LabelSpectrum& spectrum = labeled.spectrum;
  Neighborhoods& supporters = labeled.supporters;
  const std::size_t count = labeled.score.size();
  spectrum.offsets.assign(count + 1, 1);
  spectrum.offsets[0] = 0;
  supporters.offsets.assign(count + 1, 0);
  for (const LabeledBlock& block : blocks) {
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      spectrum.offsets[block.points[i] + 1] = block.step_counts[i];
      supporters.offsets[block.points[i] + 1] = block.supporter_counts[i];
    }
  }
  std::partial_sum(spectrum.offsets.begin(), spectrum.offsets.end(), spectrum.offsets.begin());
  std::partial_sum(supporters.offsets.begin(), supporters.offsets.end(), supporters.offsets.begin());
  spectrum.from.assign(spectrum.offsets[count], 0);
  spectrum.kind.assign(spectrum.offsets[count], Kind::Undecided);
  spectrum.clusters.assign(spectrum.offsets[count], 0);
  supporters.indices.resize(supporters.offsets[count]);
  for (LabeledBlock& block : blocks) {
    auto step = block.steps.begin();
    auto supporter = block.supporters.begin();
    for (std::size_t i = 0; i < block.points.size(); ++i) {
      const std::size_t first = spectrum.offsets[block.points[i]];
      for (std::size_t s = first; s < first + block.step_counts[i]; ++s, ++step) {
        spectrum.from[s] = step->from;
        spectrum.kind[s] = step->kind;
        spectrum.clusters[s] = step->clusters;
      }
      const auto next = supporter + block.supporter_counts[i];
      std::copy(
          supporter, next,
          supporters.indices.begin() + static_cast<std::ptrdiff_t>(supporters.offsets[block.points[i]]));
      supporter = next;
    }
    block = {};  // no two copies of everything at once
  }
}

/// Labels all points on all threads.
LabeledPoints label_points(const PointCloud& cloud, const ForEachBlock& for_each, const GaussOptions& options,
                           Progress& progress) {
  const std::size_t count = cloud.size();
  const std::vector<int> sizes = neighborhood_sizes(options.neighbors, options.scales);
  const std::uint64_t memory = GaussMap::memory(*std::max_element(sizes.begin(), sizes.end()));
  const std::uint64_t threads =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency()), count);
  require_memory(threads * memory, fmt::format("Gauss map clustering with {} neighbors on {} threads",
                                               options.neighbors, threads));
  tbb::enumerable_thread_specific<PointLabeler> labelers(
      [&] { return PointLabeler(cloud, options, progress); });
  tbb::enumerable_thread_specific<std::vector<LabeledBlock>> blocks;
  LabeledPoints labeled;
  labeled.score.resize(count);
  labeled.directions.resize(count);
  const bool filtered = filters_isolated(options);
  for_each([&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
    PointLabeler& labeler = labelers.local();
    LabeledBlock block;
    block.points.assign(points.begin(), points.end());
    for (std::size_t i = 0; i < points.size(); ++i) {
      progress.check();
      const std::span<const std::uint32_t> neighbors = neighborhoods.of(i);
      labeler.label(points[i], neighbors);
      labeled.score[points[i]] = labeler.score();
      // Across a band, too, one point continues another.
      if (options.thin) labeled.directions[points[i]] = labeler.direction();
      block.steps.insert(block.steps.end(), labeler.steps().begin(), labeler.steps().end());
      block.step_counts.push_back(static_cast<std::uint16_t>(labeler.steps().size()));
      const bool has_supporters = filtered && labeler.ever_needs_support();
      const auto supporters =
          neighbors.first(has_supporters ? std::min(neighbors.size(), neighbors_that_support) : 0);
      block.supporters.insert(block.supporters.end(), supporters.begin(), supporters.end());
      block.supporter_counts.push_back(static_cast<std::uint16_t>(supporters.size()));
    }
    block.steps.shrink_to_fit();
    block.supporters.shrink_to_fit();
    blocks.local().push_back(std::move(block));
  });
  std::vector<LabeledBlock> all;
  for (std::vector<LabeledBlock>& part : blocks) {
    std::move(part.begin(), part.end(), std::back_inserter(all));
    part.clear();
  }
  join_blocks(all, labeled);
  return labeled;
}

LabelSpectrum spectrum_of_one(std::span<const LabelStep> steps) {
  LabelSpectrum spectrum;
  for (const LabelStep& step : steps) {
    spectrum.from.push_back(step.from);
    spectrum.kind.push_back(step.kind);
    spectrum.clusters.push_back(step.clusters);
  }
  spectrum.offsets.push_back(steps.size());
  return spectrum;
}

FeatureLabels detect_in_blocks(const PointCloud& cloud, const ForEachBlock& for_each,
                               const GaussOptions& options, Progress& progress) {
  require_usable(options);
  progress.begin("gauss", cloud.size());
  LabeledPoints labeled = label_points(cloud, for_each, options, progress);
  LabelSpectrum& spectrum = labeled.spectrum;
  if (filters_isolated(options)) {
    spectrum = without_isolated(spectrum, labeled.supporters, cloud.positions, labeled.directions,
                                options.min_support, progress);
  }
  const bool is_the_papers = options.plain && options.sigma_rule == SigmaRule::Auto;
  FeatureLabels labels = is_the_papers ? relabel(spectrum, default_sigma_deg)
                                       : relabel(spectrum, options.sigma_rule, options.sigma_deg, progress);
  labels.score = std::move(labeled.score);
  if (options.keep_spectrum) labels.spectrum = std::move(spectrum);
  return labels;
}

}  // namespace

std::vector<int> neighborhood_sizes(int neighbors, int scales) {
  std::vector<int> sizes;
  for (int i = 0; i < scales; ++i) {
    const int half_octaves = i % 2 == 1 ? (i + 1) / 2 : -i / 2;
    double size = neighbors;
    for (int step = 0; step < std::abs(half_octaves); ++step)
      size = half_octaves > 0 ? size * 1.4142135623730951 : size / 1.4142135623730951;
    sizes.push_back(std::clamp(static_cast<int>(std::lround(size)), min_neighbors, max_neighbors));
  }
  return sizes;
}

FeatureLabels detect_gauss(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                           const GaussOptions& options, Progress& progress) {
  require_match(cloud, neighborhoods);
  return detect_in_blocks(
      cloud, [&](const auto& visit) { for_each_block(neighborhoods, visit, progress); }, options, progress);
}

FeatureLabels detect_gauss(const PointCloud& cloud, const NeighborSearch& search, const GaussOptions& options,
                           Progress& progress) {
  require_usable(options);
  const std::vector<int> sizes = neighborhood_sizes(options.neighbors, options.scales);
  const int most = *std::max_element(sizes.begin(), sizes.end());
  return detect_in_blocks(
      cloud, [&](const auto& visit) { search.for_each_block(most, visit, progress); }, options, progress);
}

PointGaussMap gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods, std::size_t point,
                        const GaussOptions& options, Progress& progress) {
  require_usable(options);
  require_match(cloud, neighborhoods);
  if (point >= cloud.size())
    throw InvalidArgument(fmt::format("point {} of a cloud of {} points", point, cloud.size()));
  PointGaussMap result;
  result.sigma_deg = options.sigma_deg;
  if (options.sigma_rule == SigmaRule::Auto)
    result.sigma_deg = detect_gauss(cloud, neighborhoods, options, progress).sigma_deg;
  PointLabeler labeler(cloud, options, progress);
  labeler.label(point, neighborhoods.of(point));
  const LabelSpectrum own = spectrum_of_one(labeler.steps());
  const bool is_local = options.sigma_rule == SigmaRule::Local;
  const std::uint16_t sensitivity = is_local ? local_sensitivity(own, 0) : sensitivity_of(result.sigma_deg);
  if (is_local) result.sigma_deg = sensitivity / angle_units_per_degree;
  result.kind = own.kind[step_at(own, 0, sensitivity)];

  const GaussMap& map = labeler.clustered_map();
  const kernels::Lines lines = map.lines();
  const auto count = static_cast<std::size_t>(lines.count);
  for (std::size_t i = 0; i < count; ++i) result.lines.push_back({lines.x[i], lines.y[i], lines.z[i]});
  const std::vector<std::uint32_t> names = clusters_of_lines(map, sensitivity);
  std::vector<int> sizes(count);
  for (const std::uint32_t name : names) ++sizes[name];
  std::vector<std::uint32_t> significant;
  for (std::uint32_t name = 0; name < count; ++name)
    if (sizes[name] > 0 && sizes[name] >= labeler.min_cluster()) significant.push_back(name);
  std::stable_sort(significant.begin(), significant.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
  std::vector<int> places(count, -1);
  for (const std::uint32_t name : significant) {
    places[name] = static_cast<int>(result.sizes.size());
    result.sizes.push_back(sizes[name]);
  }
  for (const std::uint32_t name : names) result.cluster.push_back(places[name]);
  return result;
}

}  // namespace keenline
