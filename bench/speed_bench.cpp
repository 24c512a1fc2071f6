// What finding sharp features costs, against finding the neighbours alone: on each cloud and in one run,
// single-threaded, nanoflann's plain pass over all points, keenline's neighbour stage, and neighbours +
// method gauss with the labels of all sensitivities; the paper's method word for word on a sample of the
// points; then the same with all threads. Then every other method, and the rivals that this machine has.
// Medians of the ratios over the rounds.
//
//     speed_bench [ROUNDS [FILE…]]      FILE: a scan, measured as it is

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
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
#include "rivals.h"
#include "stop_watch.h"
#include "support/textbook_gauss.h"

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
  double speedup = 0;
};

/// The paper's method: all triangles of 16 neighbours, one sensitivity.
double textbook_s(const PointCloud& cloud) {
  constexpr std::size_t sample = 200;
  const Neighborhoods table = find_neighborhoods(cloud, neighbors);
  const std::size_t step = std::max<std::size_t>(1, cloud.size() / sample);
  std::size_t looked_at = 0;
  int clusters = 0;
  const double seconds = bench::processor_s([&] {
    for (std::size_t i = 0; i < cloud.size(); i += step, ++looked_at)
      clusters += test::textbook_gauss(cloud, i, table.of(i), {}).clusters;
  });
  return clusters < 0 ? 0 : seconds * static_cast<double>(cloud.size()) / static_cast<double>(looked_at);
}

Round measure(Subject& subject, const GaussOptions& options, bool with_textbook) {
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
    if (with_textbook) {
      round.textbook_s = textbook_s(cloud);
    }
  }
  round.speedup = one_thread_s / bench::wall_s(detect);
  (void)add_labels(subject.cloud, labels);
  return round;
}

std::string f1_of(const Subject& subject) {
  return subject.has_truth ? fmt::format("{:.3f}", f1(compare(subject.cloud, subject.cloud))) : "-";
}

double median_of(const std::vector<Round>& rounds, const std::function<double(const Round&)>& value) {
  std::vector<double> values;
  for (const Round& round : rounds) values.push_back(value(round));
  return bench::median(values);
}

enum class Lines { OfDefault, OfPaper };

/// With the options that follow the cloud's noise, or with the paper's lines: all triangles of 16 neighbours.
void report(Subject subject, int rounds_wanted, bool with_textbook, Lines lines = Lines::OfDefault) {
  const double noise = estimate_noise(subject.cloud, NeighborSearch(subject.cloud.positions));
  GaussOptions options = default_options(subject.cloud, noise);
  if (lines == Lines::OfPaper) {
    options.neighbors = neighbors;
    options.triangles.reset();
  }
  std::vector<Round> rounds;
  for (int i = 0; i < rounds_wanted; ++i) rounds.push_back(measure(subject, options, with_textbook));
  const double ns = 1e9 / static_cast<double>(subject.cloud.size());
  const double textbook = median_of(rounds, [](const Round& r) { return r.textbook_s / r.gauss_s; });
  const int triangles = options.triangles.value_or(options.neighbors * (options.neighbors - 1) / 2);
  fmt::print("{:<24} {:>9} {:>3} {:>5} {:>9.0f} {:>9.0f} {:>9.0f} {:>8.2f} {:>9} {:>8.2f} {:>6}\n",
             subject.name, subject.cloud.size(), options.neighbors, triangles,
             median_of(rounds, [](const Round& r) { return r.nanoflann_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.neighbors_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.gauss_s; }) * ns,
             median_of(rounds, [](const Round& r) { return r.gauss_s / r.nanoflann_s; }),
             textbook > 0 ? fmt::format("{:.0f}", textbook) : "-",
             median_of(rounds, [](const Round& r) { return r.speedup; }), f1_of(subject));
  std::fflush(stdout);
}

