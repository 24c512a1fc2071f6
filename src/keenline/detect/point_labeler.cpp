#include "keenline/detect/point_labeler.h"

#include <algorithm>
#include <cmath>

#include "keenline/cloud.h"
#include "keenline/detect/crease.h"
#include "keenline/detect/peak.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

using kernels::angle_units_per_degree;

/// Differences of direction below this are of no interest: scores are 0, and such points flat at any
/// sensitivity.
constexpr double smallest_angle = 3 * angle_units_per_degree;

/// The smallest sensitivity that reaches a height: merges happen at heights up to the sensitivity.
std::uint16_t sensitivity_reaching(double height) {
  return static_cast<std::uint16_t>(std::ceil(std::min(height, double{kernels::right_angle})));
}

}  // namespace

PointLabeler::PointLabeler(const PointCloud& cloud, const GaussOptions& options, const Progress& progress)
    : cloud_(cloud),
      options_(options),
      max_clusters_(options.max_clusters.value_or(options.plain ? 4 : 6)),
      sizes_(neighborhood_sizes(options.neighbors, options.plain ? 1 : options.scales)),
      persistence_(options.persistence.value_or(options.thin ? 3 : 2)),
      map_(options.min_sine, progress, options.triangles) {}

void PointLabeler::label(std::size_t point, std::span<const std::uint32_t> neighbors) {
  // The first size last: score and map are its.
  views_.resize(sizes_.size());
  for (std::size_t s = sizes_.size(); s-- > 0;) {
    look(point, neighbors, sizes_[s]);
    if (sizes_.size() > 1) views_[s] = steps_;
  }
  if (sizes_.size() > 1) combine_views();
}

bool PointLabeler::ever_needs_support() const {
  return std::any_of(steps_.begin(), steps_.end(),
                     [](const LabelStep& step) { return needs_support(step.kind); });
}

CreaseDirection PointLabeler::direction() const {
  if (faces_.size() < 2) return {};
  const Point along = cross(faces_[0].normal, faces_[1].normal);
  return length(along) > 0 ? quantized(unit(along)) : CreaseDirection{};
}

const GaussMap& PointLabeler::clustered_map() {
  if (map_.lines().count > 0) map_.cluster();
  return map_;
}

/// Labels the point by the first `size` of the neighbours.
void PointLabeler::look(std::size_t point, std::span<const std::uint32_t> neighbors, int size) {
  steps_.clear();
  faces_.clear();
  score_ = 0;
  map_.clear();
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
    steps_.push_back({0, lone_face_is_half(map_) ? Kind::Border : Kind::Flat, 1});
    return;
  }
  map_.cluster(min_cluster_);
  score_ = sharpness_deg();
  if (options_.plain) count_clusters();
  else read_faces();
}

/// At every sensitivity the majority of the sizes decides whether the point is sharp, the first of those
/// that agree what it is. Sizes for which there are too few points have no say.
void PointLabeler::combine_views() {
  if (views_[0][0].kind == Kind::Undecided) {
    steps_ = views_[0];
    return;
  }
  std::erase_if(views_, [](const std::vector<LabelStep>& view) { return view[0].kind == Kind::Undecided; });
  changes_.clear();
  for (const std::vector<LabelStep>& view : views_)
    for (const LabelStep& step : view) changes_.push_back({step.from, 0});
  std::sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
  steps_.clear();
  for (const Change& change : changes_) {
    const auto step_of = [&](const std::vector<LabelStep>& view) {
      return *std::find_if(view.rbegin(), view.rend(),
                           [&](const LabelStep& s) { return s.from <= change.at; });
    };
    const auto sharp = std::count_if(views_.begin(), views_.end(),
                                     [&](const auto& view) { return is_feature(step_of(view).kind); });
    const bool is_sharp = 2 * sharp > static_cast<std::ptrdiff_t>(views_.size());
    const auto agrees = std::find_if(views_.begin(), views_.end(), [&](const auto& view) {
      return is_feature(step_of(view).kind) == is_sharp;
    });
    const LabelStep step = step_of(*agrees);
    push_step({change.at, step.kind, step.clusters});
  }
}

float PointLabeler::sharpness_deg() {
  sharpness_ = 0;
  for (const kernels::Merge& merge : map_.merges())
    if (is_significant(std::min(merge.first_size, merge.second_size)))
      sharpness_ = std::max(sharpness_, merge.height);
  if (sharpness_ <= smallest_angle) sharpness_ = 0;
  return static_cast<float>(sharpness_ / angle_units_per_degree);
}

/// Section 4 of the paper: the number of significant clusters when merging stops at the sensitivity.
void PointLabeler::count_clusters() {
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

void PointLabeler::push_plain_step(std::uint16_t from, int clusters) {
  Kind kind = Kind::Curved;
  if (clusters == 1) kind = Kind::Flat;
  else if (clusters == 2) kind = Kind::Edge;
  else if (clusters > 2 && clusters <= max_clusters_) kind = Kind::Corner;
  push_step({from, kind, static_cast<std::uint8_t>(std::min(clusters, 255))});
}

/// The refined decision: which faces are there at the sensitivity, and do they all end here?
void PointLabeler::read_faces() {
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

Kind PointLabeler::kind_of(std::span<const Face> faces, std::uint16_t sensitivity) const {
  // Before the faces: the lines of a peak gather in some by chance.
  if (is_peak_ && sharpness_ > sensitivity) return Kind::Peak;
  if (faces.size() == 1) {
    if (faces[0].is_half) return Kind::Border;
    return sharpness_ <= sensitivity ? Kind::Flat : Kind::Curved;
  }
  if (faces.empty() || faces.size() > static_cast<std::size_t>(max_clusters_)) return Kind::Curved;
  const auto ends = [](const Face& face) { return face.ends; };
  if (options_.thin && (is_beside_ || !std::all_of(faces.begin(), faces.end(), ends))) return Kind::Curved;
  return make_corner(map_, faces) ? Kind::Corner : Kind::Edge;
}

/// Steps that change nothing are left out; of several from one sensitivity the last counts.
void PointLabeler::push_step(const LabelStep& step) {
  if (!steps_.empty() && steps_.back().from == step.from) steps_.pop_back();
  if (!steps_.empty() && steps_.back().kind == step.kind && steps_.back().clusters == step.clusters) return;
  steps_.push_back(step);
}

}  // namespace keenline
