// What finding sharp features costs, against finding the neighbours alone: on each cloud and in one run,
// single-threaded, nanoflann's plain pass over all points, keenline's neighbour stage, and neighbours +
// method gauss with the labels of all sensitivities; the textbook clustering on a sample of the points;
// CGAL's Voronoi-covariance edges where CGAL is there; then the same with all threads. Then every other
// method. Medians of the ratios over the rounds.
//
//     speed_bench [ROUNDS [FILE…]]      FILE: a scan, measured as it is

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/detect/gauss.h"
#include "keenline/detect/noise.h"
#include "keenline/detect/registry.h"
#include "keenline/evaluate/evaluate.h"
#include "keenline/io/read.h"
#include "keenline/kernels/target.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"
#include "keenline/pipeline.h"
#include "keenline/synth/synth.h"

#include "nanoflann_pass.h"
#include "stop_watch.h"
#include "support/textbook_gauss.h"
#ifdef KEENLINE_BENCH_CGAL
#include "cgal_edges.h"
#endif

namespace {

using namespace keenline;

constexpr int neighbors = 16;

struct Subject {
  std::string name;
  PointCloud cloud;
  bool has_truth;
};

Subject synthetic(const std::string& shape, std::uint64_t points, double noise_h) {
  SynthOptions options;
  options.shape = shape;
  options.points = points;
  options.noise.amount = noise_h;
  return {fmt::format("{} {}", shape, noise_h > 0 ? fmt::format("noise {} h", noise_h) : "clean"),
          synthesize(options).cloud, true};
}

/// As `keenline detect --spectrum --smooth no` has them.
GaussOptions default_options(const PointCloud& cloud, double noise) {
  const Method& gauss = find_method("gauss");
  OptionValues values = resolve_options(gauss, {{"spectrum", 1.0}});
  gauss.adapt(values, noise, cloud.size());
  return gauss_options_from(values);
}

struct Round {
  double nanoflann_s = 0;
  double neighbors_s = 0;
  double gauss_s = 0;     // neighbours and labels
  double textbook_s = 0;  // of all points, from a sample
  double cgal_s = 0;
  double speedup = 0;
};

double textbook_s(const PointCloud& cloud, const Neighborhoods& table) {
  constexpr std::size_t sample = 200;
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / sample);
  std::size_t looked_at = 0;
  int clusters = 0;
  const double seconds = bench::processor_s([&] {
    for (std::size_t i = 0; i < cloud.size(); i += step, ++looked_at)
      clusters += test::textbook_gauss(cloud, i, table.of(i), 20, 4, 0.001).clusters;
  });
  return clusters < 0 ? 0 : seconds * static_cast<double>(cloud.size()) / static_cast<double>(looked_at);
}

Round measure(Subject& subject, const GaussOptions& options, bool with_rivals) {
  const PointCloud& cloud = subject.cloud;
  Round round;
  Neighborhoods table;
  FeatureLabels labels;
  const auto detect = [&] {
    const NeighborSearch search(cloud.positions);
    labels = detect_gauss(cloud, search, options);
  };
  double one_thread_s = 0;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    round.nanoflann_s = bench::processor_s([&] { (void)bench::nanoflann_pass(cloud, neighbors); });
    round.neighbors_s = bench::processor_s([&] { table = find_neighborhoods(cloud, neighbors); });
    one_thread_s = bench::wall_s([&] { round.gauss_s = bench::processor_s(detect); });
    if (with_rivals) {
      table = find_neighborhoods(cloud, options.neighbors);
      round.textbook_s = textbook_s(cloud, table);
#ifdef KEENLINE_BENCH_CGAL
      round.cgal_s = bench::processor_s([&] { (void)bench::cgal_edges(cloud); });
#endif
    }
  }
  round.speedup = one_thread_s / bench::wall_s(detect);
  (void)add_labels(subject.cloud, labels);
  return round;
}

double median_of(const std::vector<Round>& rounds, const std::function<double(const Round&)>& value) {
  std::vector<double> values;
  for (const Round& round : rounds) values.push_back(value(round));
  return bench::median(values);
}

