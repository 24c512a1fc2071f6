#include "keenline/order_statistics.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

TEST(OrderStatistics, AreThoseOfTheSortedValues) {
  const std::vector<double> values{5, 1, 4, 1, 3, 9, 2, 6};
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t n = 0; n < values.size(); ++n) {
    std::vector<double> copy = values;
    EXPECT_EQ(nth_smallest(copy, n), sorted[n]);
    EXPECT_TRUE(std::is_permutation(copy.begin(), copy.end(), values.begin()));
  }
}

TEST(OrderStatistics, OfAnEvenNumberThereAreTwoMedians) {
  std::vector<float> even{4, 1, 3, 2};
  EXPECT_EQ(median(even), 3);
  EXPECT_EQ(lower_median(even), 2);
  std::vector<float> odd{3, 1, 2};
  EXPECT_EQ(median(odd), 2);
  EXPECT_EQ(lower_median(odd), 2);
  std::vector<float> one{7};
  EXPECT_EQ(median(one), 7);
  EXPECT_EQ(lower_median(one), 7);
}

}  // namespace
}  // namespace keenline
