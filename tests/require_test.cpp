#include "keenline/require.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <typename Function>
std::string refusal_of(const Function& function) {
  try {
    function();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "";
}

std::string refusal_in_range(double found, double least, double most) {
  return refusal_of([&] { require_in_range("reach", found, least, most); });
}

TEST(Require, SaysWhatWasFoundAndWhatIsExpected) {
  EXPECT_EQ(refusal_of([] { require_option(false, "turn_deg", -1.5, "0 to 90 degrees"); }),
            "turn_deg: found -1.5, expected 0 to 90 degrees");
  EXPECT_EQ(refusal_of([] { require_option(true, "turn_deg", 1, "0 to 90 degrees"); }), "");
}

TEST(Require, RangesIncludeTheirEnds) {
  EXPECT_EQ(refusal_in_range(1, 1, 4.5), "");
  EXPECT_EQ(refusal_in_range(4.5, 1, 4.5), "");
  EXPECT_EQ(refusal_in_range(0.5, 1, 4.5), "reach: found 0.5, expected 1 to 4.5");
  EXPECT_EQ(refusal_in_range(5, 1, 4.5), "reach: found 5, expected 1 to 4.5");
  EXPECT_EQ(refusal_in_range(nan, 1, 4.5), "reach: found nan, expected 1 to 4.5");
}

TEST(Require, RangesMayHaveNoEnd) {
  EXPECT_EQ(refusal_in_range(1e300, 1, infinity), "");
  EXPECT_EQ(refusal_in_range(0, 1, infinity), "reach: found 0, expected 1 or more");
  EXPECT_EQ(refusal_in_range(nan, 1, infinity), "reach: found nan, expected 1 or more");
}

}  // namespace
}  // namespace keenline