void report(Subject subject, int rounds_wanted, bool with_rivals) {
  const double noise = estimate_noise(subject.cloud, NeighborSearch(subject.cloud.positions));
  const GaussOptions options = default_options(subject.cloud, noise);
  std::vector<Round> rounds;
  for (int i = 0; i < rounds_wanted; ++i) rounds.push_back(measure(subject, options, with_rivals));
  const double ns = 1e9 / static_cast<double>(subject.cloud.size());
  const auto optional = [](double value, int digits) {
    return value > 0 ? fmt::format("{:.{}f}", value, digits) : std::string("-");
  };
  fmt::print("{:<24} {:>9} {:>3} {:>9.0f} {:>9.0f} {:>9.0f} {:>8.2f} {:>9} {:>7} {:>8.2f} {:>6}\n",
             subject.name, subject.cloud.size(), options.neighbors,
             median_of(rounds, [](const Round& r) { return r.nanoflann_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.neighbors_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.gauss_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.gauss_s / r.nanoflann_s; }),
             optional(median_of(rounds, [](const Round& r) { return r.textbook_s / r.gauss_s; }), 0),
             optional(median_of(rounds, [](const Round& r) { return r.cgal_s / r.gauss_s; }), 1),
             median_of(rounds, [](const Round& r) { return r.speedup; }),
             subject.has_truth ? fmt::format("{:.3f}", f1(compare(subject.cloud, subject.cloud)))
                               : std::string("-"));
  std::fflush(stdout);
}

/// Every method of the registry with its defaults, neighbours included, on one thread.
void report_methods(Subject subject, int rounds) {
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const PointCloud& cloud = subject.cloud;
  const double noise = estimate_noise(cloud, NeighborSearch(cloud.positions));
  for (const Method& method : methods()) {
    std::vector<double> seconds;
    std::vector<double> ratios;
    FeatureLabels labels;
    for (int i = 0; i < rounds; ++i) {
      OptionValues values = resolve_options(method, {});
      method.adapt(values, noise, cloud.size());
      const double nanoflann_s = bench::processor_s([&] { (void)bench::nanoflann_pass(cloud, neighbors); });
      seconds.push_back(bench::processor_s([&] {
        const NeighborSearch search(cloud.positions);
        labels = method.detect(cloud, search, values, no_progress());
      }));
      ratios.push_back(seconds.back() / nanoflann_s);
    }
    (void)add_labels(subject.cloud, labels);
    fmt::print("{:<24} {:>9} {:<14} {:>9.0f} {:>8.2f} {:>6.3f}\n", subject.name, cloud.size(), method.name,
               bench::median(seconds) * 1e9 / static_cast<double>(cloud.size()), bench::median(ratios),
               f1(compare(subject.cloud, subject.cloud)));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = std::max(1, argc > 1 ? std::atoi(argv[1]) : 3);
  fmt::print("kernels: {}\n", kernels::target());
  fmt::print("{:<24} {:>9} {:>3} {:>9} {:>9} {:>9} {:>8} {:>9} {:>7} {:>8} {:>6}\n", "cloud", "points", "k",
             "nanoflann", "neighbors", "gauss", "gauss /", "textbook", "CGAL /", "threads", "F1");
  fmt::print("{:<24} {:>9} {:>3} {:>9} {:>9} {:>9} {:>8} {:>9} {:>7} {:>8} {:>6}\n", "", "", "", "ns/point",
             "ns/point", "ns/point", "nanofl.", "/ gauss", "gauss", "speedup", "");
  for (const std::uint64_t points : {100'000U, 1'000'000U, 3'000'000U}) {
    const bool with_rivals = points == 100'000;
    const int repeats = points > 1'000'000 ? 1 : rounds;
    report(synthetic("fandisk", points, 0), repeats, with_rivals);
    report(synthetic("cube", points, 0), repeats, with_rivals);
    report(synthetic("fandisk", points, 0.1), repeats, with_rivals);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string path = argv[i];
    report({path.substr(path.rfind('/') + 1), read_cloud(path).cloud, false}, rounds, true);
  }
  fmt::print("\n{:<24} {:>9} {:<14} {:>9} {:>8} {:>6}\n{:<24} {:>9} {:<14} {:>9} {:>8} {:>6}\n", "cloud",
             "points", "method", "with", "/ nano-", "F1", "", "", "", "neighbors", "flann", "");
  report_methods(synthetic("fandisk", 100'000, 0), rounds);
  report_methods(synthetic("fandisk", 100'000, 0.1), rounds);
}
