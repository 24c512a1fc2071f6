#include "keenline/pipeline.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <list>
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
#include "keenline/lines/join_lines.h"
#include "keenline/lines/resample.h"
#include "keenline/lines/sides.h"
#include "keenline/lines/smooth.h"
#include "keenline/lines/snap.h"
#include "keenline/lines/straighten.h"
#include "keenline/lines/tracers.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/smooth.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/report/picture.h"
#include "keenline/report/png.h"
#include "keenline/report/report_data.h"
#include "keenline/report/report_page.h"

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

/// Smoothing where it is due, and detection; returns the smoothed positions, or none.
/// \pre report.options holds every option of the method
std::vector<Point> detect_in(const PointCloud& cloud, const NeighborSearch& search, const Method& method,
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
    return {};
  }
  const SmoothOptions options;
  PointCloud smooth;  // positions only
  progress.begin("neighborhoods", cloud.size());
  smooth.positions = smooth_positions(cloud, search.all(options.neighbors, progress), options, progress);
  const NeighborSearch smooth_search(smooth.positions, progress);
  report.times.smooth_s = stage.lap_s();
  report.labels = method.detect(smooth, smooth_search, report.options, progress);
  report.times.detect_s = stage.lap_s();
  return std::move(smooth.positions);
}

void require_usable_output(const std::string& input, const std::string& output) {
  require_different_files(input, output);
  require_writable_folder(output);
}

void require_something_to_write(bool has_output, std::string_view extensions, const Views& views) {
  if (!has_output && views.empty())
    throw InvalidArgument(fmt::format(
        "--output: found none, expected a name that ends in {}, or --report or --picture", extensions));
}

