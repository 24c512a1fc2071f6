// All k nearest neighbours of a cloud: nanoflann's plain pass against find_neighborhoods(), in one run on the
// same points, construction included. Prints medians over the rounds.
//
//     neighbors_bench [CLOUD|all [POINTS [NEIGHBORS [ROUNDS]]]]
//
// Single-threaded times are of the processor, so that other work on the machine counts little; the speedup of
// all threads is by the clock on the wall and wants an idle machine.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/synth/synth.h"

#include "nanoflann_pass.h"
#include "stop_watch.h"

namespace {

using namespace keenline;
using bench::median;
using bench::processor_s;
using bench::wall_s;

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

void compare(const std::string& name, std::size_t count, int neighbors, int rounds) {
  const PointCloud cloud = make_cloud(name, count);
  std::uint64_t sum = 0;  // of something from every result
  const auto theirs = [&] { sum += bench::nanoflann_pass(cloud, neighbors).back(); };
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
