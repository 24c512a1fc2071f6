#pragma once

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/progress.h"

namespace keenline {

struct TraceTensorVotingOptions {
  /// Sigma of the votes, in spacings around each point; 1 to 3.7.
  double voting_scale = 1.5;
  double curvature_weight = 1;  ///< see TensorVotingOptions; 0 to 100
  double gap = 4;               ///< 1 to 4.5 spacings without a candidate that a walk bridges
  double close_reach = 10;      ///< 0 to 100 spacings from the end of a curve to the one that it runs into
  double min_branch = 5;        ///< 0 to 1000 spacings: shorter curves that end loose are noise
};

/// Extremal curves of curve saliency, in sparse form: from the candidate of the highest saliency on, curves
/// are walked along the tangents e3 that tensor voting gives the candidates around, both ways, and each
/// vertex is drawn to the middle of the saliency across its tangent. What a curve has passed starts none. An
/// end is connected to what it runs into; junctions near each other become one. Lines are creases;
/// vertices, corners and support are filled in.
/// Paper: Guy, Medioni, "Inference of Surfaces, 3D Curves, and Junctions from Sparse, Noisy, 3D Data", 1997,
/// whose curves are marched on a dense field. Departures: see docs/methods/tensor_voting.md.
/// \param spacing of the cloud, see estimate_spacing(); nothing is traced unless it is more than 0
/// \pre search is in the cloud's positions
/// \throw InvalidArgument when an option is out of range or labels are not those of the cloud; OutOfMemory;
/// Cancelled.
/// Threads: any number, same bits. Cost: O(candidates k), k = voters_within(voting_scale). Memory: that of
/// Candidates, 32 bytes a point, 200 per candidate.
[[nodiscard]] FeatureGraph trace_tensor_voting(const PointCloud& cloud, const NeighborSearch& search,
                                               const FeatureLabels& labels, double spacing,
                                               const TraceTensorVotingOptions& options = {},
                                               Progress& progress = no_progress());

}  // namespace keenline
