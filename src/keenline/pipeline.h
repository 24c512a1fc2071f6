#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/detect/registry.h"
#include "keenline/detect/relabel.h"
#include "keenline/feature_graph.h"
#include "keenline/io/formats.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

/// Whether positions are smoothed before a method looks at them (outputs always hold the original ones).
enum class Smoothing : std::uint8_t {
  Auto,  ///< where the noise is above noise_worth_smoothing
  Yes,
  No
};

/// In spacings. Below, smoothing moves points about as far as the noise did.
inline constexpr double noise_worth_smoothing = 0.2;

/// How a run can be looked at. What is named is written with its result: all or nothing.
struct Views {
  std::string report{};  ///< .html, see write_report(); empty = none
  /// In a larger cloud points are left out of the report that are neither sharp nor on a border.
  std::size_t report_points = 1'000'000;
  std::string picture{};  ///< .png, see draw_cloud(); empty = none

  [[nodiscard]] bool empty() const { return report.empty() && picture.empty(); }
};

/// From a file to a file: read, neighborhoods, smooth if noisy, detect, write.
struct DetectJob {
  std::string input;
  std::string output;  ///< .ply or .csv; may be empty where there are views
  std::string method = "gauss";
  OptionValues options;  ///< what differs from the method's defaults
  Smoothing smoothing =
      Smoothing::Auto;  ///< no matter what, a method's plain form gets the points as they are
  Views views;
};

struct StageTimes {
  double read_s = 0;
  double neighborhoods_s = 0;
  double smooth_s = 0;
  double detect_s = 0;
  double lines_s = 0;  ///< of run_lines()
  double write_s = 0;
  double total_s = 0;
};

/// What was understood of the input, and what a method found in it.
struct DetectReport {
  std::string format;
  std::string encoding;
  std::size_t points = 0;
  std::size_t finite_points = 0;
  OptionValues options;  ///< as used: defaults filled in, and what was chosen from the data
  double spacing = 0;    ///< see estimate_spacing()
  double noise = 0;      ///< see estimate_noise()
  bool smoothed = false;
  FeatureLabels labels;
  std::vector<std::string> notes;  ///< what a user should know, one line each
  StageTimes times;
};

/// `before_commit` is called with the report when all is written and only the renaming of outputs is left.
/// \throw InvalidArgument, InputError, OutOfMemory, std::bad_alloc, OutputError, Cancelled or what
/// before_commit throws; the output is then as it was before.
[[nodiscard]] DetectReport run_detect(const DetectJob& job, Progress& progress = no_progress(),
                                      const std::function<void(const DetectReport&)>& before_commit = {});

/// Other labels for a cloud that holds the labels of all sensitivities: read, relabel, write.
struct RelabelJob {
  std::string input;   ///< what run_detect() wrote with the option "spectrum"
  std::string output;  ///< .ply or .csv
  SigmaRule sigma_rule = SigmaRule::Auto;
  double sigma_deg = 0;  ///< with SigmaRule::Given
};

struct RelabelTimes {
  double read_s = 0;
  double relabel_s = 0;
  double write_s = 0;
  double total_s = 0;
};

struct RelabelReport {
  std::string format;  ///< of the input
  std::string encoding;
  std::size_t points = 0;
  std::size_t finite_points = 0;
  FeatureLabels labels;            ///< without scores; sigma_deg is what was used, 0 = a choice per point
  std::vector<std::string> notes;  ///< what a user should know, one line each
  RelabelTimes times;
};

/// The output is what run_detect() writes with this sigma: only feature, kind, clusters and the comment about
/// sigma differ from the input. `before_commit` as in run_detect().
/// \throw as run_detect(); InputError when the input holds no usable spectrum, see spectrum_of().
[[nodiscard]] RelabelReport run_relabel(const RelabelJob& job, Progress& progress = no_progress(),
                                        const std::function<void(const RelabelReport&)>& before_commit = {});

/// From a file to a drawing: read, detect unless the file is labelled, trace, and what is asked for of snap,
/// smooth, resample and fit; write.
struct LinesJob {
  std::string input;                 ///< a cloud, or what run_detect() wrote
  std::vector<std::string> outputs;  ///< drawings, see graph_formats(); at least one unless there are views
  /// Empty: the labels of the input where it has some (see labels_of()), else the first of methods().
  std::string method;
  OptionValues options;  ///< as in DetectJob
  Smoothing smoothing = Smoothing::Auto;
  std::string trace = "walk";  ///< a name from line_tracers()
  bool snap = true;            ///< onto the intersection of the surfaces, see snap_lines(), join_lines()
  bool smooth_lines = true;    ///< see smooth_lines(); what is snapped needs none
  double resample_spacings =
      0;  ///< >= 0: distance of the vertices in spacings, see resample_lines(); 0 = as they are
  double fit_spacings = 0;  ///< >= 0: tolerance of fit_lines() in spacings; 0 = no curves are fitted
  Views views;
};

struct LinesReport {
  DetectReport detection;  ///< of labels that came with the input: no options, no noise
  std::string method;      ///< empty: the labels came with the input
  FeatureGraph graph;
};

/// `before_commit` as in run_detect(). \throw as run_detect()
[[nodiscard]] LinesReport run_lines(const LinesJob& job, Progress& progress = no_progress(),
                                    const std::function<void(const LinesReport&)>& before_commit = {});

/// Adds the attributes feature (0/1), kind, score, where the method counts them clusters, and where it is
/// kept the spectrum with its comment (see spectrum_columns()); replaces those of the same names and returns
/// the names it replaced. Labels without scores leave the score as it is.
/// \throw InvalidArgument unless labels.size() == cloud.size().
std::vector<std::string> add_labels(PointCloud& cloud, const FeatureLabels& labels);

/// The labels that a cloud carries: its attribute kind, or else feature, where what is not 0 is an edge; with
/// its scores, if there are some. Nothing when it has neither, or when kind holds what is no Kind.
[[nodiscard]] std::optional<FeatureLabels> labels_of(const PointCloud& cloud);

}  // namespace keenline
