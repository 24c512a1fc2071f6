#include "keenline/kernels/target.h"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"

namespace keenline::kernels {
namespace {

TEST(Target, EverySupportedOneAnswersWhenItIsAskedFor) {
  const std::string before(target());
  const auto names = supported_targets();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.front(), "scalar");
  for (const auto name : names) {
    use_target(name);
    EXPECT_EQ(target(), name);
    EXPECT_EQ(target_is_scalar(), name == "scalar");
  }
  use_target(before);
  EXPECT_EQ(target(), before);
}

TEST(Target, AnUnknownOneIsRefusedAndChangesNothing) {
  const std::string before(target());
  for (const char* const name : {"", "AVX2", "avx1024", "neon,scalar"}) {
    EXPECT_THROW(use_target(name), InvalidArgument) << name;
    EXPECT_EQ(target(), before);
  }
}

#if defined(__x86_64__)
TEST(Target, EveryTargetThatTheCompilerSeesInThisCpuIsThere) {
  const auto names = supported_targets();
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  EXPECT_EQ(has("sse4"), __builtin_cpu_supports("sse4.2") != 0);
  EXPECT_EQ(has("avx2"), __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0);
  EXPECT_FALSE(has("neon"));
}
#endif

}  // namespace
}  // namespace keenline::kernels
