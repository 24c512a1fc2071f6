#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/labels.h"
#include "keenline/progress.h"
#include "keenline/report/report_buffers.h"
#include "keenline/report/report_grid.h"
#include "keenline/report/sensitivity_counts.h"

namespace keenline {

/// Numbers of the points that they can be coloured by: value = low + step * integer.
struct ReportAttribute {
  std::string name;
  std::string buffer;  ///< its largest integer stands for what is not finite
  double low = 0;      ///< of the finite values
  double high = 0;
  double step = 0;
};

/// A labelled cloud in compact form: docs/report-format.md names the buffers.
struct ReportData {
  std::size_t kept = 0;  ///< points
  std::string left_out;  ///< the others in words; empty: there are none
  ReportGrid grid;
  KindCounts kind_counts{};  ///< of the whole cloud
  std::string truth;         ///< attribute that the buffer "truth" is from; empty: there is none
  std::vector<ReportBuffer> buffers;
  std::vector<ReportAttribute> attributes;
  std::vector<std::string> notes;  ///< what a user should know, one line each
};

struct ReportDataOptions {
  /// Points to show: above it some that are neither sharp nor on a border are left out, see select_points().
  std::size_t max_points = 1'000'000;
  /// Of the cloud's other attributes the first so many.
  std::size_t max_attributes = 8;
};

/// `seen` are the smoothed positions that the method looked at; empty: it looked at those of the cloud.
/// Same bits for any number of threads. Memory: about 30 bytes per point that is kept, more with attributes.
/// \pre labels.size() == cloud.size(), seen is empty or as long \throw Cancelled
[[nodiscard]] ReportData report_data(const PointCloud& cloud, const FeatureLabels& labels,
                                     const std::vector<Point>& seen = {},
                                     const ReportDataOptions& options = {},
                                     Progress& progress = no_progress());

}  // namespace keenline
