#include "keenline/io/las_header.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/source.h"

#include "support/expect_error.h"
#include "support/las_file.h"

namespace keenline {
namespace {

using test::LasFile;

LasHeader read(std::string_view bytes) { return read_las_header({"a.las", bytes}); }

template <typename... Parts>
void expect_refused(std::string_view bytes, const Parts&... parts) {
  test::expect_error<InputError>([&] { (void)read(bytes); }, "a.las: ", parts...);
}

LasFile small_file(unsigned minor = 2, unsigned format = 0) {
  return LasFile(minor, format).add_point(1, 2, 3).add_point(4, 5, 6);
}

TEST(LasHeader, KnowsTheSizeOfEveryPointFormat) {
  for (unsigned format = 0; format <= 10; ++format)
    EXPECT_EQ(las_point_size(format), test::las_point_sizes[format]);
}

TEST(LasHeader, HoldsWhereThePointsAre) {
  for (unsigned minor = 0; minor <= 4; ++minor) {
    LasFile file =
        LasFile(minor, 3, 5).add_record("somebody", 7, "data").add_record("LASF_Projection", 2112, "");
    const std::size_t start = file.bytes().size();
    const LasHeader header = read(file.add_point(1, 2, 3).str());
    EXPECT_EQ(header.minor_version, minor);
    EXPECT_EQ(header.point_format, 3U);
    EXPECT_EQ(header.record_length, 39U);
    EXPECT_EQ(header.points_start, start);
    EXPECT_EQ(header.point_count, 1U);
    EXPECT_EQ(header.scale, (std::array{0.01, 0.01, 0.01}));
    EXPECT_EQ(header.offset, (std::array{0.0, 1000.0, 2000.0}));
    ASSERT_EQ(header.records.size(), 2U);
    EXPECT_EQ(header.records[0].user_id, "somebody");
    EXPECT_EQ(header.records[0].id, 7);
    EXPECT_EQ(header.records[0].data, "data");
    EXPECT_EQ(header.records[0].data_start, test::las_header_sizes[minor] + 54U);
    EXPECT_EQ(header.records[1].user_id, "LASF_Projection");
    EXPECT_EQ(header.records[1].data, "");
  }
}

TEST(LasHeader, RefusesWhatIsNotLas) {
  expect_refused("", "byte 0", "an empty file");
  expect_refused("LASX" + std::string(500, '\0'), "byte 0", "'LASX'", "'LASF'");
  expect_refused("LASF", "byte 4", "the end of the file", "227 bytes");
  LasFile version = small_file();
  version.bytes().put(24, std::uint8_t{2});
  expect_refused(version.str(), "byte 24", "LAS version 2.2", "1.0 to 1.4");
  LasFile minor = small_file();
  minor.bytes().put(25, std::uint8_t{5});
  expect_refused(minor.str(), "byte 24", "LAS version 1.5");
}

TEST(LasHeader, RefusesCompressedFiles) {
  for (const unsigned flags : {0x80U, 0x40U, 0xC0U}) {
    LasFile file = small_file();
    file.bytes().put(104, static_cast<std::uint8_t>(flags));
    expect_refused(file.str(), "byte 104", "LAZ-compressed",
                   "uncompressed LAS (decompress it first, e.g. with laszip or PDAL)");
  }
  expect_refused(LasFile(2, 0).add_record("laszip encoded", 22204, "x").add_point(1, 2, 3).str(), "byte 281",
                 "LAZ-compressed");
}

TEST(LasHeader, RefusesSizesThatLie) {
  const auto spoilt = [](std::size_t offset, auto value) {
    LasFile file = small_file();
    file.bytes().put(offset, value);
    return file.str();
  };
  expect_refused(spoilt(94, std::uint16_t{226}), "byte 94", "226", "at least 227");
  expect_refused(spoilt(94, std::uint16_t{60000}), "the end of the file", "60000 bytes");
  expect_refused(spoilt(94, std::uint16_t{228}), "byte 96", "byte 227", "header of 228");
  expect_refused(spoilt(96, std::uint32_t{226}), "byte 96", "byte 226", "behind the header of 227");
  expect_refused(spoilt(96, std::uint32_t{268}), "byte 96", "byte 268", "the file of 267 bytes");
  expect_refused(spoilt(96, std::uint32_t{0xFFFFFFFF}), "byte 96", "byte 4294967295");
  expect_refused(spoilt(100, std::uint32_t{1}), "byte 100", "1 variable length records", "at most 0");
  expect_refused(spoilt(100, std::uint32_t{0xFFFFFFFF}), "byte 100", "4294967295 variable length records");
  expect_refused(spoilt(104, std::uint8_t{11}), "byte 104", "point format 11", "0 to 10");
  expect_refused(spoilt(105, std::uint16_t{19}), "byte 105", "points of 19 bytes", "at least 20");
  expect_refused(spoilt(105, std::uint16_t{0}), "byte 105", "points of 0 bytes");
  expect_refused(spoilt(107, std::uint32_t{3}), "byte 267", "the end of the file after 2 points",
                 "3 points of 20 bytes");
  expect_refused(spoilt(107, std::uint32_t{0x80000000}), "2147483648 points");
  expect_refused(spoilt(107, std::uint32_t{1}), "byte 247", "20 bytes more", "room for 1 more points",
                 "1 points");
  expect_refused(spoilt(107, std::uint32_t{0}), "byte 227", "40 bytes more", "0 points");
  LasFile newer = small_file(4, 6);
  newer.bytes().put(94, std::uint16_t{227});
  expect_refused(newer.str(), "byte 94", "at least 375");
}

TEST(LasHeader, RefusesRecordsThatLie) {
  LasFile length = LasFile(2, 0).add_record("a", 1, "12345").add_point(1, 2, 3);
  length.bytes().put(227 + 20, std::uint16_t{6});
  expect_refused(length.str(), "byte 247", "6 bytes", "at most 5");
  length.bytes().put(227 + 20, std::uint16_t{0xFFFF});
  expect_refused(length.str(), "byte 247", "65535 bytes");
  LasFile second = LasFile(2, 0).add_record("a", 1, std::string(54, 'd')).add_point(1, 2, 3);
  second.bytes().put(100, std::uint32_t{2});
  expect_refused(second.str(), "byte 335", "the end of the records", "record 2 of 2");
}

TEST(LasHeader, RefusesTransformsThatAreNone) {
  const auto with = [](std::size_t offset, double value) {
    LasFile file = small_file();
    file.bytes().put(offset, value);
    return file.str();
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expect_refused(with(131, nan), "byte 131", "a coordinate scale of nan", "finite");
  expect_refused(with(139, 0.0), "byte 139", "a coordinate scale of 0");
  expect_refused(with(147, infinity), "byte 147", "a coordinate scale of inf");
  expect_refused(with(155, nan), "byte 155", "a coordinate offset of nan");
  expect_refused(with(171, -infinity), "byte 171", "a coordinate offset of -inf");
  expect_refused(with(131, 1e300), "byte 131", "1e+300", "a double");
  EXPECT_EQ(read(with(131, -1e-3)).scale[0], -1e-3);
}

TEST(LasHeader, SettlesTheTwoCountsOf14) {
  const auto with_counts = [](std::uint32_t legacy, std::uint64_t count) {
    LasFile file = small_file(4, 6);
    file.bytes().put(107, legacy).put(247, count);
    return file.str();
  };
  EXPECT_EQ(read(with_counts(2, 0)).point_count, 2U);
  EXPECT_EQ(read(with_counts(0, 2)).point_count, 2U);
  EXPECT_EQ(read(with_counts(2, 2)).point_count, 2U);
  expect_refused(with_counts(1, 2), "byte 247", "2 points", "byte 107 is 1");
  expect_refused(with_counts(0, 0), "byte 375", "60 bytes more", "0 points");
  expect_refused(with_counts(0, std::uint64_t{1} << 63), "9223372036854775808 points of 30 bytes");
  expect_refused(with_counts(0, std::numeric_limits<std::uint64_t>::max()), "18446744073709551615 points");
  EXPECT_EQ(read(LasFile(4, 6).str()).point_count, 0U);
}

TEST(LasHeader, TakesLessThanAPointBehindThePoints) {
  LasFile file = small_file();
  EXPECT_EQ(read(file.str() + std::string(19, '\0')).point_count, 2U);
  expect_refused(file.str() + std::string(20, '\0'), "byte 267", "20 bytes more");
}

TEST(LasHeader, ReadsExtendedRecords) {
  LasFile file =
      small_file(4, 6).add_extended_record("LASF_Projection", 2112, "wkt").add_extended_record("b", 2, "");
  const LasHeader header = read(file.str());
  ASSERT_EQ(header.records.size(), 2U);
  EXPECT_EQ(header.records[0].data, "wkt");
  EXPECT_EQ(header.records[1].id, 2);
  expect_refused(file.str() + std::string(30, '\0'), "30 bytes more");

  const auto spoilt = [&](std::size_t offset, auto value) {
    LasFile copy = file;
    copy.bytes().put(offset, value);
    return copy.str();
  };
  expect_refused(spoilt(235, std::uint64_t{434}), "byte 235", "byte 434", "between bytes 435 and 558");
  expect_refused(spoilt(235, std::numeric_limits<std::uint64_t>::max()), "byte 235");
  expect_refused(spoilt(243, std::uint32_t{3}), "byte 243", "3 variable length records", "at most 2");
  expect_refused(spoilt(243, std::uint32_t{1}), "byte 498", "60 bytes more");
  expect_refused(spoilt(435 + 20, std::uint64_t{1} << 63), "byte 455", "9223372036854775808 bytes",
                 "at most 63");
  // Nothing tells that records follow.
  expect_refused(spoilt(243, std::uint32_t{0}), "byte 435", "room for 4 more points");
}

TEST(LasHeader, TakesWaveformsBehindThePoints) {
  LasFile file = small_file(3, 4);
  const std::size_t end = file.bytes().size();
  file.bytes().text(std::string(1000, 'w'));
  expect_refused(file.str(), "1000 bytes more");
  file.bytes().put(227, std::uint64_t{end});
  EXPECT_EQ(read(file.str()).point_count, 2U);
  file.bytes().put(6, std::uint16_t{2}).put(227, std::uint64_t{end - 1});
  expect_refused(file.str(), "byte 227");
}

TEST(LasHeader, RefusesAFileCutOffAnywhere) {
  const std::string whole = LasFile(4, 10, 3)
                                .add_record("a", 1, "data")
                                .add_point(1, 2, 3)
                                .add_extended_record("b", 2, "more")
                                .str();
  EXPECT_EQ(read(whole).point_count, 1U);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const std::string part = whole.substr(0, size);
    EXPECT_THROW((void)read(part), InputError) << size;
  }
}

}  // namespace
}  // namespace keenline
