#include "keenline/kernels/average_linkage.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/kernels/line_angles.h"

#include "support/each_target.h"

namespace keenline::kernels {
namespace {

using Matrix = std::vector<std::uint32_t>;

/// The definition, step by step: look at every pair of clusters, merge the closest, smallest names first.
/// Means are compared as exact fractions and computed anew from all pairs of items each time.
std::vector<Merge> by_definition(const Matrix& distances, std::size_t n) {
  std::vector<std::vector<std::uint32_t>> clusters;
  for (std::uint32_t i = 0; i < n; ++i) clusters.push_back({i});
  std::vector<Merge> merges;
  while (clusters.size() > 1) {
    std::size_t best_a = 0;
    std::size_t best_b = 0;
    std::uint64_t best_sum = 0;
    std::uint64_t best_pairs = 0;
    for (std::size_t a = 0; a < clusters.size(); ++a) {
      for (std::size_t b = a + 1; b < clusters.size(); ++b) {
        std::uint64_t sum = 0;
        for (const std::uint32_t i : clusters[a])
          for (const std::uint32_t j : clusters[b]) sum += distances[i * n + j];
        const std::uint64_t pairs = clusters[a].size() * clusters[b].size();
        if (best_pairs != 0 && sum * best_pairs >= best_sum * pairs) continue;
        std::tie(best_a, best_b, best_sum, best_pairs) = std::tuple(a, b, sum, pairs);
      }
    }
    auto& first = clusters[best_a];
    auto& second = clusters[best_b];
    merges.push_back({first.front(), second.front(), static_cast<std::uint32_t>(first.size()),
                      static_cast<std::uint32_t>(second.size()),
                      static_cast<double>(best_sum) / static_cast<double>(best_pairs)});
    first.insert(first.end(), second.begin(), second.end());
    clusters.erase(clusters.begin() + static_cast<std::ptrdiff_t>(best_b));
  }
  return merges;
}

template <typename Sum>
std::vector<Merge> by_nearest(const Matrix& distances, std::size_t n, int rest = 1) {
  const std::size_t row = row_length(static_cast<int>(n));
  std::vector<Sum> sums(n * row, 4711);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(distances.begin() + static_cast<std::ptrdiff_t>(i * n), n,
                sums.begin() + static_cast<std::ptrdiff_t>(i * row));
  std::vector<Merge> merges(n - 1);
  LinkageWorkspace workspace;
  const auto made = average_linkage(sums.data(), static_cast<int>(n), rest, workspace, merges.data());
  EXPECT_TRUE(made.has_value());
  merges.resize(static_cast<std::size_t>(made.value_or(0)));
  return merges;
}

using Key = std::tuple<double, std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;
std::vector<Key> keys_of(const std::vector<Merge>& merges) {
  std::vector<Key> keys;
  keys.reserve(merges.size());
  for (const Merge& m : merges) keys.emplace_back(m.height, m.first, m.second, m.first_size, m.second_size);
  return keys;
}

std::vector<Key> sorted_keys(const std::vector<Merge>& merges) {
  std::vector<Key> keys = keys_of(merges);
  std::sort(keys.begin(), keys.end());
  return keys;
}

Matrix random_matrix(std::size_t n, std::uint32_t levels, unsigned seed) {
  std::mt19937 generator(seed);
  Matrix distances(n * n, 0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      distances[i * n + j] = distances[j * n + i] =
          static_cast<std::uint32_t>(generator() % levels) * (65520 / levels);
  return distances;
}

TEST(AverageLinkage, ThreeItemsByHand) {
  // 0 and 1 are 10 apart, 2 is 20 and 40 from them: 30 on average.
  const Matrix distances{0, 10, 20, 10, 0, 40, 20, 40, 0};
  const auto merges = by_nearest<std::uint32_t>(distances, 3);
  EXPECT_EQ(sorted_keys(merges), (std::vector<Key>{{10.0, 0, 1, 1, 1}, {30.0, 0, 2, 2, 1}}));
}

TEST(AverageLinkage, TiesMergeTheSmallestIndexFirst) {
  // A path 0 - 1 - 2 with equal steps: 0 and 1 first.
  const Matrix distances{0, 10, 30, 10, 0, 10, 30, 10, 0};
  EXPECT_EQ(sorted_keys(by_nearest<std::uint32_t>(distances, 3)),
            (std::vector<Key>{{10.0, 0, 1, 1, 1}, {20.0, 0, 2, 2, 1}}));
}

TEST(AverageLinkage, EqualsTheDefinitionOnRandomDistances) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const std::size_t n = 2 + seed;
    const Matrix distances = random_matrix(n, 65520, seed);
    const auto expected = sorted_keys(by_definition(distances, n));
    on_each_target([&] {
      EXPECT_EQ(sorted_keys(by_nearest<std::uint32_t>(distances, n)), expected) << "seed " << seed;
    });
    EXPECT_EQ(sorted_keys(by_nearest<std::uint64_t>(distances, n)), expected) << "seed " << seed;
  }
}

TEST(AverageLinkage, EqualsTheDefinitionWhereMostDistancesAreTies) {
  for (const std::uint32_t levels : {1U, 2U, 3U, 5U}) {
    for (unsigned seed = 0; seed < 25; ++seed) {
      const std::size_t n = 3 + seed;
      const Matrix distances = random_matrix(n, levels, seed);
      const auto expected = sorted_keys(by_definition(distances, n));
      on_each_target([&] {
        EXPECT_EQ(sorted_keys(by_nearest<std::uint32_t>(distances, n)), expected)
            << levels << " levels, seed " << seed;
      });
    }
  }
}

TEST(AverageLinkage, HoldsTheLargestSums) {
  const auto n = static_cast<std::size_t>(largest_count_in_32_bits);
  Matrix distances(n * n, 65520);
  for (std::size_t i = 0; i < n; ++i) distances[i * n + i] = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      if ((i < n / 2) == (j < n / 2)) distances[i * n + j] = 0;
  const auto merges = by_nearest<std::uint32_t>(distances, n);
  const auto highest = std::max_element(merges.begin(), merges.end(),
                                        [](const Merge& a, const Merge& b) { return a.height < b.height; });
  EXPECT_EQ(highest->height, 65520);
  EXPECT_EQ(highest->first_size, 256U);
  EXPECT_EQ(highest->second_size, 256U);
}

TEST(AverageLinkage, PartsComeBeforeTheWholeAndAreNotHigher) {
  const Matrix distances = random_matrix(60, 65520, 7);
  std::vector<double> height(60, 0.0);
  std::vector<std::uint32_t> size(60, 1);
  for (const Merge& merge : by_nearest<std::uint32_t>(distances, 60)) {
    EXPECT_EQ(merge.first_size, size[merge.first]);
    EXPECT_EQ(merge.second_size, size[merge.second]);
    EXPECT_GE(merge.height, std::max(height[merge.first], height[merge.second]));
    height[merge.first] = merge.height;
    size[merge.first] += merge.second_size;
  }
  EXPECT_EQ(size[0], 60U);
}

/// Angles between lines that gather around a few directions: none apart within one when `scatter` is 0, so
/// that most distances are 0 or equal.
Matrix gathered_lines(std::size_t n, double scatter, unsigned seed) {
  std::mt19937 generator(seed);
  const auto number = [&] { return static_cast<double>(generator()) * 0x1p-31 - 1; };
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;
  for (std::size_t i = 0; i < n; ++i) {
    double v[3] = {scatter * number(), scatter * number(), scatter * number()};
    v[generator() % 3] += 1;
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    x.push_back(static_cast<float>(v[0] / length));
    y.push_back(static_cast<float>(v[1] / length));
    z.push_back(static_cast<float>(v[2] / length));
  }
  Matrix angles(n * n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      angles[i * n + j] = i == j ? 0 : line_angle(x[i] * x[j] + y[i] * y[j] + z[i] * z[j]);
  return angles;
}

TEST(AverageLinkage, GivesTheSameListOnEveryTargetForAnyNumberOfItems) {
  for (std::size_t n = 1; n <= 150; ++n) {
    const auto seed = static_cast<unsigned>(n);
    for (const Matrix& distances :
         {random_matrix(n, 65520, seed), random_matrix(n, 3, seed), random_matrix(n, 1, seed),
          Matrix(n * n, 0), Matrix(n * n, 65520), gathered_lines(n, 0, seed), gathered_lines(n, 0.05, seed),
          gathered_lines(n, 1, seed)}) {
      std::vector<Key> expected;
      on_each_target([&] {
        const std::vector<Key> found = keys_of(by_nearest<std::uint32_t>(distances, n));
        if (target_is_scalar()) expected = found;
        ASSERT_EQ(found, expected) << n;
      });
    }
  }
}

TEST(AverageLinkage, ComparesMeansThatFloatsCannotTellApart) {
  // Four items far away, at sums that differ by one in 4 * 60000, beside a pair: floats hold 24 bits, and the
  // lower bits of a key are not even looked at.
  for (std::uint32_t extra = 0; extra < 4; ++extra) {
    const std::size_t n = 40;
    Matrix distances(n * n, 65520);
    const auto set = [&](std::size_t i, std::size_t j, std::uint32_t d) {
      distances[i * n + j] = distances[j * n + i] = d;
    };
    for (std::size_t i = 0; i < n; ++i) set(i, i, 0);
    for (std::size_t c = 0; c < 4; ++c)  // clusters of ten
      for (std::size_t i = 10 * c; i < 10 * c + 10; ++i)
        for (std::size_t j = 10 * c; j < i; ++j) set(i, j, 7);
    for (std::size_t i = 0; i < 10;
         ++i)  // the first is as far from all others, but for one unit of 6.5 million
      for (std::size_t c = 1; c < 4; ++c)
        for (std::size_t j = 10 * c; j < 10 * c + 10; ++j) set(i, j, 65000);
    if (extra > 0) set(0, 10 * extra + 9, 64999);
    std::vector<Key> expected = sorted_keys(by_definition(distances, n));
    const auto has_first_partner = [&](std::uint32_t name) {
      return std::any_of(expected.begin(), expected.end(), [&](const Key& key) {
        return std::get<1>(key) == 0 && std::get<2>(key) == name && std::get<4>(key) == 10 &&
               std::get<3>(key) == 10;
      });
    };
    EXPECT_TRUE(has_first_partner(extra == 0 ? 10 : 10 * extra));
    on_each_target(
        [&] { EXPECT_EQ(sorted_keys(by_nearest<std::uint32_t>(distances, n)), expected) << extra; });
  }
}

TEST(AverageLinkage, HoldsTheLargestSumsOfVectors) {
  for (const std::size_t n : {361U, 362U, 363U}) {
    Matrix distances(n * n, 65520);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        if (i % 2 == j % 2) distances[i * n + j] = 0;
    on_each_target([&] {
      const auto merges = by_nearest<std::uint32_t>(distances, n);
      EXPECT_EQ(merges.back().height, 65520);
      EXPECT_EQ(merges.back().first_size, (n + 1) / 2);
      EXPECT_EQ(std::count_if(merges.begin(), merges.end(), [](const Merge& m) { return m.height > 0; }), 1);
    });
  }
}

TEST(AverageLinkage, LeavesOutWhatMakesNoOtherLargeCluster) {
  for (const int rest : {2, 5, 12, 20, 21, 30, 40, 41}) {
    const std::size_t n = 40;
    const Matrix distances = gathered_lines(n, 0.5, 3);
    const std::vector<Key> all = keys_of(by_nearest<std::uint32_t>(distances, n));
    const auto is_large = [&](std::uint32_t size) { return static_cast<int>(size) >= rest; };
    const auto check = [&](const std::vector<Merge>& merges) {
      const std::vector<Key> made = keys_of(merges);
      ASSERT_LE(made.size(), all.size());
      EXPECT_TRUE(std::equal(made.begin(), made.end(), all.begin())) << rest;
      std::uint32_t largest = 1;
      for (const Merge& m : merges) largest = std::max(largest, m.first_size + m.second_size);
      EXPECT_GE(largest, std::min(std::max(n - rest + 1, std::size_t(rest)), n));
      for (std::size_t i = made.size(); i < all.size(); ++i) {
        const auto [height, first, second, first_size, second_size] = all[i];
        EXPECT_FALSE(is_large(first_size) && is_large(second_size)) << rest;
        EXPECT_EQ(is_large(first_size + second_size), is_large(std::max(first_size, second_size))) << rest;
      }
    };
    on_each_target([&] { check(by_nearest<std::uint32_t>(distances, n, rest)); });
    check(by_nearest<std::uint64_t>(distances, n, rest));
  }
}

TEST(AverageLinkage, StopsWhenAsked) {
  on_each_target([] {
    std::vector<std::uint32_t> sums(50 * row_length(50));
    std::vector<Merge> merges(49);
    LinkageWorkspace workspace;
    const auto made =
        average_linkage(sums.data(), 50, 1, workspace, merges.data(), [](const void*) { return true; });
    EXPECT_FALSE(made.has_value());
  });
}

}  // namespace
}  // namespace keenline::kernels