/// Every method of the registry with its defaults, then the rivals; neighbours included, on one thread.
void report_methods(Subject subject, int rounds) {
  const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
  const PointCloud& cloud = subject.cloud;
  const double noise = estimate_noise(cloud, NeighborSearch(cloud.positions));
  const auto run = [&](const Method& method, FeatureLabels& labels) {
    OptionValues values = resolve_options(method, {});
    method.adapt(values, noise, cloud.size());
    const NeighborSearch search(cloud.positions);
    labels = method.detect(cloud, search, values, no_progress());
  };
  const auto row = [&](const std::string& name, const std::function<void(FeatureLabels & labels)>& detect) {
    std::vector<double> seconds;
    std::vector<double> to_nanoflann;
    std::vector<double> to_gauss;
    FeatureLabels labels;
    FeatureLabels unused;
    for (int i = 0; i < rounds; ++i) {
      seconds.push_back(bench::processor_s([&] { detect(labels); }));
      to_nanoflann.push_back(seconds.back() /
                             bench::processor_s([&] { (void)bench::nanoflann_pass(cloud, neighbors); }));
      to_gauss.push_back(seconds.back() / bench::processor_s([&] { run(find_method("gauss"), unused); }));
    }
    (void)add_labels(subject.cloud, labels);
    fmt::print("{:<24} {:>9} {:<15} {:>9.0f} {:>9.2f} {:>8.2f} {:>6}\n", subject.name, cloud.size(), name,
               bench::median(seconds) * 1e9 / static_cast<double>(cloud.size()), bench::median(to_nanoflann),
               bench::median(to_gauss), f1_of(subject));
    std::fflush(stdout);
  };
  for (const Method& method : methods())
    row(std::string(method.name), [&](FeatureLabels& labels) { run(method, labels); });
  for (const bench::Rival& rival : bench::rivals())
    row(rival.name, [&](FeatureLabels& labels) {
      labels = {};
      for (const bool sharp : rival.sharp_points(cloud))
        labels.kind.push_back(sharp ? Kind::Edge : Kind::Flat);
      labels.score.assign(labels.kind.size(), 0);
    });
}

}  // namespace

int main(int argc, char** argv) {
  const int rounds = std::max(1, argc > 1 ? std::atoi(argv[1]) : 3);
  fmt::print("kernels: {}\n", kernels::target());
  fmt::print("{:<24} {:>9} {:>3} {:>5} {:>9} {:>9} {:>9} {:>8} {:>9} {:>8} {:>6}\n", "cloud", "points", "k",
             "lines", "nanoflann", "neighbors", "gauss", "gauss /", "textbook", "threads", "F1");
  fmt::print("{:<24} {:>9} {:>3} {:>5} {:>9} {:>9} {:>9} {:>8} {:>9} {:>8} {:>6}\n", "", "", "", "",
             "ns/point", "ns/point", "ns/point", "nanofl.", "/ gauss", "speedup", "");
  for (const std::uint64_t points : {100'000U, 1'000'000U, 3'000'000U}) {
    const bool with_textbook = points == 100'000;
    const int repeats = points > 1'000'000 ? 1 : rounds;
    report(synthetic("fandisk", points, 0), repeats, with_textbook);
    report(synthetic("cube", points, 0), repeats, with_textbook);
    report(synthetic("fandisk", points, 0.1), repeats, with_textbook, Lines::OfPaper);
    report(synthetic("fandisk", points, 0.1), repeats, with_textbook);
  }
  std::vector<Subject> scans;
  for (int i = 2; i < argc; ++i) {
    const std::string path = argv[i];
    scans.push_back({path.substr(path.rfind('/') + 1), read_cloud(path).cloud, false});
    report(scans.back(), rounds, true);
  }
  fmt::print("\n{:<24} {:>9} {:<15} {:>9} {:>9} {:>8} {:>6}\n{:<24} {:>9} {:<15} {:>9} {:>9} {:>8} {:>6}\n",
             "cloud", "points", "method", "ns/point", "/ nano-", "/ gauss", "F1", "", "", "", "", "flann", "",
             "");
  scans.insert(scans.begin(), {synthetic("fandisk", 100'000, 0), synthetic("fandisk", 100'000, 0.1)});
  for (Subject& scan : scans) report_methods(std::move(scan), rounds);
}
