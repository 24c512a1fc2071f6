#include "keenline/synth/scan.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "keenline/synth/shapes.h"

#include "synth/test_shapes.h"

namespace keenline::synth {
namespace {

using test::build;

TEST(Scan, hits_lie_on_the_surface_and_nothing_is_in_front_of_them) {
  for (const ShapeRow& row : shape_rows()) {
    const std::string name(row.shape.name);
    const bool is_open =
        name == "plane" || name == "crease" || name == "vase";  // can be seen from the inside too
    const auto& implicit = test::implicits().at(name);
    const Shape shape = build(name);
    const double diagonal = shape.bounds().diagonal();
    const Scan result = scan(shape, 1000, 5, no_progress());
    for (const Sample& sample : result.samples) {
      ASSERT_NEAR(implicit(sample.position.point()), 0, 1e-12) << name;
      if (is_open) continue;
      const Vec3 towards_station = unit(result.stations[sample.station] - sample.position);
      for (int step = 1; step <= 200; ++step) {
        const Vec3 before = sample.position + 0.005 * step * diagonal * towards_station;
        ASSERT_GT(implicit(before.point()), -1e-9) << name;
      }
    }
  }
}

TEST(Scan, comes_close_to_the_wanted_number_of_points) {
  const auto hits = [](const Shape& shape) {
    return static_cast<double>(scan(shape, 10000, 2, no_progress()).samples.size());
  };
  for (const ShapeRow& row : shape_rows())
    EXPECT_NEAR(hits(build(row.shape.name)), 10000, 500) << row.shape.name;
  EXPECT_NEAR(hits(build("cone", 1)), 10000, 1500);  // a needle, which coarse passes hardly see
}

TEST(Scan, stations_stand_outside_and_all_see_something) {
  const Shape star = build("trim-star");
  const Scan result = scan(star, 3000, 1, no_progress());
  ASSERT_EQ(result.stations.size(), 6U);
  for (const Vec3& station : result.stations)
    EXPECT_NEAR(distance(station, star.bounds().center()), 1.5 * star.bounds().diagonal(), 1e-12);
  std::vector<int> seen(6, 0);
  for (const Sample& sample : result.samples) ++seen[sample.station];
  for (const int count : seen) EXPECT_GT(count, 200);
}

TEST(Scan, the_seed_turns_the_stations) {
  const Shape cube = build("cube");
  const Scan first = scan(cube, 500, 1, no_progress());
  const Scan same = scan(cube, 500, 1, no_progress());
  const Scan other = scan(cube, 500, 2, no_progress());
  EXPECT_GT(distance(first.stations[0], other.stations[0]), 1e-3);
  ASSERT_EQ(first.samples.size(), same.samples.size());
  for (std::size_t i = 0; i < first.samples.size(); ++i)
    ASSERT_EQ(first.samples[i].position.point(), same.samples[i].position.point());
}

TEST(Scan, density_is_anisotropic) {
  // Neighbours along a scan line lie at about half the distance of neighbours across lines.
  const Scan result = scan(build("plane"), 5000, 3, no_progress());
  double along = 0;
  int steps = 0;
  for (std::size_t i = 1; i < result.samples.size(); ++i) {
    const double step = distance(result.samples[i].position, result.samples[i - 1].position);
    if (step > 0.2) continue;  // the next line
    along += step;
    ++steps;
  }
  // Six sparse views of the unit square overlap: 5000 points in about 6 x 833.
  EXPECT_LT(along / steps, 1 / std::sqrt(5000.0 / 6));
}

}  // namespace
}  // namespace keenline::synth
