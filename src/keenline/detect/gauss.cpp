#include "keenline/detect/gauss.h"

#include <algorithm>
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
#include "keenline/detect/crease.h"
#include "keenline/detect/faces.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/detect/isolated.h"
#include "keenline/detect/peak.h"
#include "keenline/detect/relabel.h"
#include "keenline/errors.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

using kernels::angle_units_per_degree;

/// Differences of direction below this are of no interest: scores are 0, and such points flat at any
/// sensitivity.
constexpr double smallest_angle = 3 * angle_units_per_degree;

void require_usable(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                    const GaussOptions& options) {
  const auto require = [](bool ok, std::string_view name, const auto& found, std::string_view expected) {
    if (!ok) throw InvalidArgument(fmt::format("--{}: found {}, expected {}", name, found, expected));
  };
  require(options.neighbors >= min_neighbors && options.neighbors <= max_neighbors, "neighbors",
          options.neighbors, "3 to 255");
  require(options.scales >= 1 && options.scales <= 5, "scales", options.scales, "1 to 5");
  if (options.sigma_rule == SigmaRule::Given) (void)sensitivity_of(options.sigma_deg);
  if (options.min_cluster)
    require(*options.min_cluster >= 1, "min-cluster", *options.min_cluster, "1 or more");
  if (options.max_clusters)
    require(*options.max_clusters >= 2 && *options.max_clusters <= 255, "max-clusters", *options.max_clusters,
            "2 to 255");
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
  require(options.min_support >= 0 && options.min_support <= 16, "min-support", options.min_support,
          "0 to 16");
  if (options.persistence)
    require(*options.persistence >= 1 && *options.persistence <= 90, "persistence", *options.persistence,
            "1 to 90");
  require(options.min_sine >= 0 && options.min_sine <= 1, "min-sine", options.min_sine, "0 to 1");
}

/// The labels of one point from the sensitivity `from` up to that of the next step.
struct Step {
  std::uint16_t from;
  Kind kind;
  std::uint8_t clusters;
};

/// The smallest sensitivity that reaches a height: merges happen at heights up to the sensitivity.
std::uint16_t sensitivity_reaching(double height) {
  return static_cast<std::uint16_t>(std::ceil(std::min(height, double{kernels::right_angle})));
}

/// Everything that the Gauss map of one point says, for all sensitivities at once; every thread has its own.
class PointLabeler {
 public:
  PointLabeler(const PointCloud& cloud, const Neighborhoods& neighborhoods, const GaussOptions& options,
               const Progress& progress)
      : cloud_(cloud),
        neighborhoods_(neighborhoods),
        options_(options),
        max_clusters_(options.max_clusters.value_or(options.plain ? 4 : 6)),
        sizes_(neighborhood_sizes(options.neighbors, options.plain ? 1 : options.scales)),
        persistence_(options.persistence.value_or(options.thin ? 3 : 2)),
        map_(options.min_sine, progress) {}

  /// Afterwards the others are those of the point.
  void label(std::size_t point) {
    // The first size last: score and map are its.
    views_.resize(sizes_.size());
    for (std::size_t s = sizes_.size(); s-- > 0;) {
      look(point, sizes_[s]);
      if (sizes_.size() > 1) views_[s] = steps_;
    }
    if (sizes_.size() > 1) combine_views();
  }

  [[nodiscard]] std::span<const Step> steps() const { return steps_; }
  /// Of the two faces that are told apart best.
  [[nodiscard]] CreaseDirection direction() const {
    if (faces_.size() < 2) return {};
    const Point along = cross(faces_[0].normal, faces_[1].normal);
    return length(along) > 0 ? quantized(unit(along)) : CreaseDirection{};
  }
  /// The largest angle at which two significant clusters become one, in degrees.
  [[nodiscard]] float score() const { return score_; }
  /// Lines of a significant cluster.
  [[nodiscard]] int min_cluster() const { return min_cluster_; }
  /// Clustered, whether the label took it or not.
  [[nodiscard]] const GaussMap& clustered_map() {
    if (map_.merges().empty() && map_.lines().count > 1) map_.cluster();
    return map_;
  }

