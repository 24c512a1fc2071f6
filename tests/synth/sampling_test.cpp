#include "keenline/synth/sampling.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "keenline/kernels/portable_math.h"
#include "keenline/synth/shapes.h"

#include "synth/test_shapes.h"

namespace keenline::synth {
namespace {

using test::build;

double spacing_of(const Shape& shape, double points) { return std::sqrt(shape.area() / points); }

TEST(RandomSampling, is_uniform_over_the_faces_of_a_box) {
  const auto samples = sample_randomly(build("box"), 44000, 3, no_progress());
  ASSERT_EQ(samples.size(), 44000U);
  std::map<std::array<int, 4>, double> cells;  // axis and side of the face, and quarter of it
  for (const Sample& sample : samples) {
    const auto [x, y, z] = sample.position;
    const int axis = std::abs(x) == 1.5 ? 0 : std::abs(y) == 1 ? 1 : 2;
    const std::array<double, 3> p{x, y, z};
    cells[{axis, p[axis] > 0, p[(axis + 1) % 3] > 0, p[(axis + 2) % 3] > 0}] += 1;
  }
  ASSERT_EQ(cells.size(), 24U);
  const std::array<double, 3> face_areas{2, 3, 6};
  double chi_squared = 0;
  for (const auto& [cell, count] : cells) {
    const double expected = 44000 * face_areas[cell[0]] / 4 / 22;
    chi_squared += (count - expected) * (count - expected) / expected;
  }
  EXPECT_LT(chi_squared, 23 + 5 * 6.8);  // 23 degrees of freedom
  EXPECT_GT(chi_squared, 3);             // and not a lattice in disguise
}

TEST(RandomSampling, a_seed_decides_all) {
  const Shape torus = build("torus");
  const auto first = sample_randomly(torus, 100, 1, no_progress());
  const auto more = sample_randomly(torus, 200, 1, no_progress());
  const auto other = sample_randomly(torus, 100, 2, no_progress());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].position.point(), more[i].position.point());
    EXPECT_NE(first[i].position.point(), other[i].position.point());
  }
}

TEST(GridSampling, stays_half_a_spacing_off_edges_borders_and_peaks) {
  for (const ShapeRow& row : shape_rows()) {
    const Shape shape = build(row.shape.name);
    const double h = spacing_of(shape, 3000);
    const auto samples = sample_grid(shape, h, no_progress());
    EXPECT_NEAR(static_cast<double>(samples.size()), 3000, 500) << row.shape.name;
    for (const Sample& sample : samples) {
      ASSERT_GE(distance_to(shape.edges, sample.position), 0.499999 * h) << row.shape.name;
      ASSERT_GE(distance_to(shape.borders, sample.position), 0.499999 * h) << row.shape.name;
      ASSERT_GE(distance_to(shape.peaks, sample.position), 0.499999 * h) << row.shape.name;
    }
  }
}

TEST(GridSampling, covers_a_cube_with_a_full_lattice) {
  const Shape cube = build("cube");
  const auto samples = sample_grid(cube, spacing_of(cube, 600), no_progress());
  EXPECT_EQ(samples.size(), 600U);
}

TEST(GridSampling, neighbours_are_a_spacing_apart) {
  for (const char* name : {"cube", "cylinder", "sphere", "trim-star"}) {
    const Shape shape = build(name);
    const double h = spacing_of(shape, 1000);
    const auto samples = sample_grid(shape, h, no_progress());
    for (std::size_t i = 0; i < samples.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        ASSERT_GT(distance(samples[i].position, samples[j].position), 0.7 * h) << name;
      }
    }
  }
}

TEST(GridSampling, of_too_few_points_may_be_empty) {
  const Shape plane = build("plane");
  EXPECT_EQ(sample_grid(plane, 1, no_progress()).size(), 1U);
  EXPECT_TRUE(sample_grid(plane, 1.1, no_progress()).empty());
}

TEST(MeshSampling, has_every_corner_end_and_peak_exactly_once) {
  for (const ShapeRow& row : shape_rows()) {
    const Shape shape = build(row.shape.name);
    const auto samples = sample_mesh(shape, spacing_of(shape, 2000), no_progress());
    std::map<Point, int> times;
    for (const Sample& sample : samples) ++times[sample.position.point()];
    EXPECT_EQ(times.size(), samples.size()) << row.shape.name;
    for (const auto* wanted : {&shape.corners, &shape.peaks})
      for (const Vec3& p : *wanted) EXPECT_EQ(times.count(p.point()), 1U) << row.shape.name;
  }
}

TEST(MeshSampling, points_on_edges_lie_there_at_most_a_spacing_apart) {
  for (const ShapeRow& row : shape_rows()) {
    const Shape shape = build(row.shape.name);
    const double h = spacing_of(shape, 2000);
    std::vector<Vec3> on_edges;
    for (const Sample& sample : sample_mesh(shape, h, no_progress())) {
      if (sample.on == Sample::On::Edge) {
        EXPECT_LT(distance_to(shape.edges, sample.position), 1e-14) << row.shape.name;
        on_edges.push_back(sample.position);
      }
      if (sample.on == Sample::On::Border) {
        EXPECT_LT(distance_to(shape.borders, sample.position), 1e-14);
      }
    }
    for (const Curve& edge : shape.edges) {
      for (int i = 0; i <= 50; ++i) {
        EXPECT_LE(distance_to(on_edges, edge.at(i / 50.0)), 0.5 * h * (1 + 1e-9)) << row.shape.name;
      }
    }
  }
}

TEST(MeshSampling, cube_with_ten_steps_per_side) {
  const Shape cube = build("cube");
  const auto samples = sample_mesh(cube, spacing_of(cube, 600), no_progress());
  EXPECT_EQ(samples.size(), 600U + 12 * 9 + 8);
}

TEST(Sampling, faces_say_whether_they_are_curved) {
  for (const Sample& sample : sample_grid(build("cylinder"), 0.1, no_progress()))
    EXPECT_EQ(sample.curved, std::abs(sample.position.z) < 1);
}

}  // namespace
}  // namespace keenline::synth
