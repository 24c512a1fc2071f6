#include "keenline/memory.h"

#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

TEST(Memory, PeakGrowsWithUse) {
  const std::uint64_t before = peak_memory();
  ASSERT_GT(before, 0U);
  const std::vector<char> block(std::size_t{200} << 20U, 'x');
  EXPECT_GE(peak_memory() + (std::uint64_t{8} << 20U), before + 1);
  EXPECT_GT(peak_memory(), std::uint64_t{200} << 20U) << static_cast<int>(block[12345]);
}

TEST(Memory, SomeIsAvailable) { EXPECT_GT(available_memory(), std::uint64_t{1} << 20U); }

TEST(Memory, RefusesWhatNoMachineHas) {
  EXPECT_NO_THROW(require_memory(1, "a byte"));
  test::expect_error<OutOfMemory>([] { require_memory(std::uint64_t{1} << 60U, "a dream"); },
                                  "a dream needs 1073741824.0 GiB", "available");
}

}  // namespace
}  // namespace keenline
