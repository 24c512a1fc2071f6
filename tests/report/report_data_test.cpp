#include "keenline/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/detect/gauss.h"
#include "keenline/detect/relabel.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

#include "support/cancelled_progress.h"
#include "support/report_file.h"
#include "support/sample_graph.h"

namespace keenline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct Labelled {
  PointCloud cloud;
  FeatureLabels labels;
};

Labelled fandisk(std::uint64_t points = 3000) {
  SynthOptions shape;
  shape.shape = "fandisk";
  shape.points = points;
  shape.noise.amount = 0.05;
  Labelled result{synthesize(shape).cloud, {}};
  GaussOptions options;
  options.keep_spectrum = true;
  result.labels = detect_gauss(result.cloud, find_neighborhoods(result.cloud, 16), options);
  return result;
}

/// Points on a line, all flat.
Labelled row(std::size_t points) {
  Labelled result;
  for (std::size_t i = 0; i < points; ++i) result.cloud.positions.push_back({static_cast<double>(i), 0, 0});
  result.labels.kind.assign(points, Kind::Flat);
  result.labels.score.assign(points, 0.0F);
  return result;
}

std::vector<std::uint32_t> numbers(const ReportData& data, std::string_view name) {
  return test::decoded(test::buffer_named(data.buffers, name));
}

bool has(const ReportData& data, std::string_view name) {
  return std::any_of(data.buffers.begin(), data.buffers.end(),
                     [&](const ReportBuffer& buffer) { return buffer.name == name; });
}

const ReportAttribute& attribute(const ReportData& data, std::string_view name) {
  const auto found = std::find_if(data.attributes.begin(), data.attributes.end(),
                                  [&](const ReportAttribute& a) { return a.name == name; });
  if (found == data.attributes.end()) throw InvalidArgument("no such attribute");
  return *found;
}

/// As the page decodes them.
std::vector<double> values(const ReportData& data, std::string_view name) {
  const ReportAttribute& a = attribute(data, name);
  const ReportBuffer buffer = test::buffer_named(data.buffers, a.buffer);
  const std::uint32_t not_finite = buffer.type == ScalarType::UInt8 ? 255 : 65535;
  std::vector<double> result;
  for (const std::uint32_t v : test::decoded(buffer))
    result.push_back(v == not_finite ? nan : a.low + a.step * v);
  return result;
}

TEST(ReportDataTest, LabelsAndPositionsComeBack) {
  const auto [cloud, labels] = fandisk();
  const ReportData data = report_data(cloud, labels);
  EXPECT_EQ(data.kept, cloud.size());
  EXPECT_EQ(data.left_out, "");
  EXPECT_FALSE(has(data, "index"));
  EXPECT_FALSE(has(data, "seen_offset"));
  EXPECT_TRUE(data.notes.empty());
  EXPECT_EQ(data.kind_counts, count_kinds(labels.kind));
  const std::vector<std::uint32_t> places = numbers(data, "position");
  const std::vector<std::uint32_t> kinds = numbers(data, "kind");
  const std::vector<std::uint32_t> clusters = numbers(data, "clusters");
  const std::vector<double> scores = values(data, "score");
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(data.grid.origin[axis] + data.grid.step * places[3 * i + axis], cloud.positions[i][axis],
                  data.grid.step);
    EXPECT_EQ(kinds[i], static_cast<std::uint32_t>(labels.kind[i]));
    EXPECT_EQ(clusters[i], labels.clusters[i]);
    EXPECT_NEAR(scores[i], labels.score[i], 90.0 / 65534);
  }
}

/// Kinds and clusters of every kept point at one sensitivity, from the buffers alone.
void expect_relabelled(const ReportData& data, const FeatureLabels& expected, std::uint32_t sensitivity) {
  const std::vector<std::uint32_t> index = numbers(data, "index");
  const std::vector<std::uint32_t> counts = numbers(data, "spectrum_count");
  const std::vector<std::uint32_t> rises = numbers(data, "spectrum_rise");
  const std::vector<std::uint32_t> kinds = numbers(data, "spectrum_kind");
  const std::vector<std::uint32_t> clusters = numbers(data, "spectrum_clusters");
  std::size_t step = 0;
  std::size_t rise = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::size_t chosen = step;
    std::uint32_t from = 0;
    for (std::uint32_t s = 1; s < counts[i]; ++s) {
      from += rises[rise++];
      if (from <= sensitivity) chosen = step + s;
    }
    EXPECT_EQ(kinds[chosen], static_cast<std::uint32_t>(expected.kind[index[i]]));
    EXPECT_EQ(clusters[chosen], expected.clusters[index[i]]);
    step += counts[i];
  }
  EXPECT_EQ(step, kinds.size());
  EXPECT_EQ(rise, rises.size());
  const std::vector<std::uint32_t> table = numbers(data, "counts");
  const KindCounts whole = count_kinds(expected.kind);
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), table.begin() + sensitivity * whole.size()));
}

