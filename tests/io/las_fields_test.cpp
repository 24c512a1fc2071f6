#include "keenline/io/las_fields.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/las_header.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"
#include "support/las_file.h"

namespace keenline {
namespace {

using test::las_extra_dimension;
using test::LasFile;

struct Fields {
  std::vector<LasField> fields;
  std::vector<std::string> notes;

  [[nodiscard]] const LasField& at(std::string_view name) const {
    for (const LasField& field : fields)
      if (field.name == name) return field;
    throw InvalidArgument("no field " + std::string(name));
  }
  [[nodiscard]] std::string names() const {
    std::string all;
    for (const LasField& field : fields) all += field.name + " ";
    return all;
  }
};

Fields fields_of(const std::string& bytes) {
  const Source source{"a.las", bytes};
  Fields result;
  result.fields = las_fields(source, read_las_header(source), result.notes);
  return result;
}

template <typename... Parts>
void expect_refused(const std::string& bytes, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)fields_of(bytes); }, "a.las: ", parts...);
}

std::string with_extra(std::string_view description, std::uint16_t extra_bytes) {
  return LasFile(4, 0, extra_bytes).add_record("LASF_Spec", 4, description).str();
}

TEST(LasFields, FollowTheOlderFormats) {
  const std::string base =
      "intensity return_number number_of_returns scan_direction_flag edge_of_flight_line classification "
      "synthetic "
      "key_point withheld scan_angle_rank user_data point_source_id ";
  const std::string wave =
      "wave_packet_index wave_packet_offset wave_packet_size wave_return_location wave_dx wave_dy wave_dz ";
  EXPECT_EQ(fields_of(LasFile(2, 0).str()).names(), base);
  EXPECT_EQ(fields_of(LasFile(2, 1).str()).names(), base + "gps_time ");
  EXPECT_EQ(fields_of(LasFile(2, 2).str()).names(), base + "red green blue ");
  EXPECT_EQ(fields_of(LasFile(2, 3).str()).names(), base + "gps_time red green blue ");
  EXPECT_EQ(fields_of(LasFile(3, 4).str()).names(), base + "gps_time " + wave);
  const Fields five = fields_of(LasFile(3, 5).str());
  EXPECT_EQ(five.names(), base + "gps_time red green blue " + wave);
  EXPECT_EQ(five.at("intensity").position, 12U);
  EXPECT_EQ(five.at("edge_of_flight_line").position, 14U);
  EXPECT_EQ(five.at("edge_of_flight_line").shift, 7);
  EXPECT_EQ(five.at("classification").bits, 5);
  EXPECT_EQ(five.at("scan_angle_rank").position, 16U);
  EXPECT_EQ(five.at("scan_angle_rank").type, ScalarType::Int8);
  EXPECT_EQ(five.at("gps_time").position, 20U);
  EXPECT_EQ(five.at("red").position, 28U);
  EXPECT_EQ(five.at("wave_packet_offset").position, 35U);
  EXPECT_EQ(five.at("wave_dz").position, 59U);
}

TEST(LasFields, FollowTheNewerFormats) {
  const std::string base =
      "intensity return_number number_of_returns synthetic key_point withheld overlap scanner_channel "
      "scan_direction_flag edge_of_flight_line classification user_data scan_angle point_source_id gps_time ";
  const std::string wave =
      "wave_packet_index wave_packet_offset wave_packet_size wave_return_location wave_dx wave_dy wave_dz ";
  EXPECT_EQ(fields_of(LasFile(4, 6).str()).names(), base);
  EXPECT_EQ(fields_of(LasFile(4, 7).str()).names(), base + "red green blue ");
  EXPECT_EQ(fields_of(LasFile(4, 8).str()).names(), base + "red green blue nir ");
  EXPECT_EQ(fields_of(LasFile(4, 9).str()).names(), base + wave);
  const Fields ten = fields_of(LasFile(4, 10).str());
  EXPECT_EQ(ten.names(), base + "red green blue nir " + wave);
  EXPECT_EQ(ten.at("number_of_returns").shift, 4);
  EXPECT_EQ(ten.at("scanner_channel").position, 15U);
  EXPECT_EQ(ten.at("scanner_channel").shift, 4);
  EXPECT_EQ(ten.at("scanner_channel").bits, 2);
  EXPECT_EQ(ten.at("classification").position, 16U);
  EXPECT_EQ(ten.at("scan_angle").position, 18U);
  EXPECT_EQ(ten.at("scan_angle").type, ScalarType::Int16);
  EXPECT_EQ(ten.at("gps_time").position, 22U);
  EXPECT_EQ(ten.at("nir").position, 36U);
  EXPECT_EQ(ten.at("wave_dz").position, 63U);
}

