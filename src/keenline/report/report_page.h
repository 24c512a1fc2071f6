#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "keenline/detect/registry.h"
#include "keenline/progress.h"

namespace keenline {

struct FeatureGraph;
class Sink;
struct ReportData;

/// What a report says of the run that it shows.
struct ReportFacts {
  std::string command;  ///< "detect" or "lines"
  std::string input;    ///< path
  std::string format;   ///< of the input
  std::string encoding;
  std::size_t points = 0;
  std::size_t finite_points = 0;
  const Method* method = nullptr;  ///< none: the labels came with the input
  OptionValues options;            ///< of the method, as used
  double spacing = 0;
  double noise = 0;  ///< with a method only
  bool smoothed = false;
  double sigma_deg = 0;         ///< 0: none for all points
  std::string_view sigma_rule;  ///< "given", "auto", "local"; empty: a method without sensitivity
  std::vector<std::pair<std::string_view, double>> times_s;
  std::vector<std::string> notes;
};

/// The page that is built from viewer/; empty where this build has none.
[[nodiscard]] std::string_view report_page();

/// \throw InvalidArgument unless `path` ends in .html and this build has a page.
void require_writable_report(std::string_view path);

/// One HTML file that shows the run without network or server: `page` with facts, data and lines in place of
/// its marker, see docs/report-format.md. `lines` may be nullptr.
/// \throw InvalidArgument unless the page has the marker once; OutputError from the sink; OutOfMemory;
/// Cancelled.
void write_report(std::string_view page, const ReportFacts& facts, const ReportData& data,
                  const FeatureGraph* lines, Sink& sink, Progress& progress = no_progress());

}  // namespace keenline
