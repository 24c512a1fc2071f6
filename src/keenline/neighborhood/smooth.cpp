#include "keenline/neighborhood/smooth.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/errors.h"
#include "keenline/kernels/portable_math.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/memory.h"
#include "keenline/neighborhood/local_offsets.h"
#include "keenline/require.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

constexpr int max_rounds = 1000;
constexpr Point no_normal{0, 0, 0};

void validate(const SmoothOptions& options) {
  require_neighbor_count(options.neighbors);
  require_in_range("normal_neighbors", options.normal_neighbors, min_neighbors, max_neighbors);
  require_in_range("angle_deg", options.angle_deg, 1, 90);
  require_in_range("normal_rounds", options.normal_rounds, 0, max_rounds);
  require_in_range("position_rounds", options.position_rounds, 0, max_rounds);
}

class Smoother {
 public:
  Smoother(const PointCloud& cloud, const Neighborhoods& neighborhoods, const SmoothOptions& options,
           Progress& progress)
      : positions_(cloud.positions),
        neighborhoods_(neighborhoods),
        options_(options),
        progress_(progress),
        normals_(cloud.size()),
        next_(cloud.size()) {
    const double sine = kernels::sin_cos(kernels::radians(options.angle_deg)).sin;
    per_squared_sine_ = 1 / (sine * sine);
  }

  std::vector<Point> run() {
    for_each_point([&](std::size_t i, LocalOffsets& local) { normals_[i] = first_normal(i, local); });
    for (int round = 0; round < options_.normal_rounds; ++round) {
      for_each_point([&](std::size_t i, LocalOffsets& local) { next_[i] = average_normal(i, local); });
      normals_.swap(next_);
    }
    displacements_.assign(positions_.size(), {0, 0, 0});
    for (int round = 0; round < options_.position_rounds; ++round) {
      for_each_point([&](std::size_t i, LocalOffsets& local) { next_[i] = next_displacement(i, local); });
      displacements_.swap(next_);
    }
    for_each_point([&](std::size_t i, LocalOffsets& /*local*/) {
      // Adding 0 to -0 would change it.
      next_[i] = displacements_[i] == Point{0, 0, 0} ? positions_[i] : sum(positions_[i], displacements_[i]);
    });
    return std::move(next_);
  }

 private:
  /// Every round reads what the round before left and writes elsewhere: threads do not matter.
  template <typename Visit>
  void for_each_point(const Visit& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions_.size(), 256),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        progress_.check();
                        LocalOffsets local;
                        for (std::size_t i = range.begin(); i < range.end(); ++i) visit(i, local);
                        progress_.advance(range.size());
                      });
  }

  static Point sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

  [[nodiscard]] std::span<const std::uint32_t> neighbors_of(std::size_t i, int count) const {
    const auto neighbors = neighborhoods_.of(i);
    return neighbors.first(std::min(neighbors.size(), static_cast<std::size_t>(count)));
  }

  /// By principal components (Hoppe et al. 1992, "Surface reconstruction from unorganized points").
  [[nodiscard]] Point first_normal(std::size_t i, LocalOffsets& local) const {
    const auto neighbors = neighbors_of(i, options_.normal_neighbors);
    if (neighbors.size() < min_neighbors || !local.gather(positions_, i, neighbors)) return no_normal;
    const kernels::Eigen3 axes = kernels::eigen_decomposition(scatter_of(local.offsets()));
    constexpr double thinnest = 1e-12;  // squared width of what is a line, against its length
    return axes.values[1] > thinnest * axes.values[0] ? axes.vectors[2] : no_normal;
  }

  /// Calls visit(j, offset, weight) for every neighbour with a normal; weights fall with distance and with
  /// the sine between the normals. False when the point has no normal: nothing is called then.
  template <typename Visit>
  bool for_each_weighted_neighbor(std::size_t i, LocalOffsets& local, const Visit& visit) const {
    const Point& normal = normals_[i];
    if (normal == no_normal) return false;
    const auto neighbors = neighbors_of(i, options_.neighbors);
    if (!local.gather(positions_, i, neighbors)) return false;
    const auto offsets = local.offsets();
    const double farthest = dot(offsets.back(), offsets.back());
    if (!(farthest > 0)) return false;
    constexpr double widths_to_farthest = 1.5;  // a Gaussian falls to a tenth there
    const double per_squared_width = widths_to_farthest * widths_to_farthest / farthest;
    for (std::size_t k = 0; k < neighbors.size(); ++k) {
      const std::uint32_t j = neighbors[k];
      if (normals_[j] == no_normal) continue;
      const double cosine = dot(normal, normals_[j]);
      const double squared_sine = std::max(0.0, 1 - cosine * cosine);
      const double weight = kernels::exp_of_negative(-dot(offsets[k], offsets[k]) * per_squared_width -
                                                     squared_sine * per_squared_sine_);
      visit(j, offsets[k], weight);
    }
    return true;
  }

  [[nodiscard]] Point average_normal(std::size_t i, LocalOffsets& local) const {
    kernels::Symmetric3 tensor;
    add_square(tensor, normals_[i], 1);
    const bool any =
        for_each_weighted_neighbor(i, local, [&](std::uint32_t j, const Point& /*offset*/, double weight) {
          add_square(tensor, normals_[j], weight);
        });
    return any ? kernels::eigen_decomposition(tensor).vectors[0] : normals_[i];
  }

  [[nodiscard]] Point next_displacement(std::size_t i, LocalOffsets& local) const {
    Point step{};
    double weights = 0;
    const Point& here = displacements_[i];
    for_each_weighted_neighbor(i, local, [&](std::uint32_t j, const Point& offset, double weight) {
      const Point& there = displacements_[j];
      const Point& normal = normals_[j];
      const Point now{offset[0] + (there[0] - here[0]) * local.per_unit(),
                      offset[1] + (there[1] - here[1]) * local.per_unit(),
                      offset[2] + (there[2] - here[2]) * local.per_unit()};
      const double along = weight * dot(now, normal);
      for (std::size_t axis = 0; axis < 3; ++axis) step[axis] += along * normal[axis];
      weights += weight;
    });
    if (!(weights > 0)) return here;
    constexpr double pace = 0.7;  // all the way, neighbours that move at once would overshoot
    const double factor = pace / weights * local.unit();
    const Point next = sum(here, {step[0] * factor, step[1] * factor, step[2] * factor});
    // At the end of the range of doubles a point may have nowhere to go.
    return is_finite(sum(positions_[i], next)) ? next : here;
  }

  const std::vector<Point>& positions_;
  const Neighborhoods& neighborhoods_;
  const SmoothOptions& options_;
  Progress& progress_;
  double per_squared_sine_ = 0;
  std::vector<Point> normals_;
  std::vector<Point> displacements_;  // from the original positions
  std::vector<Point> next_;
};

}  // namespace

std::vector<Point> smooth_positions(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                                    const SmoothOptions& options, Progress& progress) {
  validate(options);
  if (neighborhoods.size() != cloud.size())
    throw InvalidArgument(fmt::format("{} neighborhoods for {} points", neighborhoods.size(), cloud.size()));
  require_memory(cloud.size() * 3 * sizeof(Point), "smoothing");
  const auto rounds =
      static_cast<std::uint64_t>(options.normal_rounds) + static_cast<std::uint64_t>(options.position_rounds);
  progress.begin("smooth", cloud.size() * (rounds + 2));
  return Smoother(cloud, neighborhoods, options, progress).run();
}

}  // namespace keenline
