#include "keenline/detect/gauss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "keenline/cloud.h"
#include "keenline/errors.h"
#include "keenline/kernels/average_linkage.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

using kernels::angle_units_per_degree;

/// Sensitivities that a point is examined at: 90/64, 2 90/64, … 90 degrees.
constexpr int spectrum_size = 64;
constexpr double spectrum_step_deg = 90.0 / spectrum_size;

void validate(const GaussOptions& options) {
  const auto require = [](bool ok, std::string_view name, const auto& found, std::string_view expected) {
    if (!ok) throw InvalidArgument(fmt::format("--{}: found {}, expected {}", name, found, expected));
  };
  require(options.neighbors >= min_neighbors && options.neighbors <= max_neighbors, "neighbors",
          options.neighbors, "3 to 255");
  if (options.sigma_deg)
    require(*options.sigma_deg > 0 && *options.sigma_deg <= 90, "sigma", *options.sigma_deg,
            "more than 0, up to 90 degrees");
  require(options.sigma_deg.has_value() || !options.plain, "sigma", "auto",
          "a number of degrees: plain leaves nothing to choose");
  if (options.min_cluster)
    require(*options.min_cluster >= 1, "min-cluster", *options.min_cluster, "1 or more");
  require(options.max_clusters >= 2 && options.max_clusters <= 255, "max-clusters", options.max_clusters,
          "2 to 255");
  require(options.flatness_deg >= 0 && options.flatness_deg <= 90, "flatness", options.flatness_deg,
          "0 to 90 degrees");
  require(options.min_sine >= 0 && options.min_sine <= 1, "min-sine", options.min_sine, "0 to 1");
}

/// What clustering says of one point, for all sensitivities at once.
struct Dendrogram {
  bool decided = false;
  int lines = 0;
  int min_cluster = 0;         // lines of a significant cluster
  bool one_direction = false;  // one cluster at every sensitivity of interest: merges are not computed
  std::span<const kernels::Merge> merges;  // in the order of average_linkage()
};

/// Number of clusters with at least min_cluster lines when merging stops at `sigma_deg`.
int significant_clusters(const Dendrogram& dendrogram, double sigma_deg) {
  const auto significant = [&](std::uint32_t size) {
    return size >= static_cast<std::uint32_t>(dendrogram.min_cluster) ? 1 : 0;
  };
  if (dendrogram.one_direction) return significant(static_cast<std::uint32_t>(dendrogram.lines));
  const double cut = sigma_deg * angle_units_per_degree;
  int count = dendrogram.lines * significant(1);
  for (const kernels::Merge& merge : dendrogram.merges)
    if (merge.height <= cut)
      count += significant(merge.first_size + merge.second_size) - significant(merge.first_size) -
               significant(merge.second_size);
  return count;
}

/// For each line the smallest line of the cluster that it is in when merging stops at `sigma_deg`.
std::vector<std::uint32_t> clusters_of_lines(const Dendrogram& dendrogram, double sigma_deg) {
  std::vector<std::uint32_t> names(static_cast<std::size_t>(dendrogram.lines));
  if (dendrogram.one_direction) return names;
  std::iota(names.begin(), names.end(), 0U);
  // Backwards: a cluster's last merge names it, before its parts take over the name.
  const double cut = sigma_deg * angle_units_per_degree;
  for (auto merge = dendrogram.merges.rbegin(); merge != dendrogram.merges.rend(); ++merge)
    if (merge->height <= cut) names[merge->second] = names[merge->first];
  return names;
}

/// The largest angle at which two significant clusters become one, in degrees.
float sharpness_deg(const Dendrogram& dendrogram) {
  double height = 0;
  for (const kernels::Merge& merge : dendrogram.merges)
    if (std::min(merge.first_size, merge.second_size) >= static_cast<std::uint32_t>(dendrogram.min_cluster))
      height = std::max(height, merge.height);
  const double degrees = height / angle_units_per_degree;
  return degrees > spectrum_step_deg ? static_cast<float>(degrees) : 0.0F;
}

