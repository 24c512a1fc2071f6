#include "keenline/detect/spectrum_attributes.h"

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"

#include "support/expect_error.h"
#include "support/temporary_folder.h"

namespace keenline {
namespace {

using test::expect_error;

/// Three points with 2, 1 and 3 steps.
LabelSpectrum small_spectrum() {
  return {{0, 2, 3, 6},
          {0, 7280, 0, 0, 1, 65520},
          {Kind::Flat, Kind::Edge, Kind::Undecided, Kind::Curved, Kind::Border, Kind::Peak},
          {1, 2, 0, 255, 1, 3}};
}

PointCloud cloud_with(const LabelSpectrum& spectrum) {
  PointCloud cloud;
  cloud.positions.resize(spectrum.size());
  for (Column& column : spectrum_columns(spectrum)) cloud.set_attribute(std::move(column));
  return cloud;
}

template <typename T>
Column lists(const char* name, const std::vector<std::vector<T>>& rows) {
  std::vector<std::uint64_t> offsets{0};
  std::vector<T> values;
  for (const std::vector<T>& row : rows) {
    values.insert(values.end(), row.begin(), row.end());
    offsets.push_back(values.size());
  }
  std::vector<std::byte> bytes(values.size() * sizeof(T));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return {name, scalar_type_of<T>(), ScalarType::UInt8, offsets, bytes};
}

void expect_equal(const LabelSpectrum& a, const LabelSpectrum& b) {
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.from, b.from);
  EXPECT_EQ(a.kind, b.kind);
  EXPECT_EQ(a.clusters, b.clusters);
}

TEST(SpectrumAttributes, SurviveAFile) {
  const test::TemporaryFolder folder;
  for (const LabelSpectrum& spectrum : {small_spectrum(), LabelSpectrum{}}) {
    EXPECT_TRUE(write_cloud(folder.file("a.ply"), cloud_with(spectrum)).empty());
    const PointCloud cloud = read_cloud(folder.file("a.ply")).cloud;
    EXPECT_EQ(cloud.attributes.size(), 3U);
    EXPECT_EQ(cloud.attribute("spectrum_from")->type(), ScalarType::UInt16);
    EXPECT_EQ(cloud.attribute("spectrum_kind")->type(), ScalarType::UInt8);
    EXPECT_EQ(cloud.attribute("spectrum_clusters")->type(), ScalarType::UInt8);
    for (const Column& column : cloud.attributes) EXPECT_EQ(column.count_type(), ScalarType::UInt8);
    expect_equal(spectrum_of(cloud), spectrum);
  }
}

TEST(SpectrumAttributes, LongListsHaveALongerCount) {
  for (const std::size_t steps : {255U, 256U}) {
    LabelSpectrum spectrum;
    for (std::size_t i = 0; i < steps; ++i) spectrum.from.push_back(static_cast<std::uint16_t>(i));
    spectrum.kind.assign(steps, Kind::Flat);
    spectrum.clusters.assign(steps, 1);
    spectrum.offsets = {0, steps};
    const PointCloud cloud = cloud_with(spectrum);
    for (const Column& column : cloud.attributes)
      EXPECT_EQ(column.count_type(), steps == 255 ? ScalarType::UInt8 : ScalarType::UInt16);
    expect_equal(spectrum_of(cloud), spectrum);
  }
}

TEST(SpectrumAttributes, VectorsThatDoNotMatchAreRefused) {
  LabelSpectrum spectrum = small_spectrum();
  spectrum.clusters.pop_back();
  expect_error<InvalidArgument>([&] { (void)spectrum_columns(spectrum); }, "spectrum_clusters");
}

TEST(SpectrumAttributes, MayHaveAnyIntegerType) {
  PointCloud cloud = cloud_with(small_spectrum());
  cloud.set_attribute(lists<std::int64_t>("spectrum_from", {{0, 7280}, {0}, {0, 1, 65520}}));
  cloud.set_attribute(lists<std::int16_t>("spectrum_kind", {{0, 2}, {255}, {1, 5, 4}}));
  cloud.set_attribute(lists<std::uint32_t>("spectrum_clusters", {{1, 2}, {0}, {255, 1, 3}}));
  expect_equal(spectrum_of(cloud), small_spectrum());
}

TEST(SpectrumAttributes, MissingOrOtherAttributesAreRefusedByName) {
  for (const char* const name : {"spectrum_from", "spectrum_kind", "spectrum_clusters"}) {
    const auto refuses = [&](const Column& column, const char* found) {
      PointCloud cloud = cloud_with(small_spectrum());
      cloud.set_attribute(column);
      expect_error<InvalidArgument>([&] { (void)spectrum_of(cloud); }, name, found, "list of integers");
    };
    refuses(Column(name, std::vector<std::uint16_t>{0, 0, 0}), "uint16");
    refuses(lists<float>(name, {{0, 1}, {0}, {0, 1, 2}}), "list of float32");

    PointCloud cloud = cloud_with(small_spectrum());
    std::erase_if(cloud.attributes, [&](const Column& column) { return column.name() == name; });
    expect_error<InvalidArgument>([&] { (void)spectrum_of(cloud); }, name, "detect --spectrum");
    cloud.attributes.push_back(lists<std::uint8_t>(name, {{0}, {0}}));
    expect_error<InvalidArgument>([&] { (void)spectrum_of(cloud); }, name, "2 lists", "3 points");
  }
}

TEST(SpectrumAttributes, WrongValuesAreRefusedWithTheirPoint) {
  using Rows = std::vector<std::vector<std::int32_t>>;
  const auto refuses = [](const char* name, const Rows& rows, const char* point, const char* found) {
    PointCloud cloud = cloud_with(small_spectrum());
    cloud.set_attribute(lists<std::int32_t>(name, rows));
    expect_error<InvalidArgument>([&] { (void)spectrum_of(cloud); }, name, point, found);
  };
  refuses("spectrum_from", {{0, 1}, {0}, {0, 1, 65521}}, "point 2", "found 65521, expected 0 to 65520");
  refuses("spectrum_from", {{0, 1}, {-1}, {0, 1, 2}}, "point 1", "found -1,");
  refuses("spectrum_from", {{0, 1}, {7}, {0, 1, 2}}, "point 1", "found 7 as the first value, expected 0");
  refuses("spectrum_from", {{0, 0}, {0}, {0, 1, 2}}, "point 0", "found 0 after 0, expected rising");
  refuses("spectrum_from", {{0, 1}, {0}, {0, 9, 8}}, "point 2", "found 8 after 9, expected rising");
  refuses("spectrum_kind", {{0, 1}, {0}, {0, 1, 6}}, "point 2", "found 6, expected the number of a kind");
  refuses("spectrum_kind", {{0, 1}, {256}, {0, 1, 2}}, "point 1", "found 256, expected 0 to 255");
  refuses("spectrum_kind", {{0, 1}, {0, 0}, {0, 1}}, "point 1", "found 2 values, expected 1");
  refuses("spectrum_clusters", {{0, 1}, {0}, {0, 1, 2, 3}}, "point 2", "found 4 values, expected 3");
  refuses("spectrum_clusters", {{0, 256}, {0}, {0, 1, 2}}, "point 0", "found 256, expected 0 to 255");
}

TEST(SpectrumAttributes, APointWithoutStepsIsRefused) {
  PointCloud cloud;
  cloud.positions.resize(2);
  for (const char* const name : {"spectrum_from", "spectrum_kind", "spectrum_clusters"})
    cloud.set_attribute(lists<std::uint8_t>(name, {{0}, {}}));
  expect_error<InvalidArgument>([&] { (void)spectrum_of(cloud); }, "spectrum_from", "point 1", "empty");
}

TEST(SpectrumAttributes, CanBeRemoved) {
  PointCloud cloud = cloud_with(small_spectrum());
  cloud.set_attribute(Column("spectrum", ScalarType::UInt8, 3));
  cloud.comments = {"by hand", "keenline sigma 20", "keenline"};
  EXPECT_EQ(remove_spectrum(cloud),
            (std::vector<std::string>{"spectrum_from", "spectrum_kind", "spectrum_clusters"}));
  ASSERT_EQ(cloud.attributes.size(), 1U);
  EXPECT_EQ(cloud.attributes[0].name(), "spectrum");
  EXPECT_EQ(cloud.comments, (std::vector<std::string>{"by hand", "keenline"}));
  EXPECT_TRUE(remove_spectrum(cloud).empty());
}

TEST(SpectrumAttributes, OneCommentTellsTheSigma) {
  PointCloud cloud;
  cloud.comments = {"a"};
  set_sigma_comment(cloud, 20);
  EXPECT_EQ(cloud.comments, (std::vector<std::string>{"a", "keenline sigma 20"}));
  cloud.comments = {"a", "keenline sigma 20", "b", "keenline sigma 7", "c"};
  set_sigma_comment(cloud, 9.9);
  EXPECT_EQ(cloud.comments, (std::vector<std::string>{"a", "keenline sigma 9.9", "b", "c"}));
}

}  // namespace
}  // namespace keenline
