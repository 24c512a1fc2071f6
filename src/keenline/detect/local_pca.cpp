#include "keenline/detect/local_pca.h"

#include <algorithm>

#include "keenline/kernels/portable_math.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/vectors.h"

namespace keenline {

void GrowingCovariance::add(const Point& offset) {
  count_ += 1;
  sum_ = sum(sum_, offset);
  add_square(squares_, offset, 1);
}

Point GrowingCovariance::mean() const { return {sum_[0] / count_, sum_[1] / count_, sum_[2] / count_}; }

kernels::Symmetric3 GrowingCovariance::covariance() const {
  kernels::Symmetric3 result{squares_.xx / count_, squares_.xy / count_, squares_.xz / count_,
                             squares_.yy / count_, squares_.yz / count_, squares_.zz / count_};
  add_square(result, mean(), -1);
  return result;
}

PrincipalComponents principal_components(const kernels::Symmetric3& covariance) {
  const kernels::Eigen3 eigen = kernels::eigen_decomposition(covariance);
  PrincipalComponents result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.variance[i] = std::max(0.0, eigen.values[2 - i]);  // rounding may go below
    result.axis[i] = eigen.vectors[2 - i];
  }
  return result;
}

double surface_variation(const PrincipalComponents& components) {
  const double total = components.total();
  return total > 0 ? components.variance[0] / total : 0;
}

double widest_gap_deg(std::span<const Point> offsets, const PrincipalComponents& components,
                      std::vector<double>& angles) {
  angles.clear();
  for (const Point& offset : offsets) {
    const double x = dot(offset, components.axis[2]);
    const double y = dot(offset, components.axis[1]);
    if (x != 0 || y != 0) angles.push_back(kernels::angle_of(y, x));
  }
  if (angles.empty()) return 360;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2 * kernels::pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
  return widest * (180 / kernels::pi);
}

}  // namespace keenline