Kind kind_of(const Dendrogram& dendrogram, int clusters, int max_clusters) {
  if (!dendrogram.decided) return Kind::Undecided;
  if (dendrogram.lines < 3 || clusters == 1) return Kind::Flat;
  if (clusters == 0 || clusters > max_clusters) return Kind::Curved;
  return clusters == 2 ? Kind::Edge : Kind::Corner;
}

/// Clusters the Gauss map of one point after the other; every thread has its own.
class GaussMap {
 public:
  GaussMap(const PointCloud& cloud, const Neighborhoods& neighborhoods, const GaussOptions& options,
           const Progress& progress)
      : cloud_(cloud), neighborhoods_(neighborhoods), options_(options), progress_(progress) {}

  /// Of the point that of() was last called for.
  [[nodiscard]] std::vector<std::array<float, 3>> lines() const {
    std::vector<std::array<float, 3>> lines;
    for (std::size_t i = 0; i < x_.size(); ++i) lines.push_back({x_[i], y_[i], z_[i]});
    return lines;
  }

  /// `complete`: merges are wanted even below the smallest sensitivity.
  Dendrogram of(std::size_t point, bool complete) {
    const auto neighbors = neighborhoods_.of(point);
    Dendrogram dendrogram;
    dendrogram.decided = neighbors.size() >= static_cast<std::size_t>(options_.neighbors);
    if (!dendrogram.decided) return dendrogram;
    collect_lines(cloud_.positions[point], neighbors.first(static_cast<std::size_t>(options_.neighbors)));
    const int lines = static_cast<int>(x_.size());
    dendrogram.lines = lines;
    dendrogram.min_cluster = options_.min_cluster.value_or(std::max(3, (lines + 9) / 10));
    if (lines < 3) return dendrogram;
    const kernels::Lines view{x_.data(), y_.data(), z_.data(), lines};
    dendrogram.one_direction =
        (!complete && kernels::all_within(view, spectrum_step_deg * angle_units_per_degree)) || is_flat(view);
    if (dendrogram.one_direction) return dendrogram;
    merges_.resize(static_cast<std::size_t>(lines) - 1);
    if (lines <= kernels::largest_count_in_32_bits) cluster(view, sums32_);
    else cluster(view, sums64_);
    dendrogram.merges = merges_;
    return dendrogram;
  }

 private:
  /// The lines through the triangles (p, q_i, q_j), i < j. Offsets are taken in double precision and scaled
  /// by a power of two, so that neither large coordinates nor tiny or huge shapes lose anything.
  void collect_lines(const Point& p, std::span<const std::uint32_t> neighbors) {
    double largest = gather_offsets(p, neighbors, 1);
    // The difference of two large coordinates may leave the range of doubles; that of their halves does not.
    if (std::isinf(largest)) largest = gather_offsets(p, neighbors, 0.5);
    const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
    lengths_.clear();
    for (Point& offset : offsets_) {
      for (double& coordinate : offset) coordinate = std::ldexp(coordinate, exponent);
      lengths_.push_back(std::sqrt(offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]));
    }
    x_.clear(), y_.clear(), z_.clear();
    for (std::size_t i = 0; i < offsets_.size(); ++i)
      for (std::size_t j = i + 1; j < offsets_.size(); ++j) add_line(i, j);
  }

  /// Fills offsets_ with factor * (q - p); returns the largest coordinate in absolute value.
  double gather_offsets(const Point& p, std::span<const std::uint32_t> neighbors, double factor) {
    offsets_.clear();
    double largest = 0;
    for (const std::uint32_t q : neighbors) {
      Point& offset = offsets_.emplace_back();
      for (std::size_t axis = 0; axis < 3; ++axis) {
        offset[axis] = cloud_.positions[q][axis] * factor - p[axis] * factor;
        largest = std::max(largest, std::abs(offset[axis]));
      }
    }
    return largest;
  }

  void add_line(std::size_t i, std::size_t j) {
    const Point& a = offsets_[i];
    const Point& b = offsets_[j];
    const Point normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    if (!(length > 0) || length < options_.min_sine * (lengths_[i] * lengths_[j])) return;
    x_.push_back(static_cast<float>(normal[0] / length));
    y_.push_back(static_cast<float>(normal[1] / length));
    z_.push_back(static_cast<float>(normal[2] / length));
  }

  /// The pre-test of Weber, Hahmann, Hagen, Shape Modeling International 2010: lines that deviate little from
  /// their common direction make a flat point, however they might cluster. Noise on a face passes it, an edge
  /// does not.
  [[nodiscard]] bool is_flat(const kernels::Lines& lines) const {
    if (options_.plain || options_.flatness_deg == 0) return false;
    kernels::Symmetric3 tensor;
    for (int i = 0; i < lines.count; ++i) {
      const auto x = static_cast<double>(lines.x[i]);
      const auto y = static_cast<double>(lines.y[i]);
      const auto z = static_cast<double>(lines.z[i]);
      tensor.xx += x * x;
      tensor.xy += x * y;
      tensor.xz += x * z;
      tensor.yy += y * y;
      tensor.yz += y * z;
      tensor.zz += z * z;
    }
    const auto common = kernels::eigen_decomposition(tensor).vectors[0];
    const double deviation = kernels::mean_angle_to(
        lines, static_cast<float>(common[0]), static_cast<float>(common[1]), static_cast<float>(common[2]));
    return deviation < options_.flatness_deg * angle_units_per_degree;
  }

  template <typename Sum>
  void cluster(const kernels::Lines& lines, std::vector<Sum>& sums) {
    const auto n = static_cast<std::size_t>(lines.count);
    sums.resize(n * n);
    kernels::line_angles(lines, sums.data());
    const auto stop = [](const void* progress) {
      return static_cast<const Progress*>(progress)->cancelled();
    };
    if (!kernels::average_linkage(sums.data(), lines.count, workspace_, merges_.data(), stop, &progress_))
      throw Cancelled();
  }

  const PointCloud& cloud_;
  const Neighborhoods& neighborhoods_;
  const GaussOptions& options_;
  const Progress& progress_;
  std::vector<Point> offsets_;
  std::vector<double> lengths_;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> sums32_;
  std::vector<std::uint64_t> sums64_;
  std::vector<kernels::Merge> merges_;
  kernels::LinkageWorkspace workspace_;
};