 private:
  /// Labels the point by that many neighbours.
  void look(std::size_t point, int size) {
    steps_.clear();
    faces_.clear();
    score_ = 0;
    map_.clear();
    const auto neighbors = neighborhoods_.of(point);
    if (neighbors.size() < static_cast<std::size_t>(size)) {
      steps_.push_back({0, Kind::Undecided, 0});
      return;
    }
    map_.collect(cloud_.positions, cloud_.positions[point], neighbors.first(static_cast<std::size_t>(size)));
    const int lines = map_.lines().count;
    min_cluster_ = options_.min_cluster.value_or(std::max(3, (lines + 9) / 10));
    if (lines < 3) {
      steps_.push_back({0, Kind::Flat, 0});
      return;
    }
    if (!options_.plain && lines >= min_cluster_ &&
        kernels::all_within(map_.lines(), std::min(smallest_angle, unresolved_angle(persistence_)) - 2)) {
      const Face face = lone_face(map_);
      steps_.push_back({0, face.is_half ? Kind::Border : Kind::Flat, 1});
      return;
    }
    map_.cluster();
    score_ = sharpness_deg();
    if (options_.plain) count_clusters();
    else read_faces();
  }

  /// At every sensitivity the majority of the sizes decides whether the point is sharp, the first of those
  /// that agree what it is. Sizes for which there are too few points have no say.
  void combine_views() {
    if (views_[0][0].kind == Kind::Undecided) {
      steps_ = views_[0];
      return;
    }
    std::erase_if(views_, [](const std::vector<Step>& view) { return view[0].kind == Kind::Undecided; });
    changes_.clear();
    for (const std::vector<Step>& view : views_)
      for (const Step& step : view) changes_.push_back({step.from, 0});
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
    steps_.clear();
    for (const Change& change : changes_) {
      const auto step_of = [&](const std::vector<Step>& view) {
        return *std::find_if(view.rbegin(), view.rend(), [&](const Step& s) { return s.from <= change.at; });
      };
      const auto sharp = std::count_if(views_.begin(), views_.end(),
                                       [&](const auto& view) { return is_feature(step_of(view).kind); });
      const bool is_sharp = 2 * sharp > static_cast<std::ptrdiff_t>(views_.size());
      const auto agrees = std::find_if(views_.begin(), views_.end(), [&](const auto& view) {
        return is_feature(step_of(view).kind) == is_sharp;
      });
      const Step step = step_of(*agrees);
      push_step({change.at, step.kind, step.clusters});
    }
  }

  [[nodiscard]] bool is_significant(std::uint32_t size) const {
    return size >= static_cast<std::uint32_t>(min_cluster_);
  }

  [[nodiscard]] float sharpness_deg() {
    sharpness_ = 0;
    for (const kernels::Merge& merge : map_.merges())
      if (is_significant(std::min(merge.first_size, merge.second_size)))
        sharpness_ = std::max(sharpness_, merge.height);
    if (sharpness_ <= smallest_angle) sharpness_ = 0;
    return static_cast<float>(sharpness_ / angle_units_per_degree);
  }

  /// Section 4 of the paper: the number of significant clusters when merging stops at the sensitivity.
  void count_clusters() {
    changes_.clear();
    for (const kernels::Merge& merge : map_.merges()) {
      const int change = static_cast<int>(is_significant(merge.first_size + merge.second_size)) -
                         static_cast<int>(is_significant(merge.first_size)) -
                         static_cast<int>(is_significant(merge.second_size));
      if (change != 0) changes_.push_back({sensitivity_reaching(merge.height), change});
    }
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
    int count = is_significant(1) ? map_.lines().count : 0;
    push_plain_step(0, count);
    for (std::size_t i = 0; i < changes_.size(); ++i) {
      count += changes_[i].change;
      if (i + 1 == changes_.size() || changes_[i + 1].at != changes_[i].at)
        push_plain_step(changes_[i].at, count);
    }
  }

  void push_plain_step(std::uint16_t from, int clusters) {
    Kind kind = Kind::Curved;
    if (clusters == 1) kind = Kind::Flat;
    else if (clusters == 2) kind = Kind::Edge;
    else if (clusters > 2 && clusters <= max_clusters_) kind = Kind::Corner;
    push_step({from, kind, static_cast<std::uint8_t>(std::min(clusters, 255))});
  }

