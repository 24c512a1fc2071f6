#pragma once

#include <optional>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

class NeighborSearch;
struct PointCloud;

struct TensorVotingOptions {
  /// Sigma: votes fade to 1/e over so many spacings around each point, and are collected from
  /// voters_within(voting_scale) neighbours. 1 to 3.7; larger bears more noise and blurs what is closer.
  double voting_scale = 1.5;
  /// How much sooner votes fade that have to bend, in sigma^4. 0 to 100.
  double curvature_weight = 1;
  /// Curve saliency above which a point is sharp. 0 to 1. Empty = choose_threshold().
  std::optional<double> min_curve{};
  /// Junction saliency above which a sharp point is a corner. 0 to 1.
  double min_junction = 0.12;
};

/// Sharp features by tensor voting. First every point casts a ball vote on its neighbours: their sum says at
/// each point which way a surface lies there and how surely. Then every point casts the stick vote of that
/// surface: near an edge votes of both faces meet, and the second eigenvalue of their sum rises.
///
/// Sharp is what has more curve saliency (l2 - l3) / l1 than `min_curve`: a corner where the junction
/// saliency l3 / l1 is above `min_junction`, else an edge. The others are flat where the normals that were
/// voted agree within 6 degrees, be it on a sphere, and curved elsewhere. Points that get less than a tenth
/// of the votes that others get lie beside the surface: curved. Fewer than 16 neighbours: undecided.
///
/// The score is the curve saliency. Papers: Guy, Medioni, "Inference of Surfaces, 3D Curves, and Junctions
/// from Sparse, Noisy, 3D Data", 1997; closed form of ball votes after Wu et al., "A Closed-Form Solution to
/// Tensor Voting", 2012. Departures: see docs/methods/tensor_voting.md. Threads: any number, same bits. Cost:
/// O(n k), k = voters_within(voting_scale). Memory: 64 bytes a point.
/// \pre the search is that of cloud.positions
/// \throw InvalidArgument when an option is out of range; OutOfMemory; Cancelled.
[[nodiscard]] FeatureLabels detect_tensor_voting(const PointCloud& cloud, const NeighborSearch& search,
                                                 const TensorVotingOptions& options = {},
                                                 Progress& progress = no_progress());

}  // namespace keenline
