#include "keenline/evaluate/evaluate.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "keenline/errors.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

using test::expect_error;

template <typename T>
PointCloud cloud_with(const std::string& name, const std::vector<T>& values) {
  PointCloud cloud;
  cloud.positions.resize(values.size());
  cloud.set_attribute(Column(name, values));
  return cloud;
}

void expect_scores(const Scores& s, double precision, double recall, double f1, double mcc, double iou) {
  EXPECT_DOUBLE_EQ(s.precision, precision);
  EXPECT_DOUBLE_EQ(s.recall, recall);
  EXPECT_DOUBLE_EQ(s.f1, f1);
  EXPECT_DOUBLE_EQ(s.mcc, mcc);
  EXPECT_DOUBLE_EQ(s.iou, iou);
}

TEST(Evaluate, CountsPointByPoint) {
  const PointCloud prediction = cloud_with<std::uint8_t>("feature", {1, 1, 1, 0, 0, 1, 0, 0, 0, 0});
  const Confusion c = compare(prediction, cloud_with<float>("truth", {1, 0.5F, -1, 1, 7, 0, 0, 0, -0.0F, 0}));
  EXPECT_EQ(c.true_positive, 3U);
  EXPECT_EQ(c.false_positive, 1U);
  EXPECT_EQ(c.false_negative, 2U);
  EXPECT_EQ(c.true_negative, 4U);
}