TEST(LasFields, KeepBytesWithoutDescription) {
  const Fields fields = fields_of(LasFile(2, 0, 7).str());
  const LasField& extra = fields.at("extra_bytes");
  EXPECT_EQ(extra.position, 20U);
  EXPECT_EQ(extra.values, 7U);
  EXPECT_TRUE(extra.is_list);
  EXPECT_TRUE(fields.notes.empty());
}

TEST(LasFields, FollowTheDescriptionOfExtraBytes) {
  std::string opaque = las_extra_dimension("opaque", 0);
  opaque[3] = 5;  // bytes
  const Fields fields = fields_of(
      with_extra(las_extra_dimension("range", 9) + las_extra_dimension("normal", 26, 0.5, 3) + opaque +
                     las_extra_dimension("long", 7) + las_extra_dimension("pair", 11, 1, 8),
                 4 + 12 + 5 + 8 + 2 + 1));
  EXPECT_EQ(fields.at("range").position, 20U);
  EXPECT_EQ(fields.at("range").type, ScalarType::Float32);
  EXPECT_FALSE(fields.at("range").transform);
  const LasField& normal = fields.at("normal");
  EXPECT_EQ(normal.position, 24U);
  EXPECT_EQ(normal.type, ScalarType::Int32);
  EXPECT_EQ(normal.values, 3U);
  ASSERT_TRUE(normal.transform);
  EXPECT_EQ(normal.transform->scale, (std::array{0.5, 0.5, 0.5}));
  EXPECT_EQ(normal.transform->offset, (std::array{3.0, 3.0, 3.0}));
  EXPECT_EQ(fields.at("opaque").values, 5U);
  EXPECT_EQ(fields.at("opaque").position, 36U);
  EXPECT_EQ(fields.at("long").type, ScalarType::UInt64);
  EXPECT_EQ(fields.at("pair").values, 2U);
  EXPECT_EQ(fields.at("pair").transform->scale[0], 1.0);
  EXPECT_EQ(fields.at("pair").transform->offset[1], 8.0);
  EXPECT_EQ(fields.at("extra_bytes").position, 51U);
  EXPECT_EQ(fields.at("extra_bytes").values, 1U);
}

TEST(LasFields, MakeNamesUnique) {
  const Fields fields = fields_of(with_extra(
      las_extra_dimension("intensity", 1) + las_extra_dimension("", 1) + las_extra_dimension("x", 1), 3));
  EXPECT_EQ(fields.at("intensity_2").position, 20U);
  EXPECT_EQ(fields.at("extra").position, 21U);
  EXPECT_EQ(fields.at("x_2").position, 22U);
  ASSERT_EQ(fields.notes.size(), 3U);
  EXPECT_EQ(fields.notes[0], "the extra dimension 'intensity' is called 'intensity_2' here");
}

TEST(LasFields, RefuseDescriptionsThatLie) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::size_t start = 375 + 54;
  expect_refused(with_extra(las_extra_dimension("a", 1) + "more", 9), "byte 429", "196 bytes",
                 "multiple of 192");
  expect_refused(with_extra(las_extra_dimension("a", 31), 9), "byte " + std::to_string(start + 2),
                 "data type 31", "'a'");
  expect_refused(with_extra(las_extra_dimension("a", 1) + las_extra_dimension("b", 10), 8),
                 "byte " + std::to_string(start + 192), "'b' of 8 bytes", "at most 7");
  expect_refused(with_extra(las_extra_dimension("a", 0), 8), "byte " + std::to_string(start + 3),
                 "'a' of 0 bytes");
  expect_refused(with_extra(las_extra_dimension("a", 1, nan), 8), "scale nan", "'a'");
  expect_refused(LasFile(4, 0, 1)
                     .add_record("LASF_Spec", 4, las_extra_dimension("a", 1))
                     .add_record("LASF_Spec", 4, las_extra_dimension("a", 1))
                     .str(),
                 "a second Extra Bytes");
}

}  // namespace
}  // namespace keenline