TEST(ReportDataTest, TheSpectrumGivesTheLabelsOfAnySensitivityThinnedOrNot) {
  const auto [cloud, labels] = fandisk();
  ReportDataOptions options;
  options.max_points = 1500;
  const ReportData data = report_data(cloud, labels, {}, options);
  EXPECT_EQ(data.kept, 1500U);
  EXPECT_EQ(data.left_out,
            "1,500 of 3,000 points are left out, evenly, of those that are neither sharp nor on a border");
  for (const double sigma_deg : {0.01, 5.0, 14.4, 20.0, 33.3, 60.0, 90.0})
    expect_relabelled(data, relabel(*labels.spectrum, sigma_deg), sensitivity_of(sigma_deg));
  const std::vector<std::uint32_t> kinds = numbers(data, "kind");
  const auto sharp = [](const auto& list) {
    return std::count_if(list.begin(), list.end(), [](auto k) { return is_feature(static_cast<Kind>(k)); });
  };
  EXPECT_EQ(sharp(kinds), sharp(labels.kind));
}

TEST(ReportDataTest, WhatTheMethodLookedAtIsAnOffsetInSteps) {
  const auto [cloud, labels] = row(3);
  const double step = grid_for(cloud.positions).step;
  const std::vector<Point> seen{{-3 * step, 0, 0}, {1, 7 * step, 0}, {2, 0, 0}};
  const ReportData data = report_data(cloud, labels, seen);
  EXPECT_EQ(numbers(data, "seen_offset"), (std::vector<std::uint32_t>{5, 0, 0, 0, 14, 0, 0, 0, 0}));
}

TEST(ReportDataTest, AttributesKeepWhatTheyCan) {
  auto [cloud, labels] = row(400);
  std::vector<std::uint16_t> classes;
  std::vector<double> heights;
  std::vector<std::int32_t> wide;
  std::vector<float> odd;
  for (int i = 0; i < 400; ++i) {
    classes.push_back(static_cast<std::uint16_t>(1000 + i % 255));
    heights.push_back(500.25 + 0.001 * i);
    wide.push_back(-i * 100);
    odd.push_back(static_cast<float>(i % 3));
  }
  heights[7] = nan;
  odd[5] = -std::numeric_limits<float>::infinity();
  cloud.set_attribute(Column("class", classes));
  cloud.set_attribute(Column("height", heights));
  cloud.set_attribute(Column("wide", wide));
  cloud.set_attribute(Column("odd", odd));
  cloud.set_attribute(Column("nothing", std::vector<double>(400, infinity)));
  cloud.set_attribute(Column("constant", std::vector<double>(400, 0.1)));
  cloud.set_attribute(
      Column("list", ScalarType::UInt8, ScalarType::UInt8, std::vector<std::uint64_t>(401, 0), {}));
  const ReportData data = report_data(cloud, labels);
  const auto found = [&data = data](std::string_view name) { return values(data, name); };
  for (std::size_t i = 0; i < 400; ++i) {
    EXPECT_EQ(found("class")[i], classes[i]);
    EXPECT_EQ(found("wide")[i], wide[i]);
    if (i != 7) {
      EXPECT_NEAR(found("height")[i], heights[i], 0.4 / 65534);
    }
    if (i != 5) {
      EXPECT_EQ(found("odd")[i], static_cast<double>(odd[i]));
    }
  }
  EXPECT_TRUE(std::isnan(found("height")[7]));
  EXPECT_TRUE(std::isnan(found("odd")[5]));
  EXPECT_TRUE(std::isnan(found("nothing")[0]));
  EXPECT_EQ(found("constant")[3], 0.1);
  EXPECT_EQ(test::buffer_named(data.buffers, attribute(data, "class").buffer).type, ScalarType::UInt8);
  EXPECT_EQ(std::count_if(data.attributes.begin(), data.attributes.end(),
                          [](const auto& a) { return a.name == "list"; }),
            0);
}

TEST(ReportDataTest, NumbersTooLargeForTheirDifferencesAreNone) {
  auto [cloud, labels] = row(3);
  constexpr double largest = std::numeric_limits<double>::max();
  cloud.set_attribute(Column("all", std::vector<double>{-1e300, largest, 1e300}));
  const std::vector<double> back = values(report_data(cloud, labels), "all");
  EXPECT_EQ(back[0], -1e300);
  EXPECT_TRUE(std::isnan(back[1]));
  EXPECT_NEAR(back[2] / 1e300, 1, 1e-12);
}