  /// The refined decision: which faces are there at the sensitivity, and do they all end here?
  void read_faces() {
    find_faces(map_, min_cluster_, persistence_, workspace_, faces_);
    is_peak_ = sharpness_ > 0 && is_peak(map_);
    // Every decision that asks for it begins with the first two faces, and asks whether they end first.
    is_beside_ = options_.thin && faces_.size() > 1 && faces_[0].ends && faces_[1].ends &&
                 is_beside_crease(map_, faces_);
    // Everything that the decision depends on changes at the deaths of faces and at the height where all
    // significant lines have become one direction.
    changes_.clear();
    changes_.push_back({0, 0});
    changes_.push_back({sensitivity_reaching(sharpness_), 0});
    for (const Face& face : faces_)
      if (std::isfinite(face.death)) changes_.push_back({sensitivity_reaching(face.death), 0});
    std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
    for (const Change& change : changes_) {
      std::size_t count = 0;  // faces_ is sorted by falling death
      while (count < faces_.size() && faces_[count].death > change.at) ++count;
      push_step({change.at, kind_of(std::span(faces_).first(count), change.at),
                 static_cast<std::uint8_t>(std::min<std::size_t>(count, 255))});
    }
  }

  [[nodiscard]] Kind kind_of(std::span<const Face> faces, std::uint16_t sensitivity) const {
    // Before the faces: the lines of a peak gather in some by chance.
    if (is_peak_ && sharpness_ > sensitivity) return Kind::Peak;
    if (faces.size() == 1) {
      if (faces[0].is_half) return Kind::Border;
      return sharpness_ <= sensitivity ? Kind::Flat : Kind::Curved;
    }
    if (faces.empty() || faces.size() > static_cast<std::size_t>(max_clusters_)) return Kind::Curved;
    const auto ends = [](const Face& face) { return face.ends; };
    if (options_.thin && (is_beside_ || !std::all_of(faces.begin(), faces.end(), ends))) return Kind::Curved;
    return faces.size() > 2 && span_space(faces) ? Kind::Corner : Kind::Edge;
  }

  /// The normals along an edge between curved faces all lie in one plane, those at a corner do not.
  [[nodiscard]] static bool span_space(std::span<const Face> faces) {
    kernels::Symmetric3 tensor;
    for (const Face& face : faces)
      kernels::add_outer_product(tensor, face.normal[0], face.normal[1], face.normal[2]);
    constexpr double smallest = 0.12;  // twice the squared sine of 14 degrees: two normals 28 degrees apart
    return kernels::eigen_decomposition(tensor).values[2] > smallest;
  }

  /// Steps that change nothing are left out; of several from one sensitivity the last counts.
  void push_step(const Step& step) {
    if (!steps_.empty() && steps_.back().from == step.from) steps_.pop_back();
    if (!steps_.empty() && steps_.back().kind == step.kind && steps_.back().clusters == step.clusters) return;
    steps_.push_back(step);
  }

  struct Change {
    std::uint16_t at;
    int change;
  };

  const PointCloud& cloud_;
  const Neighborhoods& neighborhoods_;
  const GaussOptions& options_;
  int max_clusters_;
  std::vector<int> sizes_;
  double persistence_;
  GaussMap map_;
  FaceWorkspace workspace_;
  std::vector<Face> faces_;
  std::vector<Change> changes_;
  std::vector<Step> steps_;
  std::vector<std::vector<Step>> views_;  // the steps at each of sizes_
  int min_cluster_ = 0;
  double sharpness_ = 0;
  float score_ = 0;
  bool is_peak_ = false;
  bool is_beside_ = false;
};

/// For each line the smallest line of the cluster that it is in when merging stops at the sensitivity.
std::vector<std::uint32_t> clusters_of_lines(const GaussMap& map, std::uint16_t sensitivity) {
  std::vector<std::uint32_t> names(static_cast<std::size_t>(map.lines().count));
  std::iota(names.begin(), names.end(), 0U);
  // Backwards: a cluster's last merge names it, before its parts take over the name.
  for (auto merge = map.merges().rbegin(); merge != map.merges().rend(); ++merge)
    if (merge->height <= sensitivity) names[merge->second] = names[merge->first];
  return names;
}

constexpr std::size_t block_size = 1024;