/// `outputs` have names that can be written. \throw InvalidArgument, OutputError
void require_usable_outputs(const std::string& input, std::vector<std::string> outputs, const Views& views) {
  if (!views.report.empty()) {
    require_writable_report(views.report);
    outputs.push_back(views.report);
  }
  if (!views.picture.empty()) {
    require_png_extension(views.picture);
    outputs.push_back(views.picture);
  }
  for (const std::string& output : outputs) require_usable_output(input, output);
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

/// A report can be asked about other sensitivities, whether or not the result can. Returns whether the
/// spectrum is there for the report alone.
bool add_spectrum_for(const Views& views, OptionValues& options) {
  const auto found = options.find("spectrum");
  if (views.report.empty() || found == options.end() || found->second == 1.0) return false;
  found->second = 1.0;
  return true;
}

void drop_spectrum(DetectReport& report) {
  report.labels.spectrum.reset();
  report.options["spectrum"] = 0.0;
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

/// Completes the report once all but the views is written. The arguments must live until then.
template <typename Report>
BeforeCommit completing(Report& report, StopWatch& stage, StopWatch& total,
                        const std::function<void(const Report&)>& before_commit,
                        const std::function<void()>& write_views = {}) {
  return [&report, &stage, &total, &before_commit, write_views](const std::vector<std::string>& notes) {
    report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    if (write_views) write_views();
    report.times.write_s = stage.lap_s();
    report.times.total_s = total.lap_s();
    if (before_commit) before_commit(report);
  };
}

/// "given", "auto", "local": who chose the sensitivity; nothing for a method without one.
std::string_view sigma_rule_of(const Method& method, const OptionValues& given) {
  const bool has_sigma = std::any_of(method.options.begin(), method.options.end(),
                                     [](const OptionInfo& option) { return option.name == "sigma"; });
  if (!has_sigma) return {};
  const auto found = given.find("sigma");
  if (found == given.end() || !found->second) return "auto";
  return *found->second > 0 ? "given" : "local";
}

/// What a report tells of a run. `method` may be nullptr.
ReportFacts facts_of(const std::string& input, const DetectReport& report, const Method* method,
                     const OptionValues& given) {
  ReportFacts facts;
  facts.command = "detect";
  facts.input = input;
  facts.format = report.format;
  facts.encoding = report.encoding;
  facts.points = report.points;
  facts.finite_points = report.finite_points;
  facts.method = method;
  facts.options = report.options;
  facts.spacing = report.spacing;
  facts.noise = report.noise;
  facts.smoothed = report.smoothed;
  facts.sigma_deg = report.labels.sigma_deg;
  if (method != nullptr) facts.sigma_rule = sigma_rule_of(*method, given);
  facts.times_s = {{"read", report.times.read_s},
                   {"neighborhoods", report.times.neighborhoods_s},
                   {"smooth", report.times.smooth_s},
                   {"detect", report.times.detect_s}};
  facts.notes = report.notes;
  return facts;
}

/// Views beside their targets, until the result is there too.
class ViewFiles {
 public:
  explicit ViewFiles(const Views& views) : views_(views) {}

  /// Before anything is added to the cloud. `seen` as in report_data(). Returns notes.
  std::vector<std::string> collect(const PointCloud& cloud, const FeatureLabels& labels,
                                   const std::vector<Point>& seen, Progress& progress) {
    if (views_.report.empty()) return {};
    progress.begin("report", 0);
    ReportDataOptions options;
    options.max_points = views_.report_points;
    data_ = report_data(cloud, labels, seen, options, progress);
    return std::move(data_.notes);
  }
  void write(const ReportFacts& facts, const PointCloud& cloud, const FeatureGraph* lines,
             Progress& progress) {
    if (!views_.report.empty()) {
      OutputFile& file = files_.emplace_back(views_.report);
      write_report(report_page(), facts, data_, lines, file, progress);
      file.store();
    }
    if (!views_.picture.empty()) {
      PictureOptions options;
      options.lines = lines;
      OutputFile& file = files_.emplace_back(views_.picture);
      file.write(png_bytes(draw_cloud(cloud, options, progress), progress));
      file.store();
    }
  }
  void commit() {
    for (OutputFile& file : files_) file.commit();
  }

 private:
  const Views& views_;
  ReportData data_;
  std::list<OutputFile> files_;
};

FeatureGraph lines_of(const PointCloud& cloud, const NeighborSearch& search, const FeatureLabels& labels,
                      double spacing, const LinesJob& job, Progress& progress) {
  if (!(spacing > 0)) return {};  // no surface, no lines
  FeatureGraph graph = find_tracer(job.trace).trace(cloud, search, labels, spacing, progress);
  if (job.snap) {
    graph = straighten_lines(snap_lines(graph, cloud, search, spacing, {}, progress), spacing);
    graph = straighten_lines(join_lines(graph, spacing), spacing);  // halves agree when both are straight
  } else if (job.smooth_lines) {
    graph = smooth_lines(graph);
  }
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
  require_something_to_write(!job.output.empty(), ".ply or .csv", job.views);
  if (!job.output.empty()) {
    require_writable_extension(job.output);
    if (keeps_spectrum(report.options)) require_room_for_spectrum(job.output);
  }
  require_usable_outputs(job.input, job.output.empty() ? std::vector<std::string>{} : std::vector{job.output},
                         job.views);
  const bool spectrum_is_for_views = add_spectrum_for(job.views, report.options);

  StopWatch total;
  StopWatch stage;
  ViewFiles views(job.views);
  Reading reading = read_cloud(job.input, progress);
  report.times.read_s = stage.lap_s();
  {
    progress.begin("neighborhoods", 0);
    const NeighborSearch search(reading.cloud.positions, progress);
    report.times.neighborhoods_s = stage.lap_s();
    const std::vector<Point> seen = detect_in(reading.cloud, search, method, job.smoothing, report, progress);
    (void)stage.lap_s();
    report.notes = views.collect(reading.cloud, report.labels, seen, progress);
  }
  if (spectrum_is_for_views) drop_spectrum(report);
  const std::vector<std::string> replaced = add_labels(reading.cloud, report.labels);
  take_over(reading, report);
  for (const std::string& name : replaced)
    report.notes.push_back(fmt::format("the input's attribute {} is replaced", quoted(name)));
  // It would answer a relabelling with what another run found.
  if (!report.labels.spectrum)
    for (const std::string& name : remove_spectrum(reading.cloud))
      report.notes.push_back(
          fmt::format("the input's attribute {} is left out: it belongs to other labels", quoted(name)));
  const BeforeCommit complete = completing<DetectReport>(report, stage, total, before_commit, [&] {
    views.write(facts_of(job.input, report, &method, job.options), reading.cloud, nullptr, progress);
  });
  if (job.output.empty()) complete({});
  else (void)write_cloud(job.output, reading.cloud, progress, complete);
  views.commit();
  return report;
}

RelabelReport run_relabel(const RelabelJob& job, Progress& progress,
                          const std::function<void(const RelabelReport&)>& before_commit) {
  if (job.sigma_rule == SigmaRule::Given) (void)sensitivity_of(job.sigma_deg);
  require_writable_extension(job.output);
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
  require_something_to_write(!job.outputs.empty(), graph_extensions(), job.views);
  for (const std::string& output : job.outputs) (void)find_graph_format(output);
  require_usable_outputs(job.input, job.outputs, job.views);
  require_not_negative("resample", job.resample_spacings);
  require_not_negative("fit", job.fit_spacings);
  const bool spectrum_is_for_views = add_spectrum_for(job.views, detection.options);

  StopWatch total;
  StopWatch stage;
  ViewFiles views(job.views);
  const Reading reading = read_cloud(job.input, progress);
  detection.times.read_s = stage.lap_s();
  const PointCloud& cloud = reading.cloud;
  progress.begin("neighborhoods", 0);
  const NeighborSearch search(cloud.positions, progress);
  detection.times.neighborhoods_s = stage.lap_s();
  std::vector<Point> seen;
  std::optional<FeatureLabels> own;
  if (may_use_labels) own = labels_of(cloud);
  if (own) {
    detection.options.clear();
    detection.labels = std::move(*own);
    detection.spacing = estimate_spacing(cloud, search);
    detection.notes.push_back("the labels of the input are used; --method labels it anew");
  } else {
    report.method = method.name;
    seen = detect_in(cloud, search, method, job.smoothing, detection, progress);
  }
  const std::vector<std::string> view_notes = views.collect(cloud, detection.labels, seen, progress);
  detection.notes.insert(detection.notes.end(), view_notes.begin(), view_notes.end());
  if (spectrum_is_for_views && !own) drop_spectrum(detection);
  (void)stage.lap_s();
  report.graph = lines_of(cloud, search, detection.labels, detection.spacing, job, progress);
  detection.times.lines_s = stage.lap_s();
  report.graph.crs = crs_of(cloud);
  take_over(reading, detection);
  write_graph(job.outputs, report.graph, progress, [&] {
    ReportFacts facts = facts_of(job.input, detection, own ? nullptr : &method, job.options);
    facts.command = "lines";
    facts.times_s.emplace_back("lines", detection.times.lines_s);
    views.write(facts, cloud, &report.graph, progress);
    detection.times.write_s = stage.lap_s();
    detection.times.total_s = total.lap_s();
    if (before_commit) before_commit(report);
  });
  views.commit();
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
