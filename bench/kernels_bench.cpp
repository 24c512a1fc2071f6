// What one point costs in each kernel, on every instruction set of this CPU: names end in the one that ran.
// Compare within one run: --benchmark_enable_random_interleaving=true --benchmark_repetitions=9
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "keenline/kernels/average_linkage.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/kernels/target.h"
#include "keenline/kernels/triangle_lines.h"
#include "keenline/kernels/triangle_shapes.h"

namespace {

using namespace keenline::kernels;

/// The Gauss map of a point on an edge of 90 degrees, with noise of a tenth of the distance to its
/// neighbours, and room for all that is made of it.
struct Point {
  static constexpr int neighbors = 16;
  static constexpr int more_neighbors = 28;  // of noisy clouds
  static constexpr std::size_t triangles = 378;
  std::array<double, std::size_t{3} * more_neighbors> offsets;
  std::array<double, more_neighbors> lengths;
  std::array<std::uint8_t, triangles + shape_slack> shapes;
  std::array<float, triangles + line_slack> x, y, z;
  int count = 0;

  explicit Point(unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> across(-1, 1);
    std::normal_distribution<double> noise(0, 0.1);
    for (std::size_t i = 0; i < more_neighbors; ++i) {
      const double u = across(generator);
      double* const a = offsets.data() + 3 * i;
      a[0] = (u > 0 ? u : 0) + noise(generator);
      a[1] = across(generator) + noise(generator);
      a[2] = (u > 0 ? 0 : u) + noise(generator);
      lengths[i] = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    }
    find_lines();
  }
  void find_lines() {
    count = triangle_lines(offsets.data(), lengths.data(), neighbors, 0.001, x.data(), y.data(), z.data());
  }
  /// Of the 40 best shaped triangles of more neighbours.
  void find_best_lines() {
    triangle_shapes(offsets.data(), more_neighbors, shapes.data());
    const std::uint8_t least = shape_of_best(shapes.data(), triangles, 40);
    count = triangle_lines(offsets.data(), lengths.data(), more_neighbors, 0.001, shapes.data(), least,
                           x.data(), y.data(), z.data());
  }
  [[nodiscard]] Lines lines() const { return {x.data(), y.data(), z.data(), count}; }
};

/// Many, so that no branch predictor learns them by heart.
std::vector<Point>& points() {
  static std::vector<Point> points = [] {
    std::vector<Point> made;
    for (unsigned seed = 0; seed < 500; ++seed) made.emplace_back(seed);
    return made;
  }();
  return points;
}

struct Dendrogram {
  std::vector<std::uint32_t> sums = std::vector<std::uint32_t>(120 * row_length(120));
  std::vector<Merge> merges = std::vector<Merge>(119);
  LinkageWorkspace workspace;

  void cluster(const Point& point) {
    benchmark::DoNotOptimize(average_linkage(sums.data(), point.count, 1, workspace, merges.data()));
  }
};

void measure_lines(Point& point, Dendrogram& /*unused*/) { point.find_lines(); }

void measure_angles(Point& point, Dendrogram& dendrogram) {
  line_angles(point.lines(), dendrogram.sums.data());
}

void measure_linkage(Point& point, Dendrogram& dendrogram) {
  line_angles(point.lines(), dendrogram.sums.data());  // clustering destroys them
  dendrogram.cluster(point);
}

/// How the cost grows: the first lines of a point only.
template <int count>
void measure_some(Point& point, Dendrogram& dendrogram) {
  Point some = point;
  some.count = std::min(count, point.count);
  measure_linkage(some, dendrogram);
}

void measure_all(Point& point, Dendrogram& dendrogram) {
  point.find_lines();
  measure_linkage(point, dendrogram);
}

void measure_best_lines(Point& point, Dendrogram& /*unused*/) {
  Point some = point;
  some.find_best_lines();
  benchmark::DoNotOptimize(some.count);
}

void measure_best(Point& point, Dendrogram& dendrogram) {
  Point some = point;
  some.find_best_lines();
  measure_linkage(some, dendrogram);
}

void measure_all_within(Point& point, Dendrogram& /*unused*/) {
  benchmark::DoNotOptimize(all_within(point.lines(), 1000));
}

using Measure = void (*)(Point&, Dendrogram&);

void add(const std::string& name, Measure measure) {
  for (const std::string_view target : supported_targets()) {
    benchmark::RegisterBenchmark((name + '/' + std::string(target)).c_str(),
                                 [measure, target](benchmark::State& state) {
                                   use_target(target);
                                   Dendrogram dendrogram;
                                   std::size_t i = 0;
                                   for ([[maybe_unused]] auto _ : state) {
                                     measure(points()[i], dendrogram);
                                     benchmark::ClobberMemory();
                                     i = (i + 1) % points().size();
                                   }
                                 });
  }
}

}  // namespace

int main(int argc, char** argv) {
  add("triangle_lines", measure_lines);
  add("line_angles", measure_angles);
  add("line_angles+average_linkage", measure_linkage);
  add("line_angles+average_linkage of 60 lines", measure_some<60>);
  add("whole_point", measure_all);
  add("triangle_lines of the best 40", measure_best_lines);
  add("whole_point of the best 40", measure_best);
  add("all_within", measure_all_within);
  benchmark::AddCustomContext("best target", std::string(target()));
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
