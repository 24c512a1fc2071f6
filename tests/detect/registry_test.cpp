#include "keenline/detect/registry.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/cloud.h"
#include "keenline/detect/demarsin.h"
#include "keenline/detect/gauss.h"
#include "keenline/detect/gumhold.h"
#include "keenline/detect/pauly.h"
#include "keenline/detect/tensor_voting.h"
#include "keenline/detect/voters.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/synth/synth.h"

#include "support/cancelled_progress.h"
#include "support/expect_error.h"
#include "support/shapes.h"

namespace keenline {
namespace {

using test::expect_error;
using test::shape;

const OptionInfo& option(std::string_view name) {
  for (const OptionInfo& info : find_method("gauss").options)
    if (info.name == name) return info;
  throw InvalidArgument("no such option");
}

TEST(Registry, EveryMethodIsCompleteAndUnique) {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second);
    EXPECT_FALSE(method.summary.empty());
    EXPECT_FALSE(method.paper.empty());
    const OptionValues defaults = resolve_options(method, {});
    EXPECT_EQ(defaults.size(), method.options.size());
    EXPECT_GE(method.reach(defaults), min_neighbors);
    for (const OptionInfo& info : method.options) {
      EXPECT_TRUE(info.default_value.has_value() || !info.automatic.empty()) << info.name;
      EXPECT_LE(info.minimum, info.maximum) << info.name;
    }
  }
  EXPECT_EQ(methods().front().name, "gauss");
}

TEST(Registry, UnknownMethodNamesTheKnown) {
  expect_error<InvalidArgument>([] { (void)find_method("gaus"); }, "'gaus'", "gauss");
}

TEST(Registry, ParsesValuesAndTheWordForAutomatic) {
  EXPECT_EQ(parse_option(option("sigma"), "12.5"), 12.5);
  EXPECT_EQ(parse_option(option("sigma"), "auto"), std::nullopt);
  EXPECT_EQ(parse_option(option("neighbors"), "255"), 255);
}

TEST(Registry, RefusesValuesWithTheAllowedRange) {
  const auto refuses = [](std::string_view name, std::string_view text, std::string_view range) {
    expect_error<InvalidArgument>([&] { (void)parse_option(option(name), text); }, name, text, range);
  };
  for (const char* const text : {"0", "-5", "90.001", "nan", "inf", "abc", "", "1e400", "20deg"})
    refuses("sigma", text, "more than 0, up to 90 degrees, or auto");
  for (const char* const text : {"2", "256", "16.5", "many", "0x10"})
    refuses("neighbors", text, "an integer from 3 to 255 points");
  refuses("min-cluster", "0", "an integer from 1");
  refuses("max-clusters", "1", "an integer from 2 to 255");
  refuses("min-sine", "1.5", "from 0 to 1");
  refuses("triangles", "2", "an integer from 3 to 32385");
}

TEST(Registry, WhatFollowsTheNoiseIsFilledIn) {
  const Method& gauss = find_method("gauss");
  const auto adapted = [&](double noise, const OptionValues& given = {}, std::size_t points = 1000) {
    OptionValues values = resolve_options(gauss, given);
    gauss.adapt(values, noise, points);
    return std::pair(*values.at("neighbors"), values.at("triangles"));
  };
  const std::optional<double> all;
  EXPECT_EQ(adapted(0), std::pair(16.0, all));
  EXPECT_EQ(adapted(0.0001), std::pair(16.0, std::optional(115.0)));
  EXPECT_EQ(adapted(0.0075), std::pair(19.0, std::optional(106.0)));  // half way from 171 to 40
  EXPECT_EQ(adapted(0.025), std::pair(22.0, std::optional(57.0)));
  EXPECT_EQ(adapted(0.1), std::pair(28.0, std::optional(40.0)));
  EXPECT_EQ(adapted(7), std::pair(28.0, std::optional(40.0)));
  EXPECT_EQ(adapted(7, {{"plain", 1.0}}), std::pair(16.0, all));
  EXPECT_EQ(adapted(7, {{"neighbors", 8.0}}), std::pair(8.0, std::optional(28.0)));
  EXPECT_EQ(adapted(7, {{"neighbors", 12.0}, {"triangles", 50.0}}), std::pair(12.0, std::optional(50.0)));
  EXPECT_EQ(adapted(7, {}, 20).first, 19.0);
  EXPECT_EQ(adapted(7, {}, 3).first, 16.0);
  EXPECT_TRUE(gauss.is_plain(resolve_options(gauss, {{"plain", 1.0}})));
  EXPECT_FALSE(gauss.is_plain(resolve_options(gauss, {})));
}

