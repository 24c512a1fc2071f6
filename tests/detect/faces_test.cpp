#include "keenline/detect/faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "keenline/detect/gauss_map.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/progress.h"

namespace keenline {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The faces at the origin among neighbours at `positions`.
std::vector<Face> faces_of(std::vector<Point> positions, double persistence = 3) {
  positions.insert(positions.begin(), {0, 0, 0});
  std::vector<std::uint32_t> neighbors(positions.size() - 1);
  std::iota(neighbors.begin(), neighbors.end(), 1U);
  GaussMap map(0.001, no_progress());
  map.collect(positions, positions[0], neighbors);
  map.cluster();
  FaceWorkspace workspace;
  std::vector<Face> faces;
  find_faces(map, std::max(3, (map.lines().count + 9) / 10), persistence, workspace, faces);
  return faces;
}

/// Points of a half plane that begins at the y axis and rises by `slope` degrees: eight, none on the axis.
void add_half_plane(std::vector<Point>& positions, double slope, double side) {
  for (int i = 0; i < 8; ++i) {
    const double angle = (-78 + 156.0 * i / 7) * degree;
    const double r = 1 + 0.05 * i;
    const double along = r * std::cos(angle);
    positions.push_back(
        {side * along * std::cos(slope * degree), r * std::sin(angle), along * std::sin(slope * degree)});
  }
}

TEST(Faces, APlaneIsOneFaceThatGoesOn) {
  std::vector<Point> positions;
  add_half_plane(positions, 0, 1);
  add_half_plane(positions, 0, -1);
  const auto faces = faces_of(positions);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_FALSE(faces[0].ends);
  EXPECT_FALSE(faces[0].is_half);
  EXPECT_NEAR(std::abs(faces[0].normal[2]), 1, 1e-6);
  EXPECT_TRUE(std::isinf(faces[0].death));
}

TEST(Faces, AHalfPlaneIsOneFaceThatEnds) {
  std::vector<Point> positions;
  add_half_plane(positions, 0, 1);
  const auto faces = faces_of(positions);
  ASSERT_EQ(faces.size(), 1U);
  EXPECT_TRUE(faces[0].ends);
  EXPECT_TRUE(faces[0].is_half);
}

TEST(Faces, EndWhereASectorOf115DegreesIsEmptyWhateverItsDirection) {
  for (const double gap : {60.0, 100.0, 112.0, 114.5, 115.5, 130.0, 159.0, 161.0, 200.0}) {
    for (int turn = 0; turn < 360; turn += 3) {
      std::vector<Point> positions;
      for (int i = 0; i < 16; ++i) {
        const double angle = (turn + (360 - gap) * i / 15) * degree;
        positions.push_back({std::cos(angle), std::sin(angle), 0});
      }
      const auto faces = faces_of(positions);
      ASSERT_EQ(faces.size(), 1U);
      EXPECT_EQ(faces[0].ends, gap > 115) << gap << ' ' << turn;
      EXPECT_EQ(faces[0].is_half, gap > 160) << gap << ' ' << turn;
    }
  }
}

TEST(Faces, AlmostParallelLinesAreOneFaceWithoutClustering) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> place(-1, 1);
  int within = 0;
  int halves = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<Point> positions{{0, 0, 0}};
    const double height = 0.004 * trial / 100;
    const double y = trial % 3 == 0 ? 0 : -1;  // a third of them on a rim
    for (int i = 0; i < 16; ++i)
      positions.push_back({place(random), std::max(y, place(random)), height * place(random)});
    std::vector<std::uint32_t> neighbors(16);
    std::iota(neighbors.begin(), neighbors.end(), 1U);
    GaussMap map(0.3, no_progress());
    map.collect(positions, positions[0], neighbors);
    for (const double persistence : {1.0, 2.0, 3.0}) {
      if (!kernels::all_within(map.lines(), unresolved_angle(persistence) - 2)) continue;
      ++within;
      const bool is_half = lone_face_is_half(map);
      map.cluster();
      FaceWorkspace workspace;
      std::vector<Face> faces;
      find_faces(map, 12, persistence, workspace, faces);
      ASSERT_EQ(faces.size(), 1U);
      EXPECT_EQ(faces[0].is_half, is_half);
      halves += is_half ? 1 : 0;
      for (const kernels::Merge& merge : map.merges()) EXPECT_LT(merge.height, unresolved_angle(persistence));
    }
  }
  EXPECT_GT(within, 100);
  EXPECT_LT(within, 900);
  EXPECT_GT(halves, 30);
  EXPECT_LT(halves, within - 30);
}

