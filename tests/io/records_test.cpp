#include "keenline/io/records.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/progress.h"

#include "support/bytes.h"
#include "support/cancelled_progress.h"

namespace keenline {
namespace {

TEST(Records, SwapsBytes) {
  EXPECT_EQ(byte_swapped(std::uint8_t{0x12}), 0x12);
  EXPECT_EQ(byte_swapped(std::int16_t{0x1234}), 0x3412);
  EXPECT_EQ(byte_swapped(std::uint32_t{0x12345678}), 0x78563412U);
  EXPECT_EQ(byte_swapped(std::uint64_t{0x0123456789ABCDEF}), 0xEFCDAB8967452301U);
}

TEST(Records, LoadsAtAnyAlignment) {
  const std::string big("\xFF\x3F\xF8\0\0\0\0\0\0", 9);
  EXPECT_EQ(load<double>(big.data() + 1, std::endian::big), 1.5);
  const std::string little("\xFF\x01\x02\x03\x04", 5);
  EXPECT_EQ(load<std::uint32_t>(little.data() + 1), 0x04030201U);
}

TEST(Records, StoresLittleEndian) {
  std::string bytes(5, '\xFF');
  store(std::uint32_t{0x04030201}, bytes.data() + 1);
  EXPECT_EQ(bytes, "\xFF\x01\x02\x03\x04");
}

TEST(Records, TellsWhichIntegersADoubleHolds) {
  constexpr std::int64_t limit = std::int64_t{1} << 53;
  EXPECT_TRUE(is_exact_in_double(limit));
  EXPECT_FALSE(is_exact_in_double(limit + 1));
  EXPECT_TRUE(is_exact_in_double(-limit - 2));
  EXPECT_FALSE(is_exact_in_double(-limit - 1));
  EXPECT_FALSE(is_exact_in_double(std::numeric_limits<std::int64_t>::max()));
  EXPECT_TRUE(is_exact_in_double(std::numeric_limits<std::int64_t>::min()));
  EXPECT_FALSE(is_exact_in_double(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_TRUE(is_exact_in_double(std::uint64_t{1} << 63));
  EXPECT_TRUE(is_exact_in_double(std::int32_t{-7}));
}

/// Records of { uint8, 2 x int16, float64 }, more than one block of them.
TEST(Records, AreTakenApartInBothByteOrders) {
  constexpr std::size_t count = 100000;
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    test::Bytes bytes({}, order);
    for (std::size_t i = 0; i < count; ++i)
      bytes.add(static_cast<std::uint8_t>(i), static_cast<std::int16_t>(i), static_cast<std::int16_t>(-7),
                0.5 * static_cast<double>(i));
    std::vector<std::uint8_t> first(count);
    std::vector<std::int16_t> pairs(2 * count);
    std::vector<double> last(count);
    const auto target = [](auto& values) { return reinterpret_cast<std::byte*>(values.data()); };
    const std::vector<RecordField> fields{{0, ScalarType::UInt8, 1, target(first)},
                                          {1, ScalarType::Int16, 2, target(pairs)},
                                          {5, ScalarType::Float64, 1, target(last)}};
    unpack_records({bytes.str().data(), count, 13, order}, fields, no_progress());
    for (std::size_t i = 0; i < count; ++i) {
      ASSERT_EQ(first[i], static_cast<std::uint8_t>(i));
      ASSERT_EQ(pairs[2 * i], static_cast<std::int16_t>(i));
      ASSERT_EQ(pairs[2 * i + 1], -7);
      ASSERT_EQ(last[i], 0.5 * static_cast<double>(i));
    }
  }
}

TEST(Records, CanBeCancelled) {
  const std::string bytes(1000, '\0');
  std::vector<std::byte> target(1000);
  const std::vector<RecordField> fields{{0, ScalarType::UInt8, 1, target.data()}};
  test::CancelledProgress progress;
  EXPECT_THROW(unpack_records({bytes.data(), 1000, 1}, fields, progress), Cancelled);
}

}  // namespace
}  // namespace keenline
