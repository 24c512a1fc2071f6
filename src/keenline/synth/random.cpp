#include "keenline/synth/random.h"

#include <cmath>

#include "keenline/kernels/portable_math.h"

namespace keenline::synth {
namespace {

using kernels::natural_log;

constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15U;

std::uint64_t mixed(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, Purpose purpose, std::uint64_t index)
    : state_(mixed(mixed(mixed(seed + golden_gamma) + static_cast<std::uint64_t>(purpose)) + index)) {}

std::uint64_t RandomStream::bits() { return mixed(state_ += golden_gamma); }

double RandomStream::normal() {
  // Marsaglia's polar method. Its second number is thrown away: a stream without memory is simpler to reason
  // about.
  for (;;) {
    const double x = 2 * uniform() - 1;
    const double y = 2 * uniform() - 1;
    const double s = x * x + y * y;
    if (s > 0 && s < 1) return x * std::sqrt(-2 * natural_log(s) / s);
  }
}

Vec3 RandomStream::normal_vector() {
  const double x = normal();
  const double y = normal();
  const double z = normal();
  return {x, y, z};
}

}  // namespace keenline::synth
