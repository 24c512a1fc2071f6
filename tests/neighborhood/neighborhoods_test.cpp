#include "keenline/neighborhood/neighborhoods.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/errors.h"

#include "support/cancelled_progress.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Every pair, sorted: what find_neighborhoods() must equal. long double squares neither overflow nor vanish.
std::vector<std::uint32_t> brute_force(const PointCloud& cloud, std::size_t query, std::size_t count) {
  std::vector<std::pair<long double, std::uint32_t>> others;
  const Point& p = cloud.positions[query];
  if (!is_finite(p)) return {};
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Point& q = cloud.positions[i];
    if (!is_finite(q) || q == p) continue;
    long double distance = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const long double d = static_cast<long double>(q[axis]) - static_cast<long double>(p[axis]);
      distance += d * d;
    }
    others.emplace_back(distance, static_cast<std::uint32_t>(i));
  }
  std::sort(others.begin(), others.end());
  std::vector<std::uint32_t> nearest;
  for (std::size_t i = 0; i < std::min(count, others.size()); ++i) nearest.push_back(others[i].second);
  return nearest;
}

void expect_equals_brute_force(const PointCloud& cloud, int count) {
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, count);
  ASSERT_EQ(neighborhoods.size(), cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto found = neighborhoods.of(i);
    ASSERT_EQ(std::vector<std::uint32_t>(found.begin(), found.end()),
              brute_force(cloud, i, static_cast<std::size_t>(count)))
        << "point " << i;
  }
}

PointCloud random_cloud(std::size_t size, unsigned seed) {
  std::mt19937 generator(seed);
  PointCloud cloud;
  const auto coordinate = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  for (std::size_t i = 0; i < size; ++i)
    cloud.positions.push_back({coordinate(), coordinate(), coordinate()});
  return cloud;
}

TEST(Neighborhoods, EqualBruteForceOnRandomPoints) {
  for (const int count : {3, 16, 255}) expect_equals_brute_force(random_cloud(600, 1), count);
}

TEST(Neighborhoods, OrderTiesByIndexOnAGrid) {
  PointCloud cloud;
  std::mt19937 generator(2);
  for (int x = 0; x < 9; ++x)
    for (int y = 0; y < 9; ++y)
      for (int z = 0; z < 9; ++z) cloud.positions.push_back({double(x), double(y), double(z)});
  std::shuffle(cloud.positions.begin(), cloud.positions.end(), generator);
  for (const int count : {5, 16, 20}) expect_equals_brute_force(cloud, count);
}

TEST(Neighborhoods, LeaveOutCoincidentPointsButKeepDuplicatesOfOthers) {
  PointCloud cloud = random_cloud(60, 3);
  for (int copy = 0; copy < 4; ++copy)
    for (std::size_t i = 0; i < 60; i += 2) cloud.positions.push_back(cloud.positions[i]);
  cloud.positions.push_back({0.0, 0.0, 0.0});
  cloud.positions.push_back({-0.0, 0.0, -0.0});  // the same place
  expect_equals_brute_force(cloud, 16);
}

TEST(Neighborhoods, NonFinitePointsTakeNoPart) {
  PointCloud cloud = random_cloud(80, 4);
  cloud.positions[3] = {nan, 0, 0};
  cloud.positions[40] = {0.5, infinity, 0.5};
  cloud.positions[79] = {0.5, 0.5, -infinity};
  expect_equals_brute_force(cloud, 16);
  EXPECT_TRUE(find_neighborhoods(cloud, 16).of(40).empty());
}

TEST(Neighborhoods, GiveWhatThereIsInSmallClouds) {
  for (std::size_t size = 0; size < 6; ++size) expect_equals_brute_force(random_cloud(size, 5), 4);
  PointCloud same;
  same.positions.assign(1000, {1, 2, 3});
  expect_equals_brute_force(same, 16);
  PointCloud only_nan;
  only_nan.positions.assign(20, {nan, nan, nan});
  expect_equals_brute_force(only_nan, 16);
}

