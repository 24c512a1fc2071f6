#include "keenline/detect/span_space.h"

namespace keenline {

bool normals_span_space(const kernels::Symmetric3& squares) {
  constexpr double smallest = 0.12;  // twice the squared sine of 14 degrees: two normals 28 degrees apart
  return kernels::eigen_decomposition(squares).values[2] > smallest;
}

}  // namespace keenline
