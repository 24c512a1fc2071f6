#include "keenline/synth/sampling.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "keenline/synth/curve_network.h"
#include "keenline/synth/parallel.h"

namespace keenline::synth {
namespace {

// Lattices are laid out to keep exactly half a step off; rounding must not cost a row.
constexpr double rounding = 1e-9;

/// Points inside the curves, evenly spaced; of a whole circle all points.
void add_inner_points(std::span<const Curve> curves, double spacing, Sample::On on,
                      std::vector<Sample>& samples) {
  for (const Curve& curve : curves) {
    const double fewest = curve.is_circle() ? 3 : 1;
    const auto steps =
        static_cast<std::size_t>(std::max(fewest, std::ceil(curve.length() / spacing - rounding)));
    for (std::size_t i = curve.is_circle() ? 0 : 1; i < steps; ++i)
      samples.push_back({curve.at(static_cast<double>(i) / static_cast<double>(steps)), 0, on});
  }
}

}  // namespace

std::vector<Sample> sample_randomly(const Shape& shape, std::size_t count, std::uint64_t seed,
                                    Progress& progress) {
  std::vector<double> area_up_to;
  double area = 0;
  for (const auto& face : shape.faces) area_up_to.push_back(area += face->area());

  std::vector<Sample> samples(count);
  progress.begin("sampling", count);
  for_each_index(count, progress, [&](std::size_t i) {
    RandomStream random(seed, Purpose::Position, i);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end() - 1, random.uniform() * area);
    const Face& face = *shape.faces[static_cast<std::size_t>(found - area_up_to.begin())];
    samples[i].position = face.random_point(random);
    samples[i].curved = face.is_curved();
  });
  return samples;
}

std::vector<Sample> sample_grid(const Shape& shape, double spacing, Progress& progress) {
  std::vector<Sample> samples;
  progress.begin("sampling", 0);
  std::vector<Vec3> lattice;
  std::vector<std::uint8_t> keep;
  const double margin = 0.5 * spacing * (1 - rounding);
  for (const auto& face : shape.faces) {
    lattice.clear();
    face->add_lattice(spacing, lattice, progress);
    keep.assign(lattice.size(), 0);
    for_each_index(lattice.size(), progress, [&](std::size_t i) {
      const Vec3& p = lattice[i];
      keep[i] = distance_to(shape.edges, p) >= margin && distance_to(shape.borders, p) >= margin &&
                distance_to(shape.peaks, p) >= margin;
    });
    for (std::size_t i = 0; i < lattice.size(); ++i)
      if (keep[i] != 0) samples.push_back({lattice[i], 0, Sample::On::Face, face->is_curved()});
  }
  return samples;
}

std::vector<Sample> sample_mesh(const Shape& shape, double spacing, Progress& progress) {
  std::vector<Sample> samples = sample_grid(shape, spacing, progress);
  add_inner_points(shape.edges, spacing, Sample::On::Edge, samples);
  add_inner_points(shape.borders, spacing, Sample::On::Border, samples);

  // A border may end on an edge; such a point is the edge's.
  std::vector<Curve> all_curves = shape.edges;
  all_curves.insert(all_curves.end(), shape.borders.begin(), shape.borders.end());
  const std::size_t edge_ends = ends_of(shape.edges).size();
  const std::vector<Vec3> ends = ends_of(all_curves);
  for (std::size_t i = 0; i < ends.size(); ++i)
    samples.push_back({ends[i], 0, i < edge_ends ? Sample::On::Edge : Sample::On::Border});
  for (const Vec3& peak : shape.peaks) samples.push_back({peak});
  return samples;
}

}  // namespace keenline::synth
