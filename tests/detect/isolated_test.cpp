#include "keenline/detect/isolated.h"

#include <gtest/gtest.h>

#include "keenline/cloud.h"
#include "keenline/detect/gauss.h"
#include "keenline/detect/relabel.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

namespace keenline {
namespace {

/// Three points; 0 and 1 are neighbours of each other, 2 has both for neighbours and is nobody's.
Neighborhoods three() { return {{0, 1, 2, 4}, {1, 0, 0, 1}}; }

/// 0 is an edge from 10 to 40 degrees, 1 from 20 degrees on, 2 a corner at every sensitivity.
LabelSpectrum spectrum_of_three() {
  return {{0, 3, 5, 6},
          {0, 7280, 29120, 0, 14560, 0},
          {Kind::Curved, Kind::Edge, Kind::Flat, Kind::Curved, Kind::Edge, Kind::Corner},
          {1, 2, 1, 1, 2, 3}};
}

/// In a row; nobody knows where creases run.
LabelSpectrum filtered(const LabelSpectrum& spectrum, int min_support,
                       const std::vector<CreaseDirection>& directions = std::vector<CreaseDirection>(3)) {
  return without_isolated(spectrum, three(), {{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}, directions, min_support);
}

TEST(Isolated, SharpPointsNeedSharpNeighbours) {
  const LabelSpectrum found = filtered(spectrum_of_three(), 1);
  const auto kinds = [&](double sigma_deg) { return relabel(found, sigma_deg).kind; };
  using Kinds = std::vector<Kind>;
  EXPECT_EQ(kinds(5), (Kinds{Kind::Curved, Kind::Curved, Kind::Curved}));
  EXPECT_EQ(kinds(15), (Kinds{Kind::Curved, Kind::Curved, Kind::Corner}));
  EXPECT_EQ(kinds(30), (Kinds{Kind::Edge, Kind::Edge, Kind::Corner}));
  EXPECT_EQ(kinds(50), (Kinds{Kind::Flat, Kind::Curved, Kind::Corner}));
  EXPECT_EQ(relabel(found, 30).clusters, (std::vector<std::uint8_t>{2, 2, 3}));
}

TEST(Isolated, PeaksStandAlone) {
  LabelSpectrum spectrum = spectrum_of_three();
  spectrum.kind[5] = Kind::Peak;
  EXPECT_EQ(relabel(filtered(spectrum, 16), 30).kind,
            (std::vector<Kind>{Kind::Curved, Kind::Curved, Kind::Peak}));
}

TEST(Isolated, OnlyWhatContinuesTheCreaseCounts) {
  const CreaseDirection along = quantized({1, 0, 0});
  const CreaseDirection across = quantized({0, 0.6, 0.8});
  const CreaseDirection near = quantized({0.8660254, 0.5, 0});       // 30 degrees off
  const CreaseDirection far = quantized({0.7660444, 0, 0.6427876});  // 40 degrees off
  const auto kind_of_first = [](const CreaseDirection& own, const CreaseDirection& other) {
    return relabel(filtered(spectrum_of_three(), 1, {own, other, {}}), 30).kind[0];
  };
  // The third point, a corner without a direction, lies the same way: it supports where the own crease runs
  // there.
  EXPECT_EQ(kind_of_first(along, along), Kind::Edge);
  EXPECT_EQ(kind_of_first(near, near), Kind::Edge);
  EXPECT_EQ(kind_of_first(across, along), Kind::Curved);
  EXPECT_EQ(kind_of_first(far, along), Kind::Curved);
  EXPECT_EQ(kind_of_first({}, {}), Kind::Edge);
  // The second point has the first as its only neighbour.
  const auto kind_of_second = [](const CreaseDirection& own, const CreaseDirection& other) {
    return relabel(filtered(spectrum_of_three(), 1, {other, own, {}}), 30).kind[1];
  };
  EXPECT_EQ(kind_of_second(along, near), Kind::Edge);
  EXPECT_EQ(kind_of_second(along, far), Kind::Curved);
  EXPECT_EQ(kind_of_second(far, along), Kind::Curved);
}

TEST(Isolated, TheScaleOfACloudDoesNotMatter) {
  for (const double scale : {1e-250, 1.0, 1e308}) {
    const auto kind_of_first = [&](const CreaseDirection& own) {
      const std::vector<Point> positions{{-scale, 0, 0}, {scale, 0, 0}, {0, 0, 0}};
      return relabel(without_isolated(spectrum_of_three(), three(), positions, {own, {}, {}}, 1), 30).kind[0];
    };
    EXPECT_EQ(kind_of_first(quantized({1, 0, 0})), Kind::Edge) << scale;
    EXPECT_EQ(kind_of_first(quantized({0, 1, 0})), Kind::Curved) << scale;
  }
}

TEST(Isolated, BordersNeedBorders) {
  LabelSpectrum spectrum = spectrum_of_three();
  spectrum.kind[5] = Kind::Border;
  // Its neighbour is sharp, which does not count.
  EXPECT_EQ(relabel(filtered(spectrum, 1), 30).kind, (std::vector<Kind>{Kind::Edge, Kind::Edge, Kind::Flat}));
  spectrum.kind[4] = Kind::Border;
  EXPECT_EQ(relabel(filtered(spectrum, 1), 30).kind,
            (std::vector<Kind>{Kind::Curved, Kind::Flat, Kind::Border}));
}

TEST(Isolated, MoreSupportKeepsLess) {
  const LabelSpectrum found = filtered(spectrum_of_three(), 2);
  EXPECT_EQ(relabel(found, 30).kind, (std::vector<Kind>{Kind::Curved, Kind::Curved, Kind::Corner}));
  EXPECT_EQ(relabel(found, 15).kind[2], Kind::Curved);
  EXPECT_EQ(relabel(filtered(spectrum_of_three(), 0), 30).kind, relabel(spectrum_of_three(), 30).kind);
}

TEST(Isolated, FilteringTheSpectrumIsFilteringAtEverySensitivity) {
  SynthOptions synth;
  synth.shape = "fandisk";
  synth.points = 1500;
  synth.noise.amount = 0.08;
  const PointCloud cloud = synthesize(synth).cloud;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 16);
  GaussOptions options;
  options.plain = true;
  options.keep_spectrum = true;
  const LabelSpectrum all = *detect_gauss(cloud, neighborhoods, options).spectrum;
  const std::vector<CreaseDirection> unknown(cloud.size());
  const LabelSpectrum kept = without_isolated(all, neighborhoods, cloud.positions, unknown, 5);
  std::size_t removed = 0;
  for (const double sigma_deg : {3.0, 8.0, 15.0, 20.0, 27.5, 40.0, 70.0}) {
    const FeatureLabels before = relabel(all, sigma_deg);
    const FeatureLabels after = relabel(kept, sigma_deg);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      int support = 0;
      for (const std::uint32_t q : neighborhoods.of(i)) support += is_feature(before.kind[q]) ? 1 : 0;
      const bool isolated = is_feature(before.kind[i]) && support < 5;
      removed += isolated ? 1U : 0U;
      ASSERT_EQ(after.kind[i], isolated ? Kind::Curved : before.kind[i]) << i << " at " << sigma_deg;
    }
  }
  EXPECT_GT(removed, 0U);
}

}  // namespace
}  // namespace keenline