/// Calls visit(GaussMap&, i) for i = 0 … count-1 on all threads.
template <typename Visit>
void for_each_gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                        const GaussOptions& options, std::size_t count, Progress& progress,
                        const Visit& visit) {
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
  const auto lines =
      static_cast<std::uint64_t>(options.neighbors) * static_cast<std::uint64_t>(options.neighbors - 1) / 2;
  const std::uint64_t sum_size = lines <= kernels::largest_count_in_32_bits ? 4 : 8;
  const std::uint64_t threads =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency()), count);
  require_memory(
      threads * lines * lines * sum_size,
      fmt::format("Gauss map clustering with {} neighbors on {} threads", options.neighbors, threads));
  tbb::enumerable_thread_specific<GaussMap> maps(
      [&] { return GaussMap(cloud, neighborhoods, options, progress); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      GaussMap& map = maps.local();
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        progress.check();
                        visit(map, i);
                      }
                      progress.advance(range.size());
                    });
}

}  // namespace

FeatureLabels detect_gauss(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                           const GaussOptions& options, Progress& progress) {
  validate(options);
  const double sigma_deg =
      options.sigma_deg ? *options.sigma_deg : choose_sigma(cloud, neighborhoods, options, progress);
  progress.begin("gauss", cloud.size());
  FeatureLabels labels;
  labels.kind.resize(cloud.size());
  labels.score.resize(cloud.size());
  labels.clusters.resize(cloud.size());
  const bool complete = sigma_deg < spectrum_step_deg;
  for_each_gauss_map(cloud, neighborhoods, options, cloud.size(), progress,
                     [&](GaussMap& map, std::size_t i) {
                       const Dendrogram dendrogram = map.of(i, complete);
                       const int clusters = significant_clusters(dendrogram, sigma_deg);
                       labels.kind[i] = kind_of(dendrogram, clusters, options.max_clusters);
                       labels.clusters[i] = static_cast<std::uint8_t>(std::min(clusters, 255));
                       labels.score[i] = sharpness_deg(dendrogram);
                     });
  return labels;
}