TEST(Registry, ResolvesDefaultsAndRefusesForeignOptions) {
  const Method& gauss = find_method("gauss");
  const OptionValues values = resolve_options(gauss, {{"sigma", 30.0}});
  EXPECT_EQ(values.at("sigma"), 30.0);
  EXPECT_EQ(values.at("neighbors"), std::nullopt);
  EXPECT_EQ(values.at("min-cluster"), std::nullopt);
  EXPECT_EQ(values.at("plain"), 0.0);
  EXPECT_EQ(gauss.reach(values), 16);
  expect_error<InvalidArgument>(
      [&] {
        (void)resolve_options(gauss, {{"radius", 1.0}});
      },
      "--radius", "gauss");
  expect_error<InvalidArgument>([&] { (void)resolve_options(gauss, {{"sigma", 91.0}}); }, "--sigma", "91");
  expect_error<InvalidArgument>(
      [&] {
        (void)resolve_options(gauss, {{"min-support", std::nullopt}});
      },
      "--min-support");
}

TEST(Registry, ReportsWhatWasChosenFromTheData) {
  const Method& gauss = find_method("gauss");
  OptionValues values = resolve_options(gauss, {{"sigma", std::nullopt}});
  const PointCloud cloud;
  const FeatureLabels labels = gauss.detect(cloud, NeighborSearch(cloud.positions), values, no_progress());
  EXPECT_EQ(labels.size(), 0U);
  ASSERT_TRUE(values.at("sigma").has_value());
  EXPECT_GT(*values.at("sigma"), 0);
}

TEST(Registry, GaussOptionsAreThoseOfTheMethod) {
  const Method& gauss = find_method("gauss");
  const GaussOptions standard;
  const GaussOptions defaults = gauss_options_from(resolve_options(gauss, {}));
  EXPECT_EQ(defaults.neighbors, standard.neighbors);
  EXPECT_EQ(defaults.sigma_deg, standard.sigma_deg);
  EXPECT_EQ(defaults.min_cluster, standard.min_cluster);
  EXPECT_EQ(defaults.max_clusters, standard.max_clusters);
  EXPECT_EQ(defaults.min_sine, standard.min_sine);
  EXPECT_EQ(defaults.triangles, standard.triangles);
  EXPECT_EQ(defaults.sigma_rule, standard.sigma_rule);
  EXPECT_EQ(defaults.persistence, standard.persistence);
  EXPECT_EQ(defaults.thin, standard.thin);
  EXPECT_EQ(defaults.plain, standard.plain);
  EXPECT_EQ(defaults.keep_spectrum, standard.keep_spectrum);
  const GaussOptions given = gauss_options_from(resolve_options(gauss, {{"neighbors", 24.0},
                                                                        {"sigma", 12.5},
                                                                        {"min-cluster", 5.0},
                                                                        {"max-clusters", 6.0},
                                                                        {"min-sine", 0.3},
                                                                        {"triangles", 50.0},
                                                                        {"persistence", 2.5},
                                                                        {"thin", 0.0},
                                                                        {"plain", 1.0},
                                                                        {"spectrum", 1.0}}));
  EXPECT_EQ(given.neighbors, 24);
  EXPECT_EQ(given.sigma_rule, SigmaRule::Given);
  EXPECT_EQ(given.sigma_deg, 12.5);
  EXPECT_EQ(given.min_cluster, 5);
  EXPECT_EQ(given.max_clusters, 6);
  EXPECT_EQ(given.min_sine, 0.3);
  EXPECT_EQ(given.triangles, 50);
  EXPECT_EQ(given.persistence, 2.5);
  EXPECT_FALSE(given.thin);
  EXPECT_TRUE(given.plain);
  EXPECT_TRUE(given.keep_spectrum);
}

