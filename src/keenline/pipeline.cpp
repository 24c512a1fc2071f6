#include "keenline/pipeline.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <unistd.h>

#include <fmt/format.h>

#include "keenline/detect/noise.h"
#include "keenline/detect/relabel.h"
#include "keenline/detect/spectrum_attributes.h"
#include "keenline/errors.h"
#include "keenline/io/crs.h"
#include "keenline/io/graph_files.h"
#include "keenline/io/output_file.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"
#include "keenline/lines/fit.h"
#include "keenline/lines/resample.h"
#include "keenline/lines/sides.h"
#include "keenline/lines/smooth.h"
#include "keenline/lines/snap.h"
#include "keenline/lines/tracers.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/smooth.h"
#include "keenline/neighborhood/spacing.h"

namespace keenline {
namespace {

class StopWatch {
 public:
  /// Seconds since the last lap.
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return elapsed;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Found out now, not after an hour of work.
void require_writable_folder(const std::string& output) {
  const std::size_t slash = output.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : output.substr(0, slash + 1);
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(output, "cannot be written: " + system_message(errno));
}

/// Smoothing where it is due, and detection. \pre report.options holds every option of the method
void detect_in(const PointCloud& cloud, const NeighborSearch& search, const Method& method,
               Smoothing smoothing, DetectReport& report, Progress& progress) {
  StopWatch stage;
  report.spacing = estimate_spacing(cloud, search);
  report.noise = estimate_noise(cloud, search, progress);
  method.adapt(report.options, report.noise, count_finite(cloud));
  report.times.neighborhoods_s += stage.lap_s();
  report.smoothed =
      !method.is_plain(report.options) &&
      (smoothing == Smoothing::Yes || (smoothing == Smoothing::Auto && report.noise > noise_worth_smoothing));
  if (!report.smoothed) {
    report.labels = method.detect(cloud, search, report.options, progress);
    report.times.detect_s = stage.lap_s();
    return;
  }
  const SmoothOptions options;
  PointCloud smooth;  // positions only
  progress.begin("neighborhoods", cloud.size());
  smooth.positions = smooth_positions(cloud, search.all(options.neighbors, progress), options, progress);
  const NeighborSearch smooth_search(smooth.positions, progress);
  report.times.smooth_s = stage.lap_s();
  report.labels = method.detect(smooth, smooth_search, report.options, progress);
  report.times.detect_s = stage.lap_s();
}

void require_usable_output(const std::string& input, const std::string& output) {
  require_writable_extension(output);
  require_different_files(input, output);
  require_writable_folder(output);
}

void require_usable_drawings(const std::string& input, const std::vector<std::string>& outputs) {
  if (outputs.empty())
    throw InvalidArgument(
        fmt::format("output: found none, expected a name that ends in {}", graph_extensions()));
  for (const std::string& output : outputs) {
    (void)find_graph_format(output);
    require_different_files(input, output);
    require_writable_folder(output);
  }
  require_distinct_outputs(outputs);
}

void require_not_negative(std::string_view name, double value) {
  if (!(value >= 0 && value <= largest_graph_number))
    throw InvalidArgument(fmt::format("--{}: found {}, expected 0 or more spacings", name, value));
}

/// Methods that have a spectrum to keep call the option so.
bool keeps_spectrum(const OptionValues& options) {
  const auto found = options.find("spectrum");
  return found != options.end() && found->second == 1.0;
}

void require_room_for_spectrum(const std::string& output) {
  if (!holds_lists(output))
    throw InvalidArgument(fmt::format("--spectrum: {} cannot hold it, expected an output that ends in .ply",
                                      quoted(output, 4096)));
}

/// A spectrum that is missing or wrong is the file's fault, not the caller's.
LabelSpectrum spectrum_in(const std::string& file, const PointCloud& cloud) {
  try {
    return spectrum_of(cloud);
  } catch (const InvalidArgument& e) {
    throw InputError(file, e.what());
  }
}

template <typename Report>
void take_over(const Reading& reading, Report& report) {
  report.format = reading.format;
  report.encoding = reading.encoding;
  report.points = reading.cloud.size();
  report.finite_points = count_finite(reading.cloud);
  report.notes.insert(report.notes.begin(), reading.notes.begin(), reading.notes.end());
}

/// Completes the report once all is written. The arguments must live until then.
template <typename Report>
BeforeCommit completing(Report& report, StopWatch& stage, StopWatch& total,
                        const std::function<void(const Report&)>& before_commit) {
  return [&](const std::vector<std::string>& writing_notes) {
    report.notes.insert(report.notes.end(), writing_notes.begin(), writing_notes.end());
    report.times.write_s = stage.lap_s();
    report.times.total_s = total.lap_s();
    if (before_commit) before_commit(report);
  };
}

FeatureGraph lines_of(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                      double spacing, const LinesJob& job, Progress& progress) {
  if (!(spacing > 0)) return {};  // no surface, no lines
  FeatureGraph graph = find_tracer(job.trace).trace(cloud, search, labels, spacing, progress);
  if (job.snap) graph = snap_lines(graph, cloud, search, spacing, {}, progress);
  else if (job.smooth_lines) graph = smooth_lines(graph);
  if (job.resample_spacings > 0) graph = resample_lines(graph, job.resample_spacings * spacing, progress);
  if (job.fit_spacings > 0) graph = fit_lines(graph, job.fit_spacings * spacing, progress);
  // Snapping has looked at the sides already.
  if (!job.snap) measure_sides(graph, cloud, search, spacing, progress);
  return graph;
}

/// The number in every row; nothing for lists.
std::optional<std::vector<double>> numbers_in(const Column* column) {
  if (column == nullptr || column->is_list()) return std::nullopt;
  std::vector<double> numbers(column->rows());
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = column->value(i);
  return numbers;
}

}  // namespace

DetectReport run_detect(const DetectJob& job, Progress& progress,
                        const std::function<void(const DetectReport&)>& before_commit) {
  const Method& method = find_method(job.method);
  DetectReport report;
  report.options = resolve_options(method, job.options);
  require_usable_output(job.input, job.output);
  if (keeps_spectrum(report.options)) require_room_for_spectrum(job.output);

  StopWatch total;
  StopWatch stage;
  Reading reading = read_cloud(job.input, progress);
  report.times.read_s = stage.lap_s();
  {
    progress.begin("neighborhoods", 0);
    const NeighborSearch search(reading.cloud.positions, progress);
    report.times.neighborhoods_s = stage.lap_s();
    detect_in(reading.cloud, search, method, job.smoothing, report, progress);
    (void)stage.lap_s();
  }
  const std::vector<std::string> replaced = add_labels(reading.cloud, report.labels);
  take_over(reading, report);
  for (const std::string& name : replaced)
    report.notes.push_back(fmt::format("the input's attribute {} is replaced", quoted(name)));
  // It would answer a relabelling with what another run found.
  if (!report.labels.spectrum)
    for (const std::string& name : remove_spectrum(reading.cloud))
      report.notes.push_back(
          fmt::format("the input's attribute {} is left out: it belongs to other labels", quoted(name)));
  write_cloud(job.output, reading.cloud, progress, completing(report, stage, total, before_commit));
  return report;
}

RelabelReport run_relabel(const RelabelJob& job, Progress& progress,
                          const std::function<void(const RelabelReport&)>& before_commit) {
  if (job.sigma_rule == SigmaRule::Given) (void)sensitivity_of(job.sigma_deg);
  require_usable_output(job.input, job.output);

  RelabelReport report;
  StopWatch total;
  StopWatch stage;
  Reading reading = read_cloud(job.input, progress);
  report.times.read_s = stage.lap_s();
  const LabelSpectrum spectrum = spectrum_in(job.input, reading.cloud);
  report.labels = relabel(spectrum, job.sigma_rule, job.sigma_deg, progress);
  (void)add_labels(reading.cloud, report.labels);
  set_sigma_comment(reading.cloud, report.labels.sigma_deg);
  report.times.relabel_s = stage.lap_s();
  take_over(reading, report);
  write_cloud(job.output, reading.cloud, progress, completing(report, stage, total, before_commit));
  return report;
}

LinesReport run_lines(const LinesJob& job, Progress& progress,
                      const std::function<void(const LinesReport&)>& before_commit) {
  LinesReport report;
  DetectReport& detection = report.detection;
  const bool may_use_labels = job.method.empty() && job.options.empty() && job.smoothing == Smoothing::Auto;
  const Method& method = job.method.empty() ? methods().front() : find_method(job.method);
  detection.options = resolve_options(method, job.options);
  (void)find_tracer(job.trace);
  require_usable_drawings(job.input, job.outputs);
  require_not_negative("resample", job.resample_spacings);
  require_not_negative("fit", job.fit_spacings);

  StopWatch total;
  StopWatch stage;
  const Reading reading = read_cloud(job.input, progress);
  detection.times.read_s = stage.lap_s();
  const PointCloud& cloud = reading.cloud;
  progress.begin("neighborhoods", 0);
  const NeighborSearch search(cloud.positions, progress);
  detection.times.neighborhoods_s = stage.lap_s();
  std::optional<FeatureLabels> own;
  if (may_use_labels) own = labels_of(cloud);
  if (own) {
    detection.options.clear();
    detection.labels = std::move(*own);
    detection.spacing = estimate_spacing(cloud, search);
    detection.notes.push_back("the labels of the input are used; --method labels it anew");
  } else {
    report.method = method.name;
    detect_in(cloud, search, method, job.smoothing, detection, progress);
  }
  (void)stage.lap_s();
  report.graph = lines_of(cloud, search, detection.labels, detection.spacing, job, progress);
  detection.times.lines_s = stage.lap_s();
  report.graph.crs = crs_of(cloud);
  take_over(reading, detection);
  write_graph(job.outputs, report.graph, progress, [&] {
    detection.times.write_s = stage.lap_s();
    detection.times.total_s = total.lap_s();
    if (before_commit) before_commit(report);
  });
  return report;
}

std::vector<std::string> add_labels(PointCloud& cloud, const FeatureLabels& labels) {
  std::vector<std::uint8_t> feature;
  std::vector<std::uint8_t> kind;
  feature.reserve(labels.size());
  kind.reserve(labels.size());
  for (const Kind k : labels.kind) {
    feature.push_back(is_feature(k) ? 1 : 0);
    kind.push_back(static_cast<std::uint8_t>(k));
  }
  std::vector<std::string> replaced;
  const auto add = [&](Column column) {
    if (cloud.attribute(column.name()) != nullptr) replaced.push_back(column.name());
    cloud.set_attribute(std::move(column));
  };
  add(Column("feature", feature));
  add(Column("kind", kind));
  if (!labels.score.empty() || labels.size() == 0) add(Column("score", labels.score));
  if (!labels.clusters.empty() || labels.size() == 0) add(Column("clusters", labels.clusters));
  if (labels.spectrum) {
    for (Column& column : spectrum_columns(*labels.spectrum)) add(std::move(column));
    set_sigma_comment(cloud, labels.sigma_deg);
  }
  return replaced;
}

std::optional<FeatureLabels> labels_of(const PointCloud& cloud) {
  FeatureLabels labels;
  if (const auto kinds = numbers_in(cloud.attribute("kind"))) {
    for (const double number : *kinds) {
      const auto kind = std::find_if(all_kinds.begin(), all_kinds.end(),
                                     [&](Kind k) { return static_cast<double>(k) == number; });
      if (kind == all_kinds.end()) return std::nullopt;
      labels.kind.push_back(*kind);
    }
  } else if (const auto features = numbers_in(cloud.attribute("feature"))) {
    for (const double number : *features)
      labels.kind.push_back(number != 0 && !std::isnan(number) ? Kind::Edge : Kind::Flat);
  } else {
    return std::nullopt;
  }
  if (const auto scores = numbers_in(cloud.attribute("score"))) {
    for (const double score : *scores)
      labels.score.push_back(std::isnan(score) ? 0.0F : static_cast<float>(score));
  } else {
    labels.score.assign(labels.size(), 1.0F);
  }
  return labels;
}

}  // namespace keenline