double choose_sigma(const PointCloud& cloud, const Neighborhoods& neighborhoods, const GaussOptions& options,
                    Progress& progress) {
  validate(options);
  constexpr std::size_t largest_sample = 16384;
  const std::size_t step = (cloud.size() + largest_sample - 1) / largest_sample;
  const std::size_t count = step == 0 ? 0 : (cloud.size() + step - 1) / step;
  progress.begin("sigma", count);

  // One bit per point and sensitivity: is it a feature there?
  std::vector<std::uint64_t> is_feature_at(count);
  for_each_gauss_map(cloud, neighborhoods, options, count, progress, [&](GaussMap& map, std::size_t i) {
    const Dendrogram dendrogram = map.of(i * step, false);
    for (int s = 0; s < spectrum_size; ++s) {
      const int clusters = significant_clusters(dendrogram, (s + 1) * spectrum_step_deg);
      if (is_feature(kind_of(dendrogram, clusters, options.max_clusters)))
        is_feature_at[i] |= std::uint64_t{1} << static_cast<unsigned>(s);
    }
  });

  // Labels that change between sensitivities a quarter below and a quarter above, against those that are
  // features. The share of the whole keeps a sensitivity that sees nothing at all from looking perfectly
  // stable.
  const int first = 6;  // 9.8 degrees: below, sampling alone scatters the lines of a curved surface
  const int last = 31;  // 45 degrees: above, edges of 90 degrees begin to vanish
  double best_change = 2;
  double best_sigma_deg = 20;
  for (int s = first; s <= last; ++s) {
    const int low = static_cast<int>(std::lround((s + 1) / 1.25)) - 1;
    const int high = static_cast<int>(std::lround((s + 1) * 1.25)) - 1;
    std::size_t changing = 0;
    std::size_t features = 0;
    for (const std::uint64_t bits : is_feature_at) {
      const std::uint64_t window = (bits >> static_cast<unsigned>(low)) &
                                   ((std::uint64_t{2} << static_cast<unsigned>(high - low)) - 1);
      const std::uint64_t full = (std::uint64_t{2} << static_cast<unsigned>(high - low)) - 1;
      changing += window != 0 && window != full ? 1U : 0U;
      features += (bits >> static_cast<unsigned>(s)) & 1U;
    }
    const double change = static_cast<double>(changing + 1) /
                          (static_cast<double>(features) + 0.01 * static_cast<double>(count) + 1);
    const double sigma_deg = (s + 1) * spectrum_step_deg;
    if (change < best_change ||
        (change == best_change && std::abs(sigma_deg - 20) < std::abs(best_sigma_deg - 20))) {
      best_change = change;
      best_sigma_deg = sigma_deg;
    }
  }
  return best_sigma_deg;
}

PointGaussMap gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods, std::size_t point,
                        const GaussOptions& options, Progress& progress) {
  validate(options);
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
  if (point >= cloud.size())
    throw InvalidArgument(fmt::format("point {} of a cloud of {} points", point, cloud.size()));
  const double sigma_deg =
      options.sigma_deg ? *options.sigma_deg : choose_sigma(cloud, neighborhoods, options, progress);
  GaussMap map(cloud, neighborhoods, options, progress);
  const Dendrogram dendrogram = map.of(point, sigma_deg < spectrum_step_deg);
  PointGaussMap result;
  result.kind = kind_of(dendrogram, significant_clusters(dendrogram, sigma_deg), options.max_clusters);
  if (!dendrogram.decided) return result;
  result.lines = map.lines();

  const std::vector<std::uint32_t> names = clusters_of_lines(dendrogram, sigma_deg);
  std::vector<int> sizes(names.size());
  for (const std::uint32_t name : names) ++sizes[name];
  std::vector<std::uint32_t> significant;
  for (std::uint32_t name = 0; name < sizes.size(); ++name)
    if (sizes[name] > 0 && sizes[name] >= dendrogram.min_cluster) significant.push_back(name);
  std::stable_sort(significant.begin(), significant.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return sizes[a] > sizes[b]; });
  std::vector<int> places(sizes.size(), -1);
  for (const std::uint32_t name : significant) {
    places[name] = static_cast<int>(result.sizes.size());
    result.sizes.push_back(sizes[name]);
  }
  for (const std::uint32_t name : names) result.cluster.push_back(places[name]);
  return result;
}

}  // namespace keenline