class Fold : public testing::TestWithParam<int> {};

TEST_P(Fold, IsTwoFacesThatEnd) {
  const double slope = GetParam() / 2.0;
  std::vector<Point> positions;
  add_half_plane(positions, slope, 1);
  add_half_plane(positions, slope, -1);
  const auto faces = faces_of(positions);
  ASSERT_EQ(faces.size(), 2U);
  for (const Face& face : faces) {
    EXPECT_TRUE(face.ends);
    EXPECT_NEAR(std::abs(face.normal[2]), std::cos(slope * degree), 1e-5);
    EXPECT_LT(face.birth, 0.1 * 728);
  }
  EXPECT_GT(faces[1].death, 0.5 * std::min(GetParam(), 180 - GetParam()) * 728);
  EXPECT_LT(faces[1].death, 90 * 728);
}

INSTANTIATE_TEST_SUITE_P(Angles, Fold, testing::Values(30, 45, 60, 90, 120, 150),
                         [](const auto& test) { return "by" + std::to_string(test.param); });

TEST(Faces, BesideAnEdgeAFaceGoesOn) {
  // The point lies one spacing inside the face z = 0 of a lattice that turns down at x = 1.
  std::vector<Point> positions;
  for (int x = -2; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      if (x != 0 || y != 0) positions.push_back({1.0 * x, 1.0 * y, 0});
  for (int z = 1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y) positions.push_back({1, 1.0 * y, -1.0 * z});
  bool all_end = true;
  for (const Face& face : faces_of(positions)) all_end = all_end && face.ends;
  EXPECT_FALSE(all_end);
}

TEST(Faces, OnTheEdgeOfALatticeAllEnd) {
  std::vector<Point> positions;
  for (int x = -2; x <= 0; ++x)
    for (int y = -1; y <= 1; ++y)
      if (x != 0 || y != 0) positions.push_back({1.0 * x, 1.0 * y, 0});
  for (int z = 1; z <= 2; ++z)
    for (int y = -1; y <= 1; ++y) positions.push_back({0, 1.0 * y, -1.0 * z});
  const auto faces = faces_of(positions);
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_TRUE(faces[0].ends && faces[1].ends);
}

TEST(Faces, OnACapNotAllEnd) {
  // Curved so strongly that its lines gather by chance; but the cap goes on around the point.
  std::vector<Point> positions;
  for (int i = 0; i < 16; ++i) {
    const double angle = i * 137.5 * degree;
    const double r = 0.4 + 0.05 * i;
    positions.push_back({r * std::cos(angle), r * std::sin(angle), -0.15 * r * r});
  }
  const auto faces = faces_of(positions);
  EXPECT_FALSE(std::all_of(faces.begin(), faces.end(), [](const Face& face) { return face.ends; }));
  EXPECT_EQ(faces_of(positions, 90).size(), 1U) << "no split is that persistent";
  EXPECT_GT(faces_of(positions, 1).size(), faces.size()) << "with no persistence asked, any split counts";
}

TEST(Faces, OldestFirstAndSortedByDeath) {
  std::vector<Point> positions;
  for (int i = 0; i < 5; ++i) {
    const double angle = (10 + 70.0 * i / 4) * degree;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    positions.push_back({c, s, 0});
    positions.push_back({0, 1.1 * c, 1.1 * s});
    positions.push_back({1.2 * s, 0, 1.2 * c});
  }
  const auto faces = faces_of(positions, 2);
  ASSERT_GE(faces.size(), 3U);
  EXPECT_TRUE(std::isinf(faces[0].death));
  for (std::size_t i = 1; i < faces.size(); ++i) EXPECT_LE(faces[i].death, faces[i - 1].death);
}

}  // namespace
}  // namespace keenline
