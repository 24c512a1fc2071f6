#pragma once

#include <string>

#include "keenline/report/camera.h"
#include "keenline/report/image.h"

namespace keenline {

struct PointGaussMap;

struct GaussSphereOptions {
  Camera camera{35, 25};
  int width = 480;  ///< pixels, 64 to 8192
  int height = 560;
  std::string caption;  ///< one line; empty = none
};

/// The Gauss map of a point on the unit sphere: every line is two opposite dots in the colour of its cluster,
/// strong on the half that faces the viewer, faint on the other; grey where the cluster is not significant.
/// Where several lines of a cluster meet, the dot is larger. With the circles of the coordinate planes, and a
/// legend of the clusters' sizes. \throw InvalidArgument for an option out of range.
[[nodiscard]] Image draw_gauss_sphere(const PointGaussMap& map, const GaussSphereOptions& options = {});

}  // namespace keenline
