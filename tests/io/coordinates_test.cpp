#include "keenline/io/coordinates.h"

#include <array>
#include <cstdio>
#include <limits>

#include <gtest/gtest.h>

#include "keenline/errors.h"
#include "keenline/io/pcd.h"
#include "keenline/io/ply.h"
#include "keenline/io/source.h"
#include "keenline/io/text.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

PointCloud with_axis(const Column& column, ScalarType declared) {
  PointCloud cloud;
  cloud.positions.resize(column.rows());
  EXPECT_EQ(set_axis(cloud, 1, column, declared, no_progress()), std::nullopt);
  return cloud;
}

TEST(Coordinates, FloatsStayFloatsHoweverManyDigitsTheyWerePrintedWith) {
  for (const float value : {0.1F, -123456.789F, 4500000.5F, 1e-30F, 3.4e38F, 16777216.0F, 0.0F}) {
    for (const char* const format : {"%.6g", "%.7g", "%.8g", "%.9g", "%.12g", "%.17g", "%.6e"}) {
      std::array<char, 64> text{};
      std::snprintf(text.data(), text.size(), format, static_cast<double>(value));
      double read = 0;
      if (parse_number(std::string_view(text.data()), read) != Parsed::Ok) continue;
      const PointCloud cloud = with_axis(Column("y", std::vector<double>{read}), ScalarType::Float32);
      EXPECT_EQ(cloud.position_types[1], ScalarType::Float32) << text.data();
      EXPECT_EQ(cloud.positions[0][1], static_cast<double>(static_cast<float>(read)));
    }
  }
}

TEST(Coordinates, MoreDigitsThanAFloatHoldsStayDoubles) {
  for (const double value : {4500000.123, 0.1234567890123, 1e39, -5400000.001}) {
    const PointCloud cloud = with_axis(Column("y", std::vector<double>{0.5, value}), ScalarType::Float32);
    EXPECT_EQ(cloud.position_types[1], ScalarType::Float64) << value;
    EXPECT_EQ(cloud.positions[1][1], value);
  }
}

TEST(Coordinates, NotANumberAndInfinityAreFloatsToo) {
  const double infinity = std::numeric_limits<double>::infinity();
  const PointCloud cloud =
      with_axis(Column("y", std::vector<double>{std::numeric_limits<double>::quiet_NaN(), -infinity, 1}),
                ScalarType::Float32);
  EXPECT_EQ(cloud.position_types[1], ScalarType::Float32);
  EXPECT_EQ(cloud.positions[1][1], -infinity);
}

TEST(Coordinates, IntegersMustSurvive) {
  EXPECT_EQ(with_axis(Column("y", std::vector<std::int64_t>{1LL << 53}), ScalarType::Int64).positions[0][1],
            9007199254740992.0);
  PointCloud cloud;
  cloud.positions.resize(3);
  const Column column("y", std::vector<std::int64_t>{0, (1LL << 53) + 1, 5});
  EXPECT_EQ(set_axis(cloud, 0, column, ScalarType::Int64, no_progress()), 1U);
}

TEST(Coordinates, GeoreferencedTextThatDeclaresFloatsLosesNothing) {
  constexpr std::string_view ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n"
      "4500000.123 5400000.456 312.5\n4500000.124 5400000.457 0.1\n";
  const Reading from_ply = read_ply({"geo.ply", ply}, no_progress());
  EXPECT_EQ(from_ply.cloud.positions[0], (Point{4500000.123, 5400000.456, 312.5}));
  EXPECT_EQ(from_ply.cloud.position_types,
            (std::array{ScalarType::Float64, ScalarType::Float64, ScalarType::Float32}));
  EXPECT_EQ(from_ply.notes, std::vector<std::string>{wide_coordinates_note});

  constexpr std::string_view pcd =
      "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA "
      "ascii\n4500000.123 1 2\n";
  const Reading from_pcd = read_pcd({"geo.pcd", pcd}, no_progress());
  EXPECT_EQ(from_pcd.cloud.positions[0][0], 4500000.123);
  EXPECT_EQ(from_pcd.notes, std::vector<std::string>{wide_coordinates_note});
}

}  // namespace
}  // namespace keenline
