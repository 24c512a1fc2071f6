#pragma once

#include <functional>
#include <string>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/detect/registry.h"
#include "keenline/io/formats.h"
#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

/// From a file to a file: read, neighborhoods, detect, write.
struct DetectJob {
  std::string input;
  std::string output;  ///< .ply or .csv
  std::string method = "gauss";
  OptionValues options;  ///< what differs from the method's defaults
};

struct StageTimes {
  double read_s = 0;
  double neighborhoods_s = 0;
  double detect_s = 0;
  double write_s = 0;
  double total_s = 0;
};

struct DetectReport {
  std::string format;  ///< of the input
  std::string encoding;
  std::size_t points = 0;
  std::size_t finite_points = 0;
  OptionValues options;  ///< as used: defaults filled in, and what was chosen from the data
  FeatureLabels labels;
  std::vector<std::string> notes;  ///< what a user should know, one line each
  StageTimes times;
};

/// `before_commit` is called with the report when all is written and only the renaming of the output is left.
/// \throw InvalidArgument, InputError, OutOfMemory, std::bad_alloc, OutputError, Cancelled or what
/// before_commit throws; the output is then as it was before.
[[nodiscard]] DetectReport run_detect(const DetectJob& job, Progress& progress = no_progress(),
                                      const std::function<void(const DetectReport&)>& before_commit = {});

/// Adds the attributes feature (0/1), kind, score and, where the method counts them, clusters; replaces those
/// of the same names and returns the names it replaced. \throw InvalidArgument unless labels.size() ==
/// cloud.size().
std::vector<std::string> add_labels(PointCloud& cloud, const FeatureLabels& labels);

}  // namespace keenline