/// Labels all points on all threads; every block of points has its own list of steps, joined in order.
LabelSpectrum label_points(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                           const GaussOptions& options, Progress& progress, std::vector<float>& score,
                           std::vector<CreaseDirection>& directions) {
  const std::size_t count = cloud.size();
  const std::vector<int> sizes = neighborhood_sizes(options.neighbors, options.scales);
  const std::uint64_t memory = GaussMap::memory(*std::max_element(sizes.begin(), sizes.end()));
  const std::uint64_t threads =
      std::min<std::uint64_t>(static_cast<std::uint64_t>(tbb::this_task_arena::max_concurrency()), count);
  require_memory(threads * memory, fmt::format("Gauss map clustering with {} neighbors on {} threads",
                                               options.neighbors, threads));
  tbb::enumerable_thread_specific<PointLabeler> labelers(
      [&] { return PointLabeler(cloud, neighborhoods, options, progress); });
  const std::size_t blocks = (count + block_size - 1) / block_size;
  std::vector<std::vector<Step>> steps(blocks);
  LabelSpectrum spectrum;
  spectrum.offsets.resize(count + 1);
  score.resize(count);
  directions.resize(count);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, blocks, 1), [&](const tbb::blocked_range<std::size_t>& range) {
        PointLabeler& labeler = labelers.local();
        for (std::size_t block = range.begin(); block < range.end(); ++block) {
          const std::size_t end = std::min(count, (block + 1) * block_size);
          for (std::size_t i = block * block_size; i < end; ++i) {
            progress.check();
            labeler.label(i);
            score[i] = labeler.score();
            // Across a band, too, one point continues another.
            if (options.thin) directions[i] = labeler.direction();
            spectrum.offsets[i + 1] = labeler.steps().size();
            steps[block].insert(steps[block].end(), labeler.steps().begin(), labeler.steps().end());
          }
          progress.advance(end - block * block_size);
        }
      });
  for (std::size_t i = 0; i < count; ++i) spectrum.offsets[i + 1] += spectrum.offsets[i];
  spectrum.from.reserve(spectrum.offsets[count]);
  spectrum.kind.reserve(spectrum.offsets[count]);
  spectrum.clusters.reserve(spectrum.offsets[count]);
  for (std::vector<Step>& block : steps) {
    for (const Step& step : block) {
      spectrum.from.push_back(step.from);
      spectrum.kind.push_back(step.kind);
      spectrum.clusters.push_back(step.clusters);
    }
    std::vector<Step>().swap(block);
  }
  return spectrum;
}

LabelSpectrum spectrum_of_one(std::span<const Step> steps) {
  LabelSpectrum spectrum;
  for (const Step& step : steps) {
    spectrum.from.push_back(step.from);
    spectrum.kind.push_back(step.kind);
    spectrum.clusters.push_back(step.clusters);
  }
  spectrum.offsets.push_back(steps.size());
  return spectrum;
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
  require_usable(cloud, neighborhoods, options);
  progress.begin("gauss", cloud.size());
  std::vector<float> score;
  std::vector<CreaseDirection> directions;
  LabelSpectrum spectrum = label_points(cloud, neighborhoods, options, progress, score, directions);
  if (!options.plain && options.min_support > 0)
    spectrum =
        without_isolated(spectrum, neighborhoods, cloud.positions, directions, options.min_support, progress);
  const bool is_the_papers = options.plain && options.sigma_rule == SigmaRule::Auto;
  FeatureLabels labels = is_the_papers ? relabel(spectrum, default_sigma_deg)
                                       : relabel(spectrum, options.sigma_rule, options.sigma_deg, progress);
  labels.score = std::move(score);
  if (options.keep_spectrum) labels.spectrum = std::move(spectrum);
  return labels;
}

PointGaussMap gauss_map(const PointCloud& cloud, const Neighborhoods& neighborhoods, std::size_t point,
                        const GaussOptions& options, Progress& progress) {
  require_usable(cloud, neighborhoods, options);
  if (point >= cloud.size())
    throw InvalidArgument(fmt::format("point {} of a cloud of {} points", point, cloud.size()));
  PointGaussMap result;
  result.sigma_deg = options.sigma_deg;
  if (options.sigma_rule == SigmaRule::Auto)
    result.sigma_deg = detect_gauss(cloud, neighborhoods, options, progress).sigma_deg;
  PointLabeler labeler(cloud, neighborhoods, options, progress);
  labeler.label(point);
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
