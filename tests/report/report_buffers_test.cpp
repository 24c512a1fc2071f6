#include "keenline/report/report_buffers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "support/report_file.h"

namespace keenline {
namespace {

template <typename T>
ReportBuffer buffer(const std::vector<T>& values, std::size_t components, BufferCoding coding) {
  return encoded("numbers", std::span<const T>(values), components, coding);
}

TEST(ReportBuffers, BytesLieAsTheirCodingSays) {
  const std::vector<std::uint16_t> pairs{0x0102, 0x0304, 0x0506, 0x0708};
  EXPECT_EQ(buffer(pairs, 2, BufferCoding::Raw).bytes, "\x02\x01\x04\x03\x06\x05\x08\x07");
  // Of the first component the lowest bytes, then the second; then the other component.
  EXPECT_EQ(buffer(pairs, 2, BufferCoding::Planes).bytes, "\x02\x06\x01\x05\x04\x08\x03\x07");
  const std::vector<std::uint8_t> falling{5, 4, 6, 6};
  EXPECT_EQ(buffer(falling, 1, BufferCoding::Delta).bytes, std::string("\x0a\x01\x04\x00", 4));
}

TEST(ReportBuffers, SmallDifferencesBecomeSmallNumbers) {
  EXPECT_EQ(folded<std::uint32_t>(0), 0U);
  EXPECT_EQ(folded<std::uint32_t>(0U - 1), 1U);
  EXPECT_EQ(folded<std::uint32_t>(1), 2U);
  EXPECT_EQ(folded<std::uint16_t>(static_cast<std::uint16_t>(-300)), 599U);
  EXPECT_EQ(folded<std::uint8_t>(128), 255U);
}

template <typename T>
void expect_all_back() {
  std::mt19937 random(7);
  std::vector<T> values{0, std::numeric_limits<T>::max(), 1, 0, std::numeric_limits<T>::max() / 2 + 1, 0};
  for (int i = 0; i < 3000; ++i) values.push_back(static_cast<T>(random()));
  for (const std::size_t components : {1U, 2U, 3U, 6U}) {
    for (const BufferCoding coding : {BufferCoding::Raw, BufferCoding::Planes, BufferCoding::Delta}) {
      const ReportBuffer packed = buffer(values, components, coding);
      EXPECT_EQ(packed.count * components, values.size());
      EXPECT_EQ(packed.type, scalar_type_of<T>());
      const std::vector<std::uint32_t> back = test::decoded(packed);
      EXPECT_TRUE(std::equal(back.begin(), back.end(), values.begin(), values.end())) << name_of(coding);
    }
  }
}

TEST(ReportBuffers, EveryNumberComesBack) {
  expect_all_back<std::uint8_t>();
  expect_all_back<std::uint16_t>();
  expect_all_back<std::uint32_t>();
}

TEST(ReportBuffers, NothingIsNothing) {
  const ReportBuffer none = buffer<std::uint32_t>({}, 3, BufferCoding::Delta);
  EXPECT_EQ(none.count, 0U);
  EXPECT_EQ(none.bytes, "");
}

}  // namespace
}  // namespace keenline
