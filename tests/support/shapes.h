#pragma once

#include <cstdint>
#include <string>

#include "keenline/cloud.h"
#include "keenline/synth/synth.h"

namespace keenline::test {

/// Random points of a shape, with noise in spacings.
inline PointCloud shape(const std::string& name, std::uint64_t points, double noise_h = 0) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options).cloud;
}

}  // namespace keenline::test
