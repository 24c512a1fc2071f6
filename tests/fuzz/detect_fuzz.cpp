// Bytes taken as coordinates, any bit pattern, go all the way to labels.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "keenline/cloud.h"
#include "keenline/detect/gauss.h"
#include "keenline/neighborhood/neighborhoods.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The first byte chooses how coordinates are made: any doubles, or small integers (ties, duplicates,
  // planes).
  if (size == 0) return 0;
  const bool any_double = (data[0] & 1U) != 0;
  const std::size_t width = any_double ? sizeof(double) : 1;
  const std::size_t points = std::min<std::size_t>((size - 1) / (3 * width), 200);
  keenline::PointCloud cloud;
  const std::uint8_t* next = data + 1;
  for (std::size_t i = 0; i < points; ++i) {
    keenline::Point p{};
    for (double& coordinate : p) {
      if (any_double) std::memcpy(&coordinate, next, sizeof(double));
      else coordinate = *next % 7;
      next += width;
    }
    cloud.positions.push_back(p);
  }
  const keenline::Neighborhoods neighborhoods = keenline::find_neighborhoods(cloud, 8);
  keenline::GaussOptions options;
  options.neighbors = 8;
  const keenline::FeatureLabels labels = keenline::detect_gauss(cloud, neighborhoods, options);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool finite = keenline::is_finite(cloud.positions[i]);
    if (!finite && labels.kind[i] != keenline::Kind::Undecided) std::abort();
    if (!(labels.score[i] >= 0 && labels.score[i] <= 90)) std::abort();
  }
  return 0;
}
