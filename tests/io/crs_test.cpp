#include "keenline/io/crs.h"

#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace keenline {
namespace {

std::string bytes_of(const std::vector<std::uint16_t>& numbers) {
  std::string bytes;
  for (const std::uint16_t n : numbers) {
    bytes += static_cast<char>(n & 0xFFU);
    bytes += static_cast<char>(n >> 8U);
  }
  return bytes;
}

constexpr std::string_view utm =
    R"(PROJCS["ETRS89 / UTM zone 32N", GEOGCS["ETRS89", DATUM["ETRS89 [\]", AUTHORITY["EPSG","6258"]],
       AUTHORITY["EPSG","4258"]], UNIT["metre",1, AUTHORITY["EPSG","9001"]], AUTHORITY["EPSG", "25832"]])";

TEST(Crs, GeotiffKeysNameTheProjectedSystemFirst) {
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 3, 1024, 0, 1, 1, 3072, 0, 1, 25832, 2048, 0, 1, 4258})),
            25832);
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 2, 2048, 0, 1, 4326, 3072, 0, 1, 32767})), 4326);
}

TEST(Crs, GeotiffKeysThatSayNothingOrAreBrokenGiveNoCode) {
  EXPECT_EQ(epsg_of_geotiff_keys(""), std::nullopt);
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 0})), std::nullopt);
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 1, 3072, 34736, 1, 25832})), std::nullopt);  // elsewhere
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 2, 3072, 0, 1, 25832})), std::nullopt);      // cut off
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({2, 1, 0, 1, 3072, 0, 1, 25832})), std::nullopt);
  EXPECT_EQ(epsg_of_geotiff_keys(bytes_of({1, 1, 0, 1, 3072, 0, 1})), std::nullopt);
}

TEST(Crs, AWellKnownTextHasTheCodeOfItsOutermostBrackets) {
  EXPECT_EQ(epsg_of_wkt(utm), 25832);
  EXPECT_EQ(epsg_of_wkt(R"(PROJCRS["x",BASEGEOGCRS["y",ID["EPSG",4258]],ID["EPSG",25832]])"), 25832);
  EXPECT_EQ(
      epsg_of_wkt(
          R"(COMPD_CS["z",PROJCS["x",AUTHORITY["EPSG","25832"]],VERT_CS["v",AUTHORITY["EPSG","7837"]]])"),
      std::nullopt);
  EXPECT_EQ(epsg_of_wkt(R"(PROJCS["x",AUTHORITY["ESRI","102100"]])"), std::nullopt);
  EXPECT_EQ(epsg_of_wkt(R"(PROJCS["x",AUTHORITY["EPSG","many"]])"), std::nullopt);
  EXPECT_EQ(epsg_of_wkt(R"(PROJCS["x",AUTHORITY["EPSG")"), std::nullopt);
  EXPECT_EQ(epsg_of_wkt(R"(LOCAL_CS["a,AUTHORITY[\"EPSG\",\"1\"]"])"), std::nullopt);
}

TEST(Crs, OfACloudStandsInItsComments) {
  PointCloud cloud;
  EXPECT_EQ(crs_of(cloud), "");
  cloud.comments = {"made by hand", "crs_wkt LOCAL_CS[\"site\"]"};
  EXPECT_EQ(crs_of(cloud), "LOCAL_CS[\"site\"]");
  cloud.comments.push_back("crs_epsg 25832");
  EXPECT_EQ(crs_of(cloud), "EPSG:25832");
  cloud.comments = {"crs_wkt " + std::string(utm)};
  EXPECT_EQ(crs_of(cloud), "EPSG:25832");
  for (const char* const code : {"twelve", "nan", "-3", "1.5", "1e300", ""}) {
    cloud.comments = {std::string("crs_epsg ") + code};
    EXPECT_EQ(crs_of(cloud), "") << code;
  }
}

}  // namespace
}  // namespace keenline
