#include "keenline/report/report_data.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/io/text.h"
#include "keenline/report/report_selection.h"

namespace keenline {
namespace {

using Selection = std::span<const std::uint32_t>;

template <typename T>
ReportBuffer buffer_of(std::string name, const std::vector<T>& values, BufferCoding coding,
                       std::size_t components = 1) {
  return encoded(std::move(name), std::span<const T>(values), components, coding);
}

/// One number per kept point.
template <typename T, typename Function>
std::vector<T> for_each(Selection selection, const Function& function) {
  std::vector<T> values;
  values.reserve(selection.size());
  for (const std::uint32_t point : selection) values.push_back(static_cast<T>(function(point)));
  return values;
}

void add_positions(const PointCloud& cloud, const std::vector<Point>& seen, Selection selection,
                   ReportData& data) {
  std::vector<std::uint32_t> places;
  std::vector<std::uint32_t> offsets;
  places.reserve(3 * selection.size());
  offsets.reserve(seen.empty() ? 0 : 3 * selection.size());
  for (const std::uint32_t point : selection) {
    const std::array<std::int32_t, 3> place = place_in(data.grid, cloud.positions[point]);
    for (const std::int32_t p : place) places.push_back(static_cast<std::uint32_t>(p));
    if (seen.empty()) continue;
    const std::array<std::int32_t, 3> looked_at = place_in(data.grid, seen[point]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      offsets.push_back(
          folded(static_cast<std::uint32_t>(looked_at[axis]) - static_cast<std::uint32_t>(place[axis])));
  }
  data.buffers.push_back(buffer_of("position", places, BufferCoding::Delta, 3));
  if (selection.size() < cloud.size()) {
    const std::vector<std::uint32_t> index(selection.begin(), selection.end());
    data.buffers.push_back(buffer_of("index", index, BufferCoding::Delta));
  }
  if (!seen.empty()) data.buffers.push_back(buffer_of("seen_offset", offsets, BufferCoding::Planes, 3));
}

/// Larger ones count as not finite: so no difference of two overflows, here or in the page.
bool is_usable(double value) { return std::abs(value) <= 1e300; }

/// What the values of an attribute have in common.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  bool is_whole = true;

  void include(double value) {
    if (!is_usable(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
    is_whole &= std::floor(value) == value;
  }
  [[nodiscard]] bool is_empty() const { return low > high; }
};

template <typename T, typename ValueOf>
ReportBuffer quantised(const ReportAttribute& attribute, Selection selection, const ValueOf& value_of) {
  constexpr T not_finite = std::numeric_limits<T>::max();
  return buffer_of(
      attribute.buffer,
      for_each<T>(selection,
                  [&](std::uint32_t point) {
                    const double value = value_of(point);
                    if (!is_usable(value)) return not_finite;
                    if (attribute.step == 0) return T{0};
                    // Divided first, for the difference of large numbers may overflow.
                    const double steps = value / attribute.step - attribute.low / attribute.step;
                    return static_cast<T>(std::clamp(std::nearbyint(steps), 0.0, not_finite - 1.0));
                  }),
      BufferCoding::Planes);
}

template <typename ValueOf>
void add_attribute(std::string name, std::string buffer, Selection selection, const ValueOf& value_of,
                   ReportData& data) {
  constexpr double largest8 = std::numeric_limits<std::uint8_t>::max() - 1;
  constexpr double largest16 = std::numeric_limits<std::uint16_t>::max() - 1;
  Range range;
  for (const std::uint32_t point : selection) range.include(value_of(point));
  ReportAttribute attribute{std::move(name), std::move(buffer)};
  if (!range.is_empty()) {
    attribute.low = range.low;
    attribute.high = range.high;
    const double step = (range.high - range.low) / largest16;
    const bool is_exact = range.is_whole && range.high - range.low <= largest16;
    attribute.step = is_exact ? 1 : step < std::numeric_limits<double>::min() ? 0 : step;
  }
  const bool is_small = range.is_whole && attribute.high - attribute.low <= largest8;
  data.buffers.push_back(is_small ? quantised<std::uint8_t>(attribute, selection, value_of)
                                  : quantised<std::uint16_t>(attribute, selection, value_of));
  data.attributes.push_back(std::move(attribute));
}

void add_labels(const FeatureLabels& labels, Selection selection, ReportData& data) {
  const auto kinds =
      for_each<std::uint8_t>(selection, [&](std::uint32_t point) { return labels.kind[point]; });
  data.buffers.push_back(buffer_of("kind", kinds, BufferCoding::Raw));
  if (!labels.score.empty())
    add_attribute(
        "score", "score", selection,
        [&](std::uint32_t point) { return static_cast<double>(labels.score[point]); }, data);
  if (!labels.clusters.empty()) {
    const auto clusters =
        for_each<std::uint8_t>(selection, [&](std::uint32_t point) { return labels.clusters[point]; });
    const std::uint8_t most =
        clusters.empty() ? std::uint8_t{0} : *std::max_element(clusters.begin(), clusters.end());
    data.buffers.push_back(buffer_of("clusters", clusters, BufferCoding::Raw));
    data.attributes.push_back({"clusters", "clusters", 0, static_cast<double>(most), 1});
  }
}

void add_spectrum(const LabelSpectrum& spectrum, Selection selection, ReportData& data) {
  std::vector<std::uint16_t> counts;
  std::vector<std::uint16_t> rises;
  std::vector<std::uint8_t> kinds;
  std::vector<std::uint8_t> clusters;
  counts.reserve(selection.size());
  for (const std::uint32_t point : selection) {
    const std::uint64_t first = spectrum.offsets[point];
    const std::uint64_t end = spectrum.offsets[point + 1];
    counts.push_back(static_cast<std::uint16_t>(end - first));
    for (std::uint64_t step = first; step < end; ++step) {
      if (step > first)
        rises.push_back(static_cast<std::uint16_t>(spectrum.from[step] - spectrum.from[step - 1]));
      kinds.push_back(static_cast<std::uint8_t>(spectrum.kind[step]));
      clusters.push_back(spectrum.clusters[step]);
    }
  }
  data.buffers.push_back(buffer_of("spectrum_count", counts, BufferCoding::Planes));
  data.buffers.push_back(buffer_of("spectrum_rise", rises, BufferCoding::Planes));
  data.buffers.push_back(buffer_of("spectrum_kind", kinds, BufferCoding::Raw));
  data.buffers.push_back(buffer_of("spectrum_clusters", clusters, BufferCoding::Raw));
  std::vector<std::uint32_t> table;
  for (const KindCounts& row : counts_per_sensitivity(spectrum))
    table.insert(table.end(), row.begin(), row.end());
  data.buffers.push_back(buffer_of("counts", table, BufferCoding::Delta, all_kinds.size()));
}

const Column* numbers_named(const PointCloud& cloud, std::string_view name) {
  const Column* const column = cloud.attribute(name);
  return column == nullptr || column->is_list() ? nullptr : column;
}

/// Whether every row holds the number of a kind.
bool holds_kinds(const Column& column) {
  for (std::size_t i = 0; i < column.rows(); ++i)
    if (std::none_of(all_kinds.begin(), all_kinds.end(),
                     [&](Kind kind) { return static_cast<double>(kind) == column.value(i); }))
      return false;
  return true;
}

void add_truth(const PointCloud& cloud, Selection selection, ReportData& data) {
  for (const std::string_view name : {"truth_kind", "truth_feature", "truth"}) {
    const Column* const column = numbers_named(cloud, name);
    const bool has_kinds = name == "truth_kind";
    if (column == nullptr || (has_kinds && !holds_kinds(*column))) continue;
    const auto truth = for_each<std::uint8_t>(selection, [&](std::uint32_t point) {
      const double value = column->value(point);
      if (has_kinds) return static_cast<Kind>(value);
      return value != 0 && !std::isnan(value) ? Kind::Edge : Kind::Flat;
    });
    data.truth = name;
    data.buffers.push_back(buffer_of("truth", truth, BufferCoding::Raw));
    return;
  }
}

using ColorColumns = std::array<const Column*, 3>;

std::optional<ColorColumns> color_columns(const PointCloud& cloud) {
  for (const std::array<std::string_view, 3>& names :
       {std::array<std::string_view, 3>{"red", "green", "blue"}, {"r", "g", "b"}}) {
    const ColorColumns columns{numbers_named(cloud, names[0]), numbers_named(cloud, names[1]),
                               numbers_named(cloud, names[2])};
    if (std::count(columns.begin(), columns.end(), nullptr) == 0) return columns;
  }
  return std::nullopt;
}

/// Files hold colours as shares, in 8 bits or in 16.
void add_colors(const ColorColumns& columns, Selection selection, ReportData& data) {
  Range range;
  for (const Column* const column : columns)
    for (const std::uint32_t point : selection) range.include(column->value(point));
  const bool is_real = size_of(columns[0]->type()) >= 4;
  const double scale = range.high > 255 ? 255.0 / 65535 : is_real && range.high <= 1 ? 255 : 1;
  std::vector<std::uint8_t> colors;
  colors.reserve(3 * selection.size());
  for (const std::uint32_t point : selection) {
    for (const Column* const column : columns) {
      const double value = column->value(point) * scale;
      colors.push_back(static_cast<std::uint8_t>(value > 0 ? std::min(std::nearbyint(value), 255.0) : 0));
    }
  }
  data.buffers.push_back(buffer_of("rgb", colors, BufferCoding::Delta, 3));
}

bool is_label(std::string_view name) {
  constexpr std::array labels{"feature", "kind", "score", "clusters"};
  return std::find(labels.begin(), labels.end(), name) != labels.end();
}

/// What is not labels, truth or colour.
void add_other_attributes(const PointCloud& cloud, const std::optional<ColorColumns>& colors,
                          Selection selection, std::size_t limit, const Progress& progress,
                          ReportData& data) {
  std::size_t taken = 0;
  std::string others;
  for (const Column& column : cloud.attributes) {
    const bool is_color = colors && std::find(colors->begin(), colors->end(), &column) != colors->end();
    if (column.is_list() || is_color || is_label(column.name()) || column.name() == data.truth) continue;
    if (taken == limit) {
      others += fmt::format("{}{}", others.empty() ? "" : ", ", quoted(column.name()));
      continue;
    }
    progress.check();
    add_attribute(
        column.name(), fmt::format("attribute_{}", taken++), selection,
        [&](std::uint32_t point) { return column.value(point); }, data);
  }
  if (!others.empty())
    data.notes.push_back(fmt::format("the report holds the first {} attributes, without {}", limit, others));
}

std::string words_for_left_out(const PointCloud& cloud, std::size_t kept) {
  const std::size_t finite = count_finite(cloud);
  std::string words;
  if (kept < finite)
    words =
        fmt::format("{} of {} points are left out, evenly, of those that are neither sharp nor on a border",
                    grouped(finite - kept), grouped(finite));
  if (finite < cloud.size())
    words += fmt::format("{}{} points without finite coordinates are left out", words.empty() ? "" : "; ",
                         grouped(cloud.size() - finite));
  return words;
}

}  // namespace

ReportData report_data(const PointCloud& cloud, const FeatureLabels& labels, const std::vector<Point>& seen,
                       const ReportDataOptions& options, Progress& progress) {
  const std::vector<std::uint32_t> selection =
      select_points(cloud, labels.kind, options.max_points, progress);
  ReportData data;
  data.kept = selection.size();
  data.left_out = words_for_left_out(cloud, data.kept);
  data.grid = grid_for(cloud.positions);
  data.kind_counts = count_kinds(labels.kind);
  add_positions(cloud, seen, selection, data);
  progress.check();
  add_labels(labels, selection, data);
  if (labels.spectrum) add_spectrum(*labels.spectrum, selection, data);
  progress.check();
  add_truth(cloud, selection, data);
  const std::optional<ColorColumns> colors = color_columns(cloud);
  if (colors) add_colors(*colors, selection, data);
  add_other_attributes(cloud, colors, selection, options.max_attributes, progress, data);
  return data;
}

}  // namespace keenline
