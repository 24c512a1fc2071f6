#pragma once

#include <string>

#include "keenline/cloud.h"
#include "keenline/feature_graph.h"
#include "keenline/labels.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"

namespace keenline::test {

/// A cloud with its true labels: what a detector would say that is never wrong.
struct LabelledShape {
  SynthCloud synth;
  FeatureLabels labels;
  double spacing = 0;
};

inline LabelledShape labelled_shape(const SynthOptions& options) {
  LabelledShape shape{synthesize(options), {}, 0};
  const PointCloud& cloud = shape.synth.cloud;
  for (const std::uint8_t kind : cloud.attribute("truth_kind")->values<std::uint8_t>())
    shape.labels.kind.push_back(static_cast<Kind>(kind));
  shape.labels.score.assign(cloud.size(), 1.0F);
  shape.spacing = estimate_spacing(cloud, NeighborSearch(cloud.positions));
  return shape;
}

inline LabelledShape labelled_shape(const std::string& name, std::uint64_t points, double noise = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise;
  return labelled_shape(options);
}

}  // namespace keenline::test
