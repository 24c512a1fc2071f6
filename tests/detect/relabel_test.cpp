#include "keenline/detect/relabel.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/detect/gauss.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"

namespace keenline {
namespace {

PointCloud fandisk(std::uint64_t points, double noise_h) {
  SynthOptions options;
  options.shape = "fandisk";
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options).cloud;
}

TEST(Relabel, EqualsAFreshRunAtEverySensitivity) {
  for (const bool plain : {false, true}) {
    const PointCloud cloud = fandisk(1200, 0.05);
    const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);
    GaussOptions options;
    options.plain = plain;
    options.keep_spectrum = true;
    const FeatureLabels kept = detect_gauss(cloud, neighborhoods, options);
    ASSERT_TRUE(kept.spectrum);
    ASSERT_EQ(kept.spectrum->size(), cloud.size());
    options.keep_spectrum = false;
    options.sigma_rule = SigmaRule::Given;
    for (const double sigma_deg : {0.001, 1.4, 5.0, 9.9, 12.0, 12.3456789, 20.0, 33.3, 45.0, 60.0, 90.0}) {
      options.sigma_deg = sigma_deg;
      const FeatureLabels fresh = detect_gauss(cloud, neighborhoods, options);
      EXPECT_FALSE(fresh.spectrum);
      const FeatureLabels again = relabel(*kept.spectrum, sigma_deg);
      EXPECT_EQ(again.kind, fresh.kind) << sigma_deg;
      EXPECT_EQ(again.clusters, fresh.clusters) << sigma_deg;
      EXPECT_EQ(again.sigma_deg, fresh.sigma_deg);
    }
  }
}

/// One point: flat below 10 degrees, an edge from there, a corner from 30 degrees.
LabelSpectrum three_steps() {
  return {{0, 3}, {0, 7280, 21840}, {Kind::Flat, Kind::Edge, Kind::Corner}, {1, 2, 3}};
}

TEST(Relabel, StepsBeginExactlyWhereTheySay) {
  const LabelSpectrum spectrum = three_steps();
  EXPECT_EQ(relabel(spectrum, 9.999).kind[0], Kind::Flat);
  EXPECT_EQ(relabel(spectrum, 10).kind[0], Kind::Edge);
  EXPECT_EQ(relabel(spectrum, 29.999).clusters[0], 2);
  EXPECT_EQ(relabel(spectrum, 30).clusters[0], 3);
  EXPECT_EQ(relabel(spectrum, 90).kind[0], Kind::Corner);
  EXPECT_EQ(relabel({}, 20).size(), 0U);
}

TEST(Relabel, LocallyTakesTheKindThatHoldsOverTheWidestRange) {
  // From 8 to 10, 10 to 30 and 30 to 45 degrees: ratios of 1.25, 3 and 1.5.
  LabelSpectrum spectrum = three_steps();
  EXPECT_EQ(local_sensitivity(spectrum, 0), 20 * 728);
  EXPECT_EQ(relabel_locally(spectrum).kind[0], Kind::Edge);
  EXPECT_EQ(relabel_locally(spectrum).clusters[0], 2);
  EXPECT_EQ(relabel(spectrum, SigmaRule::Local, 12).kind, relabel_locally(spectrum).kind);
  spectrum.from[1] = 9 * 728;
  spectrum.from[2] = 18 * 728;
  EXPECT_EQ(relabel_locally(spectrum).kind[0], Kind::Corner);
  // Steps of one kind are one range: from 8 to 20 degrees against 20 to 45.
  spectrum = {{0, 3}, {0, 14 * 728, 20 * 728}, {Kind::Edge, Kind::Edge, Kind::Curved}, {3, 2, 1}};
  EXPECT_EQ(relabel_locally(spectrum).kind[0], Kind::Edge);
  EXPECT_EQ(relabel_locally(spectrum).clusters[0], 2);
  spectrum = {{0, 1}, {0}, {Kind::Undecided}, {0}};
  EXPECT_EQ(relabel_locally(spectrum).kind[0], Kind::Undecided);
}

TEST(Relabel, SensitivitiesAreWholeUnits) {
  EXPECT_EQ(sensitivity_of(90), 65520);
  EXPECT_EQ(sensitivity_of(20), 14560);
  EXPECT_EQ(sensitivity_of(1e-9), 0);
  EXPECT_EQ(sensitivity_of(1.0 / 728), 1);
  for (const double wrong : {0.0, -1.0, 90.001, std::nan(""), std::numeric_limits<double>::infinity()})
    test::expect_error<InvalidArgument>([&] { (void)sensitivity_of(wrong); }, "--sigma");
}

TEST(ChooseSigma, TakesTheLargestOfTheStableRange) {
  // Half of the points are edges from 12 to 40 degrees, the others flat: from 15 to 32 nothing changes within
  // a quarter up and down.
  LabelSpectrum spectrum;
  for (int i = 0; i < 100; ++i) {
    for (const auto& [from, kind] :
         {std::pair{0, Kind::Curved}, {12 * 728, Kind::Edge}, {40 * 728, Kind::Flat}}) {
      spectrum.from.push_back(static_cast<std::uint16_t>(from));
      spectrum.kind.push_back(i % 2 == 0 ? Kind::Flat : kind);
      spectrum.clusters.push_back(1);
    }
    spectrum.offsets.push_back(spectrum.from.size());
  }
  const double sigma_deg = choose_sigma(spectrum);
  EXPECT_NEAR(sigma_deg, 32, 90.0 / 64);
  EXPECT_LE(sigma_deg, 32);
  EXPECT_EQ(choose_sigma({}), 20);
  EXPECT_EQ(relabel(spectrum, SigmaRule::Auto, 0).sigma_deg, sigma_deg);
}

TEST(ChooseSigma, SeesWhatStaysAndNotNothing) {
  // One point in a hundred is an edge, up to 18 to 34 degrees, and three more for half a degree about 11.
  LabelSpectrum spectrum;
  const auto add = [&](double from_deg, double to_deg) {
    for (const auto& [from, kind] :
         {std::pair{0.0, Kind::Curved}, {from_deg, Kind::Edge}, {to_deg, Kind::Flat}}) {
      spectrum.from.push_back(sensitivity_of(std::max(from, 0.01)));
      spectrum.kind.push_back(kind);
      spectrum.clusters.push_back(1);
    }
    spectrum.offsets.push_back(spectrum.from.size());
  };
  for (int i = 0; i < 120; ++i) add(5, 18 + 16 * i / 120.0);
  for (int i = 0; i < 3; ++i) add(10.5, 11);
  for (int i = 0; i < 12000; ++i) {
    spectrum.from.push_back(0);
    spectrum.kind.push_back(Kind::Flat);
    spectrum.clusters.push_back(1);
    spectrum.offsets.push_back(spectrum.from.size());
  }
  EXPECT_LT(choose_sigma(spectrum), 18);
  EXPECT_GT(choose_sigma(spectrum), 11);
}

}  // namespace
}  // namespace keenline