TEST(ReportDataTest, MoreAttributesThanTakenAreNamed) {
  auto [cloud, labels] = row(2);
  for (const char* const name : {"a", "b", "c", "kind", "score"})
    cloud.set_attribute(Column(name, std::vector<double>{1, 2}));
  ReportDataOptions options;
  options.max_attributes = 1;
  const ReportData data = report_data(cloud, labels, {}, options);
  ASSERT_EQ(data.notes.size(), 1U);
  EXPECT_NE(data.notes[0].find("'b', 'c'"), std::string::npos) << data.notes[0];
  EXPECT_EQ(data.attributes.size(), 2U);  // score, a
}

TEST(ReportDataTest, TruthOfKindsOrOfFeatures) {
  auto [cloud, labels] = row(3);
  EXPECT_FALSE(has(report_data(cloud, labels), "truth"));
  cloud.set_attribute(Column("truth", std::vector<double>{0, 7, nan}));
  const ReportData features = report_data(cloud, labels);
  EXPECT_EQ(features.truth, "truth");
  EXPECT_EQ(numbers(features, "truth"), (std::vector<std::uint32_t>{0, 2, 0}));
  cloud.set_attribute(Column("truth_kind", std::vector<std::int32_t>{5, 255, 3}));
  const ReportData kinds = report_data(cloud, labels);
  EXPECT_EQ(kinds.truth, "truth_kind");
  EXPECT_EQ(numbers(kinds, "truth"), (std::vector<std::uint32_t>{5, 255, 3}));
  // Not kinds: whoever wrote it meant something else.
  cloud.set_attribute(Column("truth_kind", std::vector<std::int32_t>{5, 77, 3}));
  EXPECT_EQ(report_data(cloud, labels).truth, "truth");
}

TEST(ReportDataTest, ColoursOfEightBitsSixteenOrShares) {
  auto [cloud, labels] = row(2);
  const auto with = [&, &cloud = cloud, &labels = labels](auto low, auto high) {
    for (const char* const name : {"red", "green", "blue"})
      cloud.set_attribute(Column(name, std::vector{low, high}));
    const std::vector<std::uint32_t> rgb = numbers(report_data(cloud, labels), "rgb");
    return std::pair(rgb[0], rgb[3]);
  };
  EXPECT_EQ(with(std::uint8_t{3}, std::uint8_t{200}), std::pair(3U, 200U));
  EXPECT_EQ(with(std::uint16_t{257}, std::uint16_t{65535}), std::pair(1U, 255U));
  EXPECT_EQ(with(std::uint16_t{7}, std::uint16_t{255}), std::pair(7U, 255U));
  EXPECT_EQ(with(0.2F, 1.0F), std::pair(51U, 255U));
  EXPECT_EQ(with(nan, -infinity), std::pair(0U, 0U));
  EXPECT_TRUE(report_data(cloud, labels).attributes.size() == 1) << "colours are no attributes";
}

TEST(ReportDataTest, PointsThatAreNotFiniteAreLeftOutInWords) {
  auto [cloud, labels] = row(4);
  cloud.positions[1][2] = nan;
  labels.kind[1] = Kind::Undecided;
  const ReportData data = report_data(cloud, labels);
  EXPECT_EQ(data.left_out, "1 points without finite coordinates are left out");
  EXPECT_EQ(numbers(data, "index"), (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(data.kind_counts.back(), 1U);
}

TEST(ReportDataTest, OfNothing) {
  const ReportData data = report_data({}, {});
  EXPECT_EQ(data.kept, 0U);
  EXPECT_EQ(numbers(data, "position").size(), 0U);
  EXPECT_EQ(numbers(data, "kind").size(), 0U);
}

TEST(ReportDataTest, SameBytesForAnyNumberOfThreadsAndCancelled) {
  const auto [cloud, labels] = fandisk(2000);
  ReportDataOptions options;
  options.max_points = 900;
  const ReportData expected = report_data(cloud, labels, {}, options);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ReportData again = report_data(cloud, labels, {}, options);
  for (std::size_t i = 0; i < expected.buffers.size(); ++i)
    EXPECT_EQ(again.buffers[i].bytes, expected.buffers[i].bytes);
  test::CancelledProgress cancelled;
  EXPECT_THROW((void)report_data(cloud, labels, {}, options, cancelled), Cancelled);
}

}  // namespace
}  // namespace keenline