TEST(Registry, PaulyOptionsAreThoseOfTheMethod) {
  const Method& pauly = find_method("pauly");
  OptionValues values = resolve_options(pauly, {});
  EXPECT_EQ(pauly.reach(values), 32);
  pauly.adapt(values, 0, 1000);
  const PaulyOptions standard;
  EXPECT_EQ(values.at("smallest-scale"), standard.smallest_scale);
  EXPECT_EQ(values.at("largest-scale"), standard.largest_scale);
  EXPECT_EQ(values.at("scale-step"), standard.scale_step);
  EXPECT_EQ(values.at("variation"), standard.variation);
  EXPECT_EQ(values.at("seed-share"), standard.seed_share);
  EXPECT_EQ(values.at("grow-share"), standard.grow_share);
  EXPECT_EQ(values.at("turn"), standard.turn_deg);
  EXPECT_EQ(values.at("border-gap"), standard.border_gap_deg);
  values = resolve_options(pauly, {{"plain", 1.0}, {"grow-share", 0.7}});
  EXPECT_TRUE(pauly.is_plain(values));
  EXPECT_EQ(pauly.reach(values), 120);
  pauly.adapt(values, 0, 1000);
  EXPECT_EQ(values.at("smallest-scale"), 15.0);
  EXPECT_EQ(values.at("variation"), 0.04);
  EXPECT_EQ(values.at("grow-share"), 0.7);
  const PointCloud cloud;
  EXPECT_EQ(pauly.detect(cloud, NeighborSearch(cloud.positions), values, no_progress()).size(), 0U);
  EXPECT_EQ(values.at("variation"), 0.04);
  values.at("variation").reset();
  (void)pauly.detect(cloud, NeighborSearch(cloud.positions), values, no_progress());
  EXPECT_EQ(values.at("variation"), 0.01) << "what was chosen from the cloud";
}

TEST(Registry, GumholdOptionsAreThoseOfTheMethod) {
  const Method& gumhold = find_method("gumhold");
  const auto adapted = [&](const OptionValues& given, double noise) {
    OptionValues values = resolve_options(gumhold, given);
    gumhold.adapt(values, noise, 1000);
    return values;
  };
  const GumholdOptions standard;
  const OptionValues values = adapted({}, 0);
  EXPECT_EQ(values.at("neighbors"), standard.neighbors);
  EXPECT_EQ(values.at("crease-limit"), standard.crease_limit);
  EXPECT_EQ(values.at("border-gap"), standard.border_gap_deg);
  EXPECT_EQ(values.at("shortest-cycle"), std::nullopt);
  EXPECT_FALSE(gumhold.is_plain(values));
  EXPECT_NEAR(*adapted({}, 0.1).at("crease-limit"), 1.2, 1e-12);
  EXPECT_NEAR(*adapted({}, 5).at("crease-limit"), 1.0, 1e-12);
  EXPECT_EQ(adapted({{"plain", 1.0}}, 5).at("crease-limit"), 1.7);
  EXPECT_EQ(adapted({{"crease-limit", 0.5}}, 5).at("crease-limit"), 0.5);
  EXPECT_EQ(gumhold.reach(adapted({{"neighbors", 20.0}}, 0)), 20);
  OptionValues given = adapted({{"shortest-cycle", 7.0}, {"plain", 1.0}}, 0);
  const PointCloud cloud;
  EXPECT_EQ(gumhold.detect(cloud, NeighborSearch(cloud.positions), given, no_progress()).size(), 0U);
}

TEST(Registry, DemarsinOptionsAreThoseOfTheMethod) {
  const Method& method = find_method("demarsin");
  const DemarsinOptions standard;
  const DemarsinOptions defaults = demarsin_options_from(resolve_options(method, {}));
  EXPECT_EQ(defaults.normal_neighbors, standard.normal_neighbors);
  EXPECT_EQ(defaults.region_neighbors, standard.region_neighbors);
  EXPECT_EQ(defaults.segment_angle_deg, standard.segment_angle_deg);
  EXPECT_EQ(defaults.min_patch, standard.min_patch);
  const OptionValues values = resolve_options(
      method,
      {{"normal-neighbors", 60.0}, {"region-neighbors", 9.0}, {"segment-angle", 7.5}, {"min-patch", 20.0}});
  const DemarsinOptions given = demarsin_options_from(values);
  EXPECT_EQ(given.normal_neighbors, 60);
  EXPECT_EQ(given.region_neighbors, 9);
  EXPECT_EQ(given.segment_angle_deg, 7.5);
  EXPECT_EQ(given.min_patch, 20);
  EXPECT_EQ(method.reach(values), 60);
  OptionValues chosen = resolve_options(method, {});
  EXPECT_EQ(method.reach(chosen), demarsin_view);
  const PointCloud none;
  (void)method.detect(none, NeighborSearch(none.positions), chosen, no_progress());
  EXPECT_EQ(chosen.at("segment-angle"), 5);
}

