#include "keenline/kernels/target.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <string>

#include <fmt/format.h>

#include "keenline/errors.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "keenline/kernels/target.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// Compiled once for every target.
HWY_BEFORE_NAMESPACE();
namespace keenline::kernels::HWY_NAMESPACE {
namespace {

std::int64_t own_bit() { return HWY_TARGET; }

}  // namespace
}  // namespace keenline::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace keenline::kernels {
namespace {

HWY_EXPORT(own_bit);

struct Target {
  std::string_view name;
  std::int64_t bit;  // Highway's; 0 = none of its targets, but our own plain C++
};

// Slowest first. Highway's own emulation of vectors is not among them: plain C++ is faster.
constexpr std::array targets {
  Target{"scalar", 0},
#if HWY_ARCH_X86
      Target{"sse4", HWY_SSE4}, Target{"avx2", HWY_AVX2}, Target{"avx512", HWY_AVX3},
#elif HWY_ARCH_ARM
      Target{"neon", HWY_NEON},
#endif
};

bool is_supported(const Target& target) {
  static const std::int64_t here = hwy::SupportedTargets() & HWY_TARGETS;
  return target.bit == 0 || (here & target.bit) != 0;
}

const Target& target_named(std::string_view name, std::string_view origin) {
  for (const Target& target : targets)
    if (target.name == name && is_supported(target)) return target;
  throw InvalidArgument(fmt::format("{}: found {}, expected one of {}", origin, quoted(name),
                                    fmt::join(supported_targets(), ", ")));
}

void activate(const Target& target) {
  if (target.bit != 0) hwy::GetChosenTarget().Update(target.bit);
}

const Target& initial_target() {
  const char* const name = std::getenv("KEENLINE_TARGET");
  const Target* chosen = targets.data();
  if (name != nullptr) {
    chosen = &target_named(name, "KEENLINE_TARGET");
  } else {
    for (const Target& target : targets)
      if (is_supported(target)) chosen = &target;
  }
  activate(*chosen);
  return *chosen;
}

std::atomic<const Target*>& current() {
  static std::atomic<const Target*> target = &initial_target();
  return target;
}

}  // namespace

std::string_view target() {
  if (target_is_scalar()) return "scalar";
  // Not what was asked for but what answers.
  const std::int64_t running = HWY_DYNAMIC_DISPATCH(own_bit)();
  for (const Target& target : targets)
    if (target.bit == running) return target.name;
  return hwy::TargetName(running);
}

bool target_is_scalar() { return current().load(std::memory_order_relaxed)->bit == 0; }

std::vector<std::string_view> supported_targets() {
  std::vector<std::string_view> names;
  for (const Target& target : targets)
    if (is_supported(target)) names.push_back(target.name);
  return names;
}

void use_target(std::string_view name) {
  const Target& target = target_named(name, "target");
  current() = &target;  // first, because it may have to be initialised
  activate(target);
}

}  // namespace keenline::kernels
#endif
