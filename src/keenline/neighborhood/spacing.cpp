#include "keenline/neighborhood/spacing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/local_offsets.h"

namespace keenline {
namespace {

constexpr std::size_t nearest = 16;

/// Says that a point does not count.
constexpr double none = -1;

void require_match(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
}

/// Of all values but `none`; 0 when there are no others.
double lower_median(std::vector<double> values) {
  values.erase(std::remove(values.begin(), values.end(), none), values.end());
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::span<const std::uint32_t> nearest_of(const Neighborhoods& neighborhoods, std::size_t point) {
  const auto neighbors = neighborhoods.of(point);
  return neighbors.first(std::min(neighbors.size(), nearest));
}

/// Spacing of a surface where a disc of the radius `farthest` has `count` points beside the one in its
/// middle.
double spacing_within(const Point& farthest, std::size_t count) {
  return std::sqrt(dot(farthest, farthest) * (kernels::pi / (static_cast<double>(count) + 0.5)));
}

constexpr std::size_t terms = 6;
constexpr std::size_t largest_fit = nearest + 1;
using Values = std::array<double, largest_fit>;

/// Takes the part along the unit vector `direction` out of `values`.
void remove_part(Values& values, const Values& direction, std::size_t count) {
  double part = 0;
  for (std::size_t i = 0; i < count; ++i) part += values[i] * direction[i];
  for (std::size_t i = 0; i < count; ++i) values[i] -= part * direction[i];
}

double length_of(const Values& values, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += values[i] * values[i];
  return std::sqrt(sum);
}

/// What is left of `heights` when its least-squares fit by the columns is taken away; `none` when the columns
/// depend on each other. By Gram-Schmidt orthogonalisation, done twice, which is as exact as can be (Giraud,
/// Langou, Rozloznik 2005, "The loss of orthogonality in the Gram-Schmidt orthogonalization process").
double residual_length(std::array<Values, terms> columns, Values heights, std::size_t count) {
  constexpr double least_share = 1e-6;  // what a column must add to those before it, of its own length
  for (std::size_t j = 0; j < terms; ++j) {
    const double whole = length_of(columns[j], count);
    for (int pass = 0; pass < 2; ++pass)
      for (std::size_t before = 0; before < j; ++before) remove_part(columns[j], columns[before], count);
    const double length = length_of(columns[j], count);
    if (!(length > least_share * whole)) return none;
    for (std::size_t i = 0; i < count; ++i) columns[j][i] /= length;
  }
  for (int pass = 0; pass < 2; ++pass)
    for (const Values& column : columns) remove_part(heights, column, count);
  return length_of(heights, count);
}

/// Standard deviation from the fitted quadric as a multiple of the spacing around the point.
double noise_at(const PointCloud& cloud, const Neighborhoods& neighborhoods, std::size_t point,
                LocalOffsets& local) {
  constexpr std::size_t fewest_neighbors = 9;
  const auto neighbors = nearest_of(neighborhoods, point);
  if (neighbors.size() < fewest_neighbors || !local.gather(cloud.positions, point, neighbors)) return none;
  const auto offsets = local.offsets();
  const double spacing = spacing_within(offsets.back(), offsets.size());
  if (!(spacing > 0)) return none;

  const auto axes = kernels::eigen_decomposition(scatter_of(offsets)).vectors;
  const std::size_t count = offsets.size() + 1;
  std::array<Values, terms> columns{};
  Values heights{};
  columns[0].fill(1);  // the point itself is at 0: it has no other entries
  for (std::size_t i = 1; i < count; ++i) {
    const double x = dot(offsets[i - 1], axes[0]);
    const double y = dot(offsets[i - 1], axes[1]);
    columns[1][i] = x;
    columns[2][i] = y;
    columns[3][i] = x * x;
    columns[4][i] = x * y;
    columns[5][i] = y * y;
    heights[i] = dot(offsets[i - 1], axes[2]);
  }
  const double residual = residual_length(columns, heights, count);
  if (residual == none) return none;
  return residual / std::sqrt(static_cast<double>(count - terms)) / spacing;
}

}  // namespace

double estimate_spacing(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  require_match(cloud, neighborhoods);
  require_memory(cloud.size() * sizeof(double), "measuring the spacing");
  std::vector<double> spacings(cloud.size(), none);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cloud.size(), 1024),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      LocalOffsets local;
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const auto neighbors = nearest_of(neighborhoods, i);
                        if (neighbors.size() < min_neighbors) continue;
                        if (!local.gather(cloud.positions, i, neighbors.last(1))) continue;
                        const double spacing = spacing_within(local.offsets()[0], neighbors.size());
                        if (is_finite({spacing * local.unit(), 0, 0})) spacings[i] = spacing * local.unit();
                      }
                    });
  return lower_median(std::move(spacings));
}

double estimate_noise(const PointCloud& cloud, const Neighborhoods& neighborhoods) {
  require_match(cloud, neighborhoods);
  constexpr std::size_t largest_sample = 16384;
  const std::size_t step = (cloud.size() + largest_sample - 1) / largest_sample;
  const std::size_t count = step == 0 ? 0 : (cloud.size() + step - 1) / step;
  std::vector<double> levels(count, none);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      LocalOffsets local;
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        levels[i] = noise_at(cloud, neighborhoods, i * step, local);
                    });
  return lower_median(std::move(levels));
}

}  // namespace keenline
