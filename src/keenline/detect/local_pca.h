#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/kernels/symmetric3.h"

namespace keenline {

/// Running sums of a neighbourhood that grows: its covariance at any size costs no second pass.
class GrowingCovariance {
 public:
  void add(const Point& offset);
  /// Of what was added, about its mean and divided by its number. \pre something was added
  [[nodiscard]] kernels::Symmetric3 covariance() const;
  [[nodiscard]] Point mean() const;

 private:
  double count_ = 0;
  Point sum_{};
  kernels::Symmetric3 squares_;
};

/// Eigenvalues as the papers number them: variance[0] <= variance[1] <= variance[2], none below 0, each with
/// its axis, a unit vector up to its sign. axis[0] estimates the normal of the surface.
struct PrincipalComponents {
  std::array<double, 3> variance{};
  std::array<Point, 3> axis{};

  [[nodiscard]] double total() const { return variance[0] + variance[1] + variance[2]; }
};

/// \pre all entries are finite
[[nodiscard]] PrincipalComponents principal_components(const kernels::Symmetric3& covariance);

/// variance[0] / total(), 0 to 1/3: Pauly, Gross, Kobbelt 2002, "Efficient simplification of point-sampled
/// surfaces", section 2. 0 where all points coincide.
[[nodiscard]] double surface_variation(const PrincipalComponents& components);

/// The widest sector, in degrees, 0 to 360, that no offset lies in, seen along the normal from the point that
/// the offsets start at: about 180 on the rim of an open surface. `angles` is working memory. 360 where no
/// offset has a direction in the plane.
[[nodiscard]] double widest_gap_deg(std::span<const Point> offsets, const PrincipalComponents& components,
                                    std::vector<double>& angles);

}  // namespace keenline
