#include "keenline/pipeline.h"

#include <cerrno>
#include <chrono>
#include <unistd.h>

#include <fmt/format.h>

#include "keenline/detect/noise.h"
#include "keenline/detect/relabel.h"
#include "keenline/detect/spectrum_attributes.h"
#include "keenline/errors.h"
#include "keenline/io/output_file.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"
#include "keenline/neighborhood/neighborhoods.h"
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

std::vector<Point> smoothed_positions(const PointCloud& cloud, Neighborhoods& neighborhoods,
                                      Progress& progress) {
  const SmoothOptions options;
  if (cloud.size() > 0 && neighborhoods.of(0).size() < static_cast<std::size_t>(options.neighbors)) {
    neighborhoods = {};
    neighborhoods = find_neighborhoods(cloud, options.neighbors, progress);
  }
  return smooth_positions(cloud, neighborhoods, options, progress);
}

void require_usable_output(const std::string& input, const std::string& output) {
  require_writable_extension(output);
  require_different_files(input, output);
  require_writable_folder(output);
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
void take_over(Reading& reading, Report& report) {
  report.format = reading.format;
  report.encoding = reading.encoding;
  report.points = reading.cloud.size();
  report.finite_points = count_finite(reading.cloud);
  report.notes = std::move(reading.notes);
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
  const int first_reach = method.reach(report.options);
  Neighborhoods neighborhoods = find_neighborhoods(reading.cloud, first_reach, progress);
  report.spacing = estimate_spacing(reading.cloud, neighborhoods);
  report.noise = estimate_noise(reading.cloud, neighborhoods, progress);
  report.times.neighborhoods_s = stage.lap_s();
  method.adapt(report.options, report.noise, count_finite(reading.cloud));
  report.smoothed = !method.is_plain(report.options) &&
                    (job.smoothing == Smoothing::Yes ||
                     (job.smoothing == Smoothing::Auto && report.noise > noise_worth_smoothing));
  PointCloud smooth;  // positions only
  if (report.smoothed) smooth.positions = smoothed_positions(reading.cloud, neighborhoods, progress);
  const PointCloud& seen = report.smoothed ? smooth : reading.cloud;
  const int reach = method.reach(report.options);
  if (report.smoothed || reach != first_reach) {
    neighborhoods = {};
    neighborhoods = find_neighborhoods(seen, reach, progress);
  }
  report.times.smooth_s = stage.lap_s();
  report.labels = method.detect(seen, neighborhoods, report.options, progress);
  report.times.detect_s = stage.lap_s();
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

}  // namespace keenline
