#include "keenline/pipeline.h"

#include <cerrno>
#include <chrono>
#include <unistd.h>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/output_file.h"
#include "keenline/io/read.h"
#include "keenline/io/write.h"
#include "keenline/neighborhood/neighborhoods.h"

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

}  // namespace

DetectReport run_detect(const DetectJob& job, Progress& progress,
                        const std::function<void(const DetectReport&)>& before_commit) {
  const Method& method = find_method(job.method);
  DetectReport report;
  report.options = resolve_options(method, job.options);
  require_writable_extension(job.output);
  require_different_files(job.input, job.output);
  require_writable_folder(job.output);

  StopWatch total;
  StopWatch stage;
  Reading reading = read_cloud(job.input, progress);
  report.times.read_s = stage.lap_s();
  const Neighborhoods neighborhoods =
      find_neighborhoods(reading.cloud, method.reach(report.options), progress);
  report.times.neighborhoods_s = stage.lap_s();
  report.labels = method.detect(reading.cloud, neighborhoods, report.options, progress);
  report.times.detect_s = stage.lap_s();
  const std::vector<std::string> replaced = add_labels(reading.cloud, report.labels);
  report.format = reading.format;
  report.encoding = reading.encoding;
  report.points = reading.cloud.size();
  report.finite_points = count_finite(reading.cloud);
  report.notes = std::move(reading.notes);
  for (const std::string& name : replaced)
    report.notes.push_back(fmt::format("the input's attribute {} is replaced", quoted(name)));
  const auto complete_report = [&](const std::vector<std::string>& writing_notes) {
    report.notes.insert(report.notes.end(), writing_notes.begin(), writing_notes.end());
    report.times.write_s = stage.lap_s();
    report.times.total_s = total.lap_s();
    if (before_commit) before_commit(report);
  };
  write_cloud(job.output, reading.cloud, progress, complete_report);
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
  add(Column("score", labels.score));
  if (!labels.clusters.empty() || labels.size() == 0) add(Column("clusters", labels.clusters));
  return replaced;
}

}  // namespace keenline
