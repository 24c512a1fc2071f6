#include "keenline/report/sensitivity_counts.h"

#include <limits>

#include <gtest/gtest.h>

#include "keenline/detect/gauss.h"
#include "keenline/detect/relabel.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

namespace keenline {
namespace {

TEST(SensitivityCounts, AreThoseOfRelabelling) {
  SynthOptions shape;
  shape.shape = "fandisk";
  shape.points = 3000;
  shape.noise.amount = 0.05;
  PointCloud cloud = synthesize(shape).cloud;
  cloud.positions[17][0] = std::numeric_limits<double>::quiet_NaN();
  GaussOptions options;
  options.keep_spectrum = true;
  const FeatureLabels labels = detect_gauss(cloud, find_neighborhoods(cloud, 16), options);
  ASSERT_TRUE(labels.spectrum);
  const std::vector<KindCounts> counts = counts_per_sensitivity(*labels.spectrum);
  ASSERT_EQ(counts.size(), 65521U);
  for (std::uint32_t s = 0; s < 65520; s += 331)
    EXPECT_EQ(counts[s], count_kinds(relabel(*labels.spectrum, (s + 0.5) / 728).kind)) << s;
  EXPECT_EQ(counts[sensitivity_of(labels.sigma_deg)], count_kinds(labels.kind));
  EXPECT_EQ(counts.back(), count_kinds(relabel(*labels.spectrum, 90).kind));
}

TEST(SensitivityCounts, ChangeExactlyWhereAStepBegins) {
  const LabelSpectrum spectrum{
      {0, 3, 4}, {0, 100, 65520, 0}, {Kind::Flat, Kind::Undecided, Kind::Border, Kind::Peak}, {1, 2, 3, 4}};
  const std::vector<KindCounts> counts = counts_per_sensitivity(spectrum);
  EXPECT_EQ(counts[0], (KindCounts{1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(counts[99], counts[0]);
  EXPECT_EQ(counts[100], (KindCounts{0, 0, 0, 0, 1, 0, 1}));
  EXPECT_EQ(counts[65519], counts[100]);
  EXPECT_EQ(counts[65520], (KindCounts{0, 0, 0, 0, 1, 1, 0}));
}

TEST(SensitivityCounts, OfNothingAreZero) {
  EXPECT_EQ(counts_per_sensitivity({}).at(30000), KindCounts{});
  EXPECT_EQ(count_kinds({}), KindCounts{});
}

}  // namespace
}  // namespace keenline
