#include "keenline/io/graph_attributes.h"

#include <algorithm>
#include <numeric>

namespace keenline {

LineAttributes attributes_of(const Polyline& line) {
  LineAttributes attributes{.kind = name_of(line.kind),
                            .closed = line.closed,
                            .length = length_of(line),
                            .start_corner = line.start_corner,
                            .end_corner = line.end_corner,
                            .support = line.support};
  const auto& angles = line.dihedral_deg;
  if (!angles.empty()) {
    const double sum = std::accumulate(angles.begin(), angles.end(), 0.0);
    attributes.dihedral_deg = sum / static_cast<double>(angles.size());
  }
  if (!line.residual.empty())
    attributes.residual = *std::max_element(line.residual.begin(), line.residual.end());
  return attributes;
}

}  // namespace keenline
