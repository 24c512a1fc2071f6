#pragma once

#include <cstdint>

#include "keenline/synth/vec3.h"

namespace keenline::synth {

/// What random numbers are for: each use has streams of its own, so that one more draw here moves nothing
/// there.
enum class Purpose : std::uint64_t { Position = 1, Noise = 2, Stations = 3 };

/// A stream of random numbers chosen by (seed, purpose, index). One stream per point makes the numbers
/// independent of the order in which threads work. Generator: SplitMix64 (Steele, Lea, Flood 2014).
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t index);

  /// All 64 bits uniform.
  [[nodiscard]] std::uint64_t bits();
  /// Uniform in [0, 1), a multiple of 2^-53.
  [[nodiscard]] double uniform() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }
  /// Mean 0, standard deviation 1.
  [[nodiscard]] double normal();
  /// Three independent normal() coordinates.
  [[nodiscard]] Vec3 normal_vector();

 private:
  std::uint64_t state_;
};

}  // namespace keenline::synth