TEST(Registry, TensorVotingOptionsAreThoseOfTheMethod) {
  const Method& method = find_method("tensor_voting");
  const TensorVotingOptions standard;
  const TensorVotingOptions defaults = tensor_voting_options_from(resolve_options(method, {}));
  EXPECT_EQ(defaults.voting_scale, standard.voting_scale);
  EXPECT_EQ(defaults.curvature_weight, standard.curvature_weight);
  EXPECT_EQ(defaults.min_curve, standard.min_curve);
  EXPECT_EQ(defaults.min_junction, standard.min_junction);
  const OptionValues values = resolve_options(
      method, {{"voting-scale", 2.0}, {"curvature-weight", 3.0}, {"min-curve", 0.25}, {"min-junction", 0.5}});
  const TensorVotingOptions given = tensor_voting_options_from(values);
  EXPECT_EQ(given.voting_scale, 2);
  EXPECT_EQ(given.curvature_weight, 3);
  EXPECT_EQ(given.min_curve, 0.25);
  EXPECT_EQ(given.min_junction, 0.5);
  EXPECT_EQ(method.reach(values), voters_within(2));
  OptionValues chosen = resolve_options(method, {});
  const PointCloud none;
  (void)method.detect(none, NeighborSearch(none.positions), chosen, no_progress());
  EXPECT_TRUE(chosen.at("min-curve").has_value());
}

FeatureLabels labels_by(const Method& method, const PointCloud& cloud, Progress& progress = no_progress()) {
  OptionValues values = resolve_options(method, {});
  method.adapt(values, 0, cloud.size());
  return method.detect(cloud, NeighborSearch(cloud.positions), values, progress);
}

TEST(Registry, NoMethodDependsOnTheOrderOfThePoints) {
  const PointCloud cloud = shape("cylinder", 4000);
  std::vector<std::size_t> order(cloud.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  PointCloud shuffled;
  for (const std::size_t i : order) shuffled.positions.push_back(cloud.positions[i]);
  for (const Method& method : methods()) {
    const FeatureLabels labels = labels_by(method, cloud);
    const FeatureLabels found = labels_by(method, shuffled);
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(found.kind[i], labels.kind[order[i]]) << method.name;
      EXPECT_EQ(found.score[i], labels.score[order[i]]) << method.name;
    }
  }
}

TEST(Registry, EveryMethodSaysTheSameWithAnyNumberOfThreads) {
  const PointCloud cloud = shape("fandisk", 5000, 0.1);
  for (const Method& method : methods()) {
    const FeatureLabels labels = labels_by(method, cloud);
    for (const std::size_t threads : {1U, 2U, 16U}) {
      const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
      const FeatureLabels found = labels_by(method, cloud);
      EXPECT_EQ(found.kind, labels.kind) << method.name;
      EXPECT_EQ(found.score, labels.score) << method.name;
    }
  }
}

TEST(Registry, EveryMethodStopsWheneverItIsTold) {
  const PointCloud cloud = shape("cube", 1000);
  // In one thread they ask as often every time.
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  for (const Method& method : methods()) {
    test::CancelledProgress never(std::numeric_limits<std::uint64_t>::max());
    (void)labels_by(method, cloud, never);
    EXPECT_GE(never.asked(), 1U) << method.name;
    for (const std::uint64_t at : test::some_up_to(never.asked())) {
      test::CancelledProgress progress(at);
      EXPECT_THROW((void)labels_by(method, cloud, progress), Cancelled)
          << method.name << ", " << at << " of " << never.asked();
    }
  }
}

}  // namespace
}  // namespace keenline
