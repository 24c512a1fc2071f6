#include "keenline/io/las.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"
#include "keenline/progress.h"

#include "support/las_file.h"

namespace keenline {
namespace {

using test::Bytes;
using test::las_extra_dimension;
using test::LasFile;

Reading read(std::string_view bytes) { return read_las({"a.las", bytes}, no_progress()); }

double value(const Reading& reading, std::string_view name, std::size_t i = 0) {
  const Column* const column = reading.cloud.attribute(name);
  if (column == nullptr) throw InvalidArgument("no attribute " + std::string(name));
  return column->value(i);
}

bool has_note(const Reading& reading, std::string_view part) {
  for (const std::string& note : reading.notes)
    if (note.find(part) != std::string::npos) return true;
  return false;
}

TEST(Las, ReadsEveryVersionAndPointFormat) {
  for (unsigned minor = 0; minor <= 4; ++minor) {
    for (unsigned format = 0; format <= 10; ++format) {
      const Reading reading =
          read(LasFile(minor, format, 2).add_point(100, -200, 2147483647).add_point(0, 1, 2).str());
      EXPECT_EQ(reading.encoding, "1." + std::to_string(minor) + ", point format " + std::to_string(format));
      ASSERT_EQ(reading.cloud.size(), 2U);
      EXPECT_EQ(reading.cloud.positions[0], (Point{1, 998, 2147483647 * 0.01 + 2000}));
      EXPECT_EQ(reading.cloud.positions[1], (Point{0, 1000.01, 2000.02}));
      EXPECT_EQ(reading.cloud.position_types[0], ScalarType::Float64);
      EXPECT_EQ(reading.cloud.attribute("extra_bytes")->value_count(), 4U);
      for (const Column& column : reading.cloud.attributes) EXPECT_EQ(column.rows(), 2U) << column.name();
      EXPECT_EQ(has_note(reading, "waveforms"), format == 4 || format == 5 || format >= 9);
    }
  }
}

TEST(Las, TakesAnOlderPointApart) {
  const std::string point =
      Bytes()
          .add(1, 2, 3, std::uint16_t{40000})
          .add(std::uint8_t{0b1'0'101'011}, std::uint8_t{0b1'0'1'00110}, std::int8_t{-90}, std::uint8_t{77})
          .add(std::uint16_t{60000}, 123456.75, std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{65535})
          .add(std::uint8_t{9}, std::uint64_t{1} << 40, 1000U, 0.5F, 1.5F, 2.5F, 3.5F)
          .str();
  const Reading reading = read(LasFile(3, 5).add_point(0, 0, 0).add_point(point).str());
  const auto expect = [&](std::string_view name, double expected, ScalarType type) {
    EXPECT_EQ(value(reading, name, 1), expected) << name;
    EXPECT_EQ(value(reading, name, 0), 0) << name;
    EXPECT_EQ(reading.cloud.attribute(name)->type(), type) << name;
  };
  expect("intensity", 40000, ScalarType::UInt16);
  expect("return_number", 3, ScalarType::UInt8);
  expect("number_of_returns", 5, ScalarType::UInt8);
  expect("scan_direction_flag", 0, ScalarType::UInt8);
  expect("edge_of_flight_line", 1, ScalarType::UInt8);
  expect("classification", 6, ScalarType::UInt8);
  expect("synthetic", 1, ScalarType::UInt8);
  expect("key_point", 0, ScalarType::UInt8);
  expect("withheld", 1, ScalarType::UInt8);
  expect("scan_angle_rank", -90, ScalarType::Int8);
  expect("user_data", 77, ScalarType::UInt8);
  expect("point_source_id", 60000, ScalarType::UInt16);
  expect("gps_time", 123456.75, ScalarType::Float64);
  expect("red", 1, ScalarType::UInt16);
  expect("green", 2, ScalarType::UInt16);
  expect("blue", 65535, ScalarType::UInt16);
  expect("wave_packet_index", 9, ScalarType::UInt8);
  expect("wave_packet_offset", 1099511627776.0, ScalarType::UInt64);
  expect("wave_packet_size", 1000, ScalarType::UInt32);
  expect("wave_return_location", 0.5, ScalarType::Float32);
  expect("wave_dx", 1.5, ScalarType::Float32);
  expect("wave_dy", 2.5, ScalarType::Float32);
  expect("wave_dz", 3.5, ScalarType::Float32);
}

TEST(Las, TakesANewerPointApart) {
  const std::string point =
      Bytes()
          .add(1, 2, 3, std::uint16_t{7})
          .add(std::uint8_t{0b1111'1010}, std::uint8_t{0b1'0'10'1'0'1'0}, std::uint8_t{64})
          .add(std::uint8_t{77}, std::int16_t{-30000}, std::uint16_t{8}, -0.5)
          .add(std::uint16_t{1}, std::uint16_t{2}, std::uint16_t{3}, std::uint16_t{4})
          .str();
  const Reading reading = read(LasFile(4, 8).add_point(point).str());
  EXPECT_EQ(value(reading, "return_number"), 10);
  EXPECT_EQ(value(reading, "number_of_returns"), 15);
  EXPECT_EQ(value(reading, "synthetic"), 0);
  EXPECT_EQ(value(reading, "key_point"), 1);
  EXPECT_EQ(value(reading, "withheld"), 0);
  EXPECT_EQ(value(reading, "overlap"), 1);
  EXPECT_EQ(value(reading, "scanner_channel"), 2);
  EXPECT_EQ(value(reading, "scan_direction_flag"), 0);
  EXPECT_EQ(value(reading, "edge_of_flight_line"), 1);
  EXPECT_EQ(value(reading, "classification"), 64);
  EXPECT_EQ(value(reading, "user_data"), 77);
  EXPECT_EQ(value(reading, "scan_angle"), -30000);
  EXPECT_EQ(value(reading, "point_source_id"), 8);
  EXPECT_EQ(value(reading, "gps_time"), -0.5);
  EXPECT_EQ(value(reading, "red"), 1);
  EXPECT_EQ(value(reading, "nir"), 4);
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Las, ReadsExtraDimensions) {
  LasFile file(4, 0, 4 + 6 + 8 + 1);
  file.add_record("LASF_Spec", 4,
                  las_extra_dimension("height", 6, 0.001, 100) + las_extra_dimension("tuple", 24) +
                      las_extra_dimension("id", 7));
  Bytes point(std::string(20, '\0'));
  point.add(-5000, std::int16_t{-1}, std::int16_t{2}, std::int16_t{3}, ~std::uint64_t{0}, std::uint8_t{42});
  const Reading reading = read(file.add_point(point.str()).add_point(0, 0, 0).str());
  EXPECT_EQ(value(reading, "height", 0), -5000 * 0.001 + 100);
  EXPECT_EQ(value(reading, "height", 1), 100);
  EXPECT_EQ(reading.cloud.attribute("height")->type(), ScalarType::Float64);
  const Column& tuple = *reading.cloud.attribute("tuple");
  EXPECT_TRUE(tuple.is_list());
  EXPECT_EQ(tuple.type(), ScalarType::Int16);
  EXPECT_EQ(tuple.rows(), 2U);
  EXPECT_EQ(tuple.value(0), -1);
  EXPECT_EQ(tuple.value(2), 3);
  EXPECT_EQ(tuple.value(3), 0);
  EXPECT_EQ(reading.cloud.attribute("id")->values<std::uint64_t>()[0], ~std::uint64_t{0});
  EXPECT_EQ(reading.cloud.attribute("extra_bytes")->value(0), 42);
  EXPECT_EQ(reading.cloud.attribute("extra_bytes")->rows(), 2U);
}

TEST(Las, ScalesTuples) {
  LasFile file(4, 0, 4);
  std::string description = las_extra_dimension("pair", 13, 0.5, 1);
  description = Bytes(description).put(112 + 8, 0.25).put(136 + 8, 2.0).str();
  file.add_record("LASF_Spec", 4, description);
  const std::string point = Bytes(std::string(20, '\0')).add(std::uint16_t{10}, std::uint16_t{100}).str();
  const Reading reading = read(file.add_point(point).add_point(point).str());
  const Column& pair = *reading.cloud.attribute("pair");
  EXPECT_EQ(pair.type(), ScalarType::Float64);
  ASSERT_EQ(pair.value_count(), 4U);
  EXPECT_EQ(pair.rows(), 2U);
  EXPECT_EQ(pair.value(2), 6.0);
  EXPECT_EQ(pair.value(3), 27.0);
}

TEST(Las, KeepsTheCoordinateSystem) {
  const std::string wkt("PROJCS[\"a\",\r\n UNIT[1]]\0\0", 24);
  const Reading before =
      read(LasFile(4, 6).add_record("LASF_Projection", 2112, wkt).add_point(1, 2, 3).str());
  EXPECT_EQ(before.cloud.comments, std::vector<std::string>{"crs_wkt PROJCS[\"a\",   UNIT[1]]"});
  EXPECT_TRUE(before.notes.empty());
  const Reading behind =
      read(LasFile(4, 6).add_point(1, 2, 3).add_extended_record("LASF_Projection", 2112, "LOCAL_CS[]").str());
  EXPECT_EQ(behind.cloud.comments, std::vector<std::string>{"crs_wkt LOCAL_CS[]"});
}

TEST(Las, KeepsTheCodeAmongGeotiffKeys) {
  const std::string keys("\1\0\1\0\0\0\1\0\0\x0C\0\0\1\0\xE8\x64", 16);  // 3072: 25832
  const Reading reading = read(LasFile(2, 0)
                                   .add_record("LASF_Projection", 34735, keys)
                                   .add_record("LASF_Projection", 34737, "UTM")
                                   .add_point(1, 2, 3)
                                   .str());
  EXPECT_EQ(reading.cloud.comments, std::vector<std::string>{"crs_epsg 25832"});
  EXPECT_TRUE(reading.notes.empty());
}

TEST(Las, TellsWhatItLeavesOut) {
  const Reading reading = read(LasFile(2, 0)
                                   .add_record("LASF_Projection", 34735, "keys")
                                   .add_record("LASF_Projection", 34736, "numbers")
                                   .add_record("somebody", 1, "something")
                                   .add_point(1, 2, 3)
                                   .str());
  EXPECT_EQ(reading.notes.size(), 2U);
  EXPECT_TRUE(has_note(reading, "GeoTIFF"));
  EXPECT_TRUE(has_note(reading, "1 variable length records"));
}

TEST(Las, ReadsFilesWithoutPoints) {
  const Reading reading = read(LasFile(4, 10, 3).str());
  EXPECT_EQ(reading.cloud.size(), 0U);
  EXPECT_EQ(reading.cloud.attribute("extra_bytes")->rows(), 0U);
}

TEST(Las, ReadsTheSameWithAnyNumberOfThreads) {
  LasFile file(2, 1);
  for (int i = 0; i < 50000; ++i) file.add_point(i, -i, 7 * i);
  const auto read_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return read(file.str()).cloud.positions;
  };
  const std::vector<Point> one = read_with(1);
  EXPECT_EQ(one, read_with(8));
  EXPECT_EQ(one[49999][0], 49999 * 0.01);
}

TEST(Las, IsRecognised) {
  EXPECT_EQ(match_las({"a", LasFile(2, 0).str()}), Format::Match::Strong);
  EXPECT_EQ(match_las({"a", "LAS 1 2 3"}), Format::Match::No);
  EXPECT_EQ(match_las({"a", ""}), Format::Match::No);
}

}  // namespace
}  // namespace keenline
