#pragma once

#include "keenline/cloud.h"

namespace keenline {

/// Looks at the middle of things from far away (parallel projection), z up.
struct Camera {
  double azimuth_deg = -60;   ///< where the viewer stands: from the x axis counter-clockwise
  double elevation_deg = 25;  ///< above the xy plane
};

/// The camera's own axes, unit vectors.
struct CameraAxes {
  Point right{};
  Point up{};
  Point toward{};  ///< to the viewer
};

/// \throw InvalidArgument unless both angles are finite and the elevation is -90 to 90.
[[nodiscard]] CameraAxes axes_of(const Camera& camera);

}  // namespace keenline
