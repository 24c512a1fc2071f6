// All k nearest neighbours of a cloud: nanoflann's plain pass against find_neighborhoods(), in one run on the
// same points, construction included. Prints medians over the rounds.
//
//     neighbors_bench [CLOUD|all [POINTS [NEIGHBORS [ROUNDS]]]]
//
// Single-threaded times are of the processor, so that other work on the machine counts little; the speedup of
// all threads is by the clock on the wall and wants an idle machine.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nanoflann.hpp>
#include <oneapi/tbb/global_control.h>

#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

namespace {

using namespace keenline;

/// What nanoflann reads: single precision about the first point, in the order of the file.
struct Floats {
  explicit Floats(const PointCloud& cloud) {
    for (const Point& p : cloud.positions)
      for (std::size_t axis = 0; axis < 3; ++axis)
        xyz.push_back(static_cast<float>(p[axis] - cloud.positions[0][axis]));
  }
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return xyz.size() / 3; }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const { return xyz[3 * i + axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  std::vector<float> xyz;
};

/// The table, so that nothing is optimised away.
std::vector<std::uint32_t> nanoflann_pass(const Floats& floats, std::size_t count) {
  using Distance = nanoflann::L2_Simple_Adaptor<float, Floats>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, Floats, 3, std::uint32_t>;
  const Tree tree(3, floats, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const std::size_t points = floats.kdtree_get_point_count();
  const std::size_t width = count + 1;  // each finds itself too
  std::vector<std::uint32_t> table(points * width);
  std::vector<float> distances(width);
  for (std::size_t i = 0; i < points; ++i)
    tree.knnSearch(&floats.xyz[3 * i], width, &table[i * width], distances.data());
  return table;
}

using Place = std::function<Point(std::size_t i)>;

PointCloud placed(std::size_t count, const Place& place) {
  PointCloud cloud;
  for (std::size_t i = 0; i < count; ++i) cloud.positions.push_back(place(i));
  return cloud;
}

PointCloud make_cloud(const std::string& name, std::size_t count) {
  std::mt19937_64 generator(1);
  const auto uniform = [&] { return static_cast<double>(generator() >> 11U) * 0x1p-53; };
  const auto centimetres = [](double metres) { return std::round(metres * 100) * 0.01; };
  if (name == "spot")  // nine tenths of a plane's points in a ten-thousandth of it
    return placed(count, [&](std::size_t i) {
      const double size = i % 10 == 0 ? 1 : 0.01;
      return Point{uniform() * size, uniform() * size, 0};
    });
  if (name == "terrain")
    return placed(count, [&](std::size_t) {
      const double x = uniform() * 1000;
      const double y = uniform() * 1000;
      return Point{centimetres(5e5 + x), centimetres(5e6 + y),
                   centimetres(300 + 3 * std::sin(x / 50) + 0.1 * uniform())};
    });
  if (name == "lattice") {
    const auto side = static_cast<std::size_t>(std::cbrt(static_cast<double>(count)));
    PointCloud cloud = placed(side * side * side, [&](std::size_t i) {
      return Point{static_cast<double>(i % side), static_cast<double>(i / side % side),
                   static_cast<double>(i / side / side)};
    });
    std::shuffle(cloud.positions.begin(), cloud.positions.end(), generator);
    return cloud;
  }
  if (name == "line")
    return placed(count, [&](std::size_t) {
      const double t = uniform();
      return Point{t, 2 * t, 3 * t};
    });
  if (name == "volume")
    return placed(count, [&](std::size_t) { return Point{uniform(), uniform(), uniform()}; });
  if (name == "outlier")
    return placed(count, [&](std::size_t i) {
      return i == count / 2 ? Point{1e12, 0, 0} : Point{uniform(), uniform(), 0};
    });
  SynthOptions options;
  options.shape = name;
  options.points = count;
  return synthesize(options).cloud;
}

double processor_s(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double wall_s(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

void compare(const std::string& name, std::size_t count, int neighbors, int rounds) {
  const PointCloud cloud = make_cloud(name, count);
  const Floats floats(cloud);
  std::uint64_t sum = 0;  // of something from every result
  const auto theirs = [&] { sum += nanoflann_pass(floats, static_cast<std::size_t>(neighbors)).back(); };
  const auto ours = [&] { sum += find_neighborhoods(cloud, neighbors).indices.back(); };
  const auto index = [&] { const NeighborSearch search(cloud.positions); };
  std::vector<double> nanoflann_s;
  std::vector<double> keenline_s;
  std::vector<double> index_s;
  std::vector<double> ratio;
  std::vector<double> speedup;
  for (int round = 0; round < rounds; ++round) {
    double one_thread_s = 0;
    {
      const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
      nanoflann_s.push_back(processor_s(theirs));
      one_thread_s = wall_s([&] { keenline_s.push_back(processor_s(ours)); });
      index_s.push_back(processor_s(index));
    }
    speedup.push_back(one_thread_s / wall_s(ours));
    ratio.push_back(nanoflann_s.back() / keenline_s.back());
  }
  const double per_point_ns = 1e9 / static_cast<double>(cloud.size());
  fmt::print("{:10} {:9} {:4} {:10.0f} {:9.0f} {:9.0f} {:7.2f} {:8.2f}{}\n", name, cloud.size(), neighbors,
             median(nanoflann_s) * per_point_ns, median(keenline_s) * per_point_ns,
             median(index_s) * per_point_ns, median(ratio), median(speedup), sum == 0 ? " " : "");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string cloud = argc > 1 ? argv[1] : "all";
  const auto count = static_cast<std::size_t>(argc > 2 ? std::atof(argv[2]) : 1e5);
  const int neighbors = argc > 3 ? std::atoi(argv[3]) : 16;
  const int rounds = std::max(1, argc > 4 ? std::atoi(argv[4]) : 3);
  fmt::print("{:10} {:>9} {:>4} {:>10} {:>9} {:>9} {:>7} {:>8}\n", "cloud", "points", "k", "nanoflann",
             "keenline", "(index)", "ratio", "threads");
  fmt::print("{:10} {:>9} {:>4} {:>10} {:>9} {:>9} {:>7} {:>8}\n", "", "", "", "ns/point", "ns/point",
             "ns/point", "one", "speedup");
  const std::vector<std::string> all{"cube",   "fandisk", "terrain", "spot",
                                     "volume", "lattice", "line",    "outlier"};
  for (const std::string& name : cloud == "all" ? all : std::vector<std::string>{cloud})
    compare(name, count, neighbors, rounds);
}