TEST(Neighborhoods, DoNotDependOnScaleOrOnOneFarPoint) {
  const PointCloud cloud = random_cloud(300, 6);
  const Neighborhoods expected = find_neighborhoods(cloud, 16);
  for (const int exponent : {-1000, -660, 660, 1020}) {
    PointCloud scaled = cloud;
    for (Point& p : scaled.positions)
      for (double& c : p) c = std::ldexp(c, exponent);
    EXPECT_EQ(find_neighborhoods(scaled, 16).indices, expected.indices) << "2^" << exponent;
  }
  for (const double far : {1e30, 1e308}) {
    PointCloud with_outlier = cloud;
    with_outlier.positions.push_back({far, -far, far});
    const Neighborhoods found = find_neighborhoods(with_outlier, 16);
    EXPECT_TRUE(std::equal(expected.indices.begin(), expected.indices.end(), found.indices.begin())) << far;
    EXPECT_EQ(found.of(300).size(), 16U);
  }
}

TEST(Neighborhoods, SpanClustersOfVeryDifferentSizeAndPlace) {
  const PointCloud cloud = random_cloud(300, 6);
  const Neighborhoods expected = find_neighborhoods(cloud, 16);
  PointCloud both = cloud;
  for (const Point& p : cloud.positions) both.positions.push_back({1e200, p[1], p[2]});
  PointCloud tiny = cloud;
  for (Point& p : tiny.positions)
    for (double& c : p) c *= 0x1p-660;
  tiny.positions.insert(tiny.positions.end(), cloud.positions.begin(), cloud.positions.end());
  for (const PointCloud& two : {both, tiny}) {
    const Neighborhoods found = find_neighborhoods(two, 16);
    EXPECT_TRUE(std::equal(expected.indices.begin(), expected.indices.end(), found.indices.begin()));
  }
}

TEST(Neighborhoods, LoseNothingFarFromTheOrigin) {
  // Millimetres at ten thousand kilometres: neighbouring doubles are 2 nm apart there, neighbouring floats a
  // metre.
  PointCloud cloud = random_cloud(300, 7);
  for (Point& p : cloud.positions)
    for (double& c : p) c = std::round(c * 100) * 0.001 + 1e7;
  expect_equals_brute_force(cloud, 16);
}

TEST(Neighborhoods, AreTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = random_cloud(20000, 8);
  const Neighborhoods expected = find_neighborhoods(cloud, 16);
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Neighborhoods found = find_neighborhoods(cloud, 16);
    EXPECT_EQ(found.indices, expected.indices);
    EXPECT_EQ(found.offsets, expected.offsets);
  }
}

TEST(Neighborhoods, RefuseCountsOutOfRange) {
  const PointCloud cloud = random_cloud(10, 9);
  EXPECT_THROW((void)find_neighborhoods(cloud, 2), InvalidArgument);
  EXPECT_THROW((void)find_neighborhoods(cloud, 256), InvalidArgument);
}

TEST(Neighborhoods, CanBeCancelled) {
  test::CancelledProgress progress;
  EXPECT_THROW((void)find_neighborhoods(random_cloud(100, 10), 16, progress), Cancelled);
}

/// Gives up at the n-th question whether to.
class Patient : public Progress {
 public:
  explicit Patient(int questions) : questions_(questions) {}
  void advance(std::uint64_t /*units*/) override { advanced = true; }
  [[nodiscard]] bool cancelled() const override { return --questions_ <= 0; }
  std::atomic<bool> advanced = false;

 private:
  mutable std::atomic<int> questions_;
};

TEST(Neighborhoods, CanBeCancelledBeforeTheFirstQuery) {
  const PointCloud cloud = random_cloud(20000, 11);
  for (const int questions : {2, 20, 100}) {  // in the sort and while the tree grows
    Patient progress(questions);
    EXPECT_THROW((void)find_neighborhoods(cloud, 16, progress), Cancelled);
    EXPECT_FALSE(progress.advanced);
  }
}

}  // namespace
}  // namespace keenline
