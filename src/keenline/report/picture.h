#pragma once

#include <string>

#include "keenline/cloud.h"
#include "keenline/progress.h"
#include "keenline/report/camera.h"
#include "keenline/report/image.h"

namespace keenline {

struct FeatureGraph;

struct PictureOptions {
  Camera camera;
  int width = 800;   ///< pixels, 64 to 8192
  int height = 600;  ///< with caption and legend
  /// Attribute that the points are coloured by. "kind" and "truth_kind" have a colour for each Kind and bring
  /// sharp points and borders to the front; others are shown from their smallest to their largest finite
  /// value. Empty = kind where the cloud has it and no lines are drawn, else one colour.
  std::string color;
  /// Drawn in front of the surface that they lie on, corners as balls; it must outlive the drawing.
  const FeatureGraph* lines = nullptr;
  std::string caption;  ///< one line; empty = none
};

/// The cloud as it looks: every finite point a shaded disc, as large as the gaps to its nearest neighbours,
/// so that surfaces are closed and hide what lies behind them; under it a legend with counts. Same cloud and
/// options, same pixels, any number of threads. Any finite coordinates; an empty cloud is a picture without
/// points. Cost: O(n log n) and the pixels.
/// \throw InvalidArgument for an option out of range, an attribute that is not there, is a list, or holds a
/// number that is no kind; OutOfMemory; Cancelled.
[[nodiscard]] Image draw_cloud(const PointCloud& cloud, const PictureOptions& options = {},
                               Progress& progress = no_progress());

}  // namespace keenline
