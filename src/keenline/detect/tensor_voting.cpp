#include "keenline/detect/tensor_voting.h"

#include <cstdint>
#include <span>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "keenline/cloud.h"
#include "keenline/detect/threshold.h"
#include "keenline/detect/voters.h"
#include "keenline/kernels/tensor_votes.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/order_statistics.h"
#include "keenline/require.h"

namespace keenline {
namespace {

void require_usable(const TensorVotingOptions& options) {
  require_in_range("voting_scale", options.voting_scale, 1, largest_voting_scale);
  require_in_range("curvature_weight", options.curvature_weight, 0, 100);
  if (options.min_curve) require_in_range("min_curve", *options.min_curve, 0, 1);
  require_in_range("min_junction", options.min_junction, 0, 1);
}

/// What was voted at a point.
struct Election {
  double votes = -1;  // trace of the tensor; none below 0
  kernels::Saliency saliency;
};

class TensorVoting {
 public:
  TensorVoting(const PointCloud& cloud, const NeighborSearch& search, const TensorVotingOptions& options,
               Progress& progress)
      : cloud_(cloud), search_(search), options_(options), progress_(progress) {}

  std::vector<Election> run() {
    std::vector<Stick> sticks(cloud_.size());
    for_each_point([&](std::size_t i, const Voters& voters) { sticks[i] = voters.stick_from_balls(); });
    std::vector<Election> elections(cloud_.size());
    for_each_point([&](std::size_t i, const Voters& voters) {
      elections[i] = elect(voters.stick_votes(sticks, options_.curvature_weight));
    });
    return elections;
  }

 private:
  /// Calls visit(point, voters) for all points that have voters.
  template <typename Visit>
  void for_each_point(const Visit& visit) {
    search_.for_each_block(
        voters_within(options_.voting_scale),
        [&](std::span<const std::uint32_t> points, const Neighborhoods& neighborhoods) {
          Voters& voters = voters_.local();
          for (std::size_t i = 0; i < points.size(); ++i)
            if (voters.gather(cloud_.positions, points[i], neighborhoods.of(i), options_.voting_scale))
              visit(points[i], voters);
        },
        progress_);
  }

  static Election elect(const kernels::Symmetric3& tensor) {
    return {kernels::trace(tensor), kernels::saliency_of(kernels::eigen_decomposition(tensor))};
  }

  const PointCloud& cloud_;
  const NeighborSearch& search_;
  const TensorVotingOptions& options_;
  Progress& progress_;
  tbb::enumerable_thread_specific<Voters> voters_;
};

/// Below, a point gets so few votes that it is not part of the surface.
double fewest_votes(std::span<const Election> elections) {
  std::vector<double> votes;
  for (const Election& election : elections)
    if (election.votes >= 0) votes.push_back(election.votes);
  return votes.empty() ? 0 : 0.1 * median(votes);
}

Kind kind_of(const Election& election, double fewest, double min_curve, double min_junction) {
  if (election.votes < 0) return Kind::Undecided;
  if (election.votes < fewest) return Kind::Curved;
  if (election.saliency.curve > min_curve)
    return election.saliency.junction > min_junction ? Kind::Corner : Kind::Edge;
  constexpr double scatter = 0.01;  // l2 / l1 of normals that scatter by 6 degrees: the squared tangent
  return 1 - election.saliency.surface < scatter ? Kind::Flat : Kind::Curved;
}

}  // namespace

FeatureLabels detect_tensor_voting(const PointCloud& cloud, const NeighborSearch& search,
                                   const TensorVotingOptions& options, Progress& progress) {
  require_usable(options);
  require_memory(cloud.size() * (sizeof(Stick) + sizeof(Election)), "tensor voting");
  progress.begin("tensor_voting", 2 * cloud.size());
  const std::vector<Election> elections = TensorVoting(cloud, search, options, progress).run();
  FeatureLabels labels;
  labels.score.reserve(cloud.size());
  for (const Election& election : elections)
    labels.score.push_back(static_cast<float>(election.saliency.curve));
  labels.threshold = options.min_curve ? *options.min_curve : choose_threshold(labels.score, 0.07, 0.2);
  const double fewest = fewest_votes(elections);
  labels.kind.reserve(cloud.size());
  for (const Election& election : elections)
    labels.kind.push_back(kind_of(election, fewest, labels.threshold, options.min_junction));
  return labels;
}

}  // namespace keenline
