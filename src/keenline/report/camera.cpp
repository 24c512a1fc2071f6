#include "keenline/report/camera.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "keenline/errors.h"

namespace keenline {

CameraAxes axes_of(const Camera& camera) {
  if (!std::isfinite(camera.azimuth_deg) || !(std::abs(camera.elevation_deg) <= 90)) {
    throw InvalidArgument(
        fmt::format("view {},{}: expected an azimuth and an elevation of -90 to 90, in degrees",
                    camera.azimuth_deg, camera.elevation_deg));
  }
  const double azimuth = camera.azimuth_deg * std::numbers::pi / 180;
  const double elevation = camera.elevation_deg * std::numbers::pi / 180;
  const double ca = std::cos(azimuth);
  const double sa = std::sin(azimuth);
  const double ce = std::cos(elevation);
  const double se = std::sin(elevation);
  return {{-sa, ca, 0}, {-se * ca, -se * sa, ce}, {ce * ca, ce * sa, se}};
}

}  // namespace keenline