TEST(Evaluate, PrefersTruthToTruthFeature) {
  PointCloud cloud = cloud_with<std::uint8_t>("feature", {1, 0});
  cloud.set_attribute(Column("truth_feature", std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(compare(cloud, cloud).true_positive, 1U);
  cloud.set_attribute(Column("truth", std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(compare(cloud, cloud).true_positive, 0U);
  EXPECT_EQ(compare(cloud, cloud).false_negative, 1U);
}

TEST(Evaluate, RefusesWhatCannotBeCompared) {
  const PointCloud prediction = cloud_with<std::uint8_t>("feature", {1, 0});
  const PointCloud truth = cloud_with<std::uint8_t>("truth", {1, 0});
  const auto refuse = [](const PointCloud& p, const PointCloud& t, const auto&... parts) {
    expect_error<InvalidArgument>([&] { (void)compare(p, t); }, parts...);
  };
  refuse(truth, truth, "prediction", "'feature'");
  refuse(prediction, prediction, "'truth'", "'truth_feature'");
  refuse(prediction, cloud_with<std::uint8_t>("truth", {1}), "2 points", "1");
  refuse(prediction, cloud_with<double>("truth", {0, std::numeric_limits<double>::quiet_NaN()}), "'truth'",
         "point 1", "not a number");
  PointCloud lists = prediction;
  lists.set_attribute(
      Column("truth", ScalarType::UInt8, ScalarType::UInt8, {0, 1, 2}, std::vector<std::byte>(2)));
  refuse(prediction, lists, "'truth'", "lists");
}

TEST(Evaluate, ScoresAsComputedByHand) {
  // TP 3, FP 1, FN 2, TN 4: MCC = (3*4 - 1*2) / sqrt(4 * 5 * 5 * 6)
  expect_scores(scores({3, 1, 2, 4}), 3.0 / 4, 3.0 / 5, 6.0 / 9, 10.0 / std::sqrt(600.0), 3.0 / 6);
  expect_scores(scores({5, 0, 0, 7}), 1, 1, 1, 1, 1);
  expect_scores(scores({0, 7, 5, 0}), 0, 0, 0, -1, 0);
  expect_scores(scores({1, 1, 1, 1}), 0.5, 0.5, 0.5, 0, 1.0 / 3);
}

TEST(Evaluate, ScoresWhereADenominatorIsZero) {
  expect_scores(scores({0, 0, 0, 9}), 1, 1, 1, 0, 1);  // nothing to find, nothing found
  expect_scores(scores({0, 0, 0, 0}), 1, 1, 1, 0, 1);  // no points
  expect_scores(scores({0, 0, 3, 6}), 0, 0, 0, 0, 0);  // nothing found
  expect_scores(scores({0, 3, 0, 6}), 0, 0, 0, 0, 0);  // nothing to find
  expect_scores(scores({9, 0, 0, 0}), 1, 1, 1, 0, 1);  // everything is a feature
}

TEST(Evaluate, MccIsExactForBillionsOfPoints) {
  const std::uint64_t many = std::uint64_t{1} << 32U;
  EXPECT_EQ(mcc({many, 0, 0, many}), 1);
  EXPECT_EQ(mcc({0, many, many, 0}), -1);
  EXPECT_EQ(mcc({many, many, many, many}), 0);
  EXPECT_DOUBLE_EQ(mcc({3 * many, many, 2 * many, 4 * many}), 10.0 / std::sqrt(600.0));
  EXPECT_EQ(mcc({3'000'000'019, 0, 0, 1'000'000'007}), 1);
}

TEST(Evaluate, SummarizesOddAndEvenNumbersOfClouds) {
  // precisions 1, 1/2, 0; recalls 1, 1/2, 0
  const std::array<Confusion, 3> clouds{Confusion{2, 0, 0, 2}, Confusion{1, 1, 1, 1}, Confusion{0, 4, 4, 0}};
  const Summary three = summarize(clouds);
  expect_scores(three.macro_mean, 0.5, 0.5, 0.5, 0, (1 + 1.0 / 3) / 3);
  expect_scores(three.median, 0.5, 0.5, 0.5, 0, 1.0 / 3);
  // together TP 3, FP 5, FN 5, TN 3
  expect_scores(three.micro, 3.0 / 8, 3.0 / 8, 3.0 / 8, (9.0 - 25.0) / 64.0, 3.0 / 13);

  const Summary two = summarize(std::span(clouds).first(2));
  expect_scores(two.median, 0.75, 0.75, 0.75, 0.5, (1 + 1.0 / 3) / 2);

  const Summary one = summarize(std::span(clouds).first(1));
  expect_scores(one.median, 1, 1, 1, 1, 1);
  expect_scores(one.micro, 1, 1, 1, 1, 1);
}

TEST(Evaluate, TakesTheMedianOfEachScoreAlone) {
  const std::array<Confusion, 3> clouds{Confusion{1, 0, 3, 4}, Confusion{1, 3, 0, 4}, Confusion{1, 1, 1, 1}};
  const Summary summary = summarize(clouds);  // precision 1, 1/4, 1/2; recall 1/4, 1, 1/2; F1 2/5, 2/5, 1/2
  EXPECT_DOUBLE_EQ(summary.median.precision, 0.5);
  EXPECT_DOUBLE_EQ(summary.median.recall, 0.5);
  EXPECT_DOUBLE_EQ(summary.median.f1, 0.4);
}

TEST(Evaluate, RefusesToSummarizeNothing) {
  expect_error<InvalidArgument>([] { (void)summarize({}); }, "at least one cloud");
}

PointCloud with_kinds(const std::string& name, const std::vector<std::uint8_t>& kinds) {
  return cloud_with(name, kinds);
}

TEST(Evaluate, CountsKindsAgainstKinds) {
  const PointCloud found = with_kinds("kind", {0, 2, 2, 255, 5});
  const PointCloud truth = with_kinds("truth_kind", {0, 2, 3, 1, 5});
  const KindConfusion once = compare_kinds(found, truth);
  EXPECT_EQ(once.counts[0][0], 1U);
  EXPECT_EQ(once.counts[2][2], 1U);
  EXPECT_EQ(once.counts[3][2], 1U);
  EXPECT_EQ(once.counts[1][6], 1U);  // undecided comes last
  EXPECT_EQ(once.counts[5][5], 1U);
  KindConfusion twice = once;
  twice += once;
  EXPECT_EQ(twice.counts[3][2], 2U);
  std::uint64_t sum = 0;
  for (const auto& row : twice.counts) sum += std::accumulate(row.begin(), row.end(), std::uint64_t{0});
  EXPECT_EQ(sum, 10U);
}

TEST(Evaluate, RefusesWhatAreNoKinds) {
  const PointCloud truth = with_kinds("truth_kind", {0, 2});
  expect_error<InvalidArgument>([&] { (void)compare_kinds(truth, truth); }, "'kind'");
  expect_error<InvalidArgument>(
      [&] {
        (void)compare_kinds(with_kinds("kind", {0, 7}), truth);
      },
      "point 1 is 7");
  expect_error<InvalidArgument>(
      [&] {
        (void)compare_kinds(with_kinds("kind", {0, 1, 2}), truth);
      },
      "3 points, the truth 2");
}

}  // namespace
}  // namespace keenline
