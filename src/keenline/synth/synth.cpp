#include "keenline/synth/synth.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "keenline/errors.h"
#include "keenline/labels.h"
#include "keenline/synth/curve_network.h"
#include "keenline/synth/parallel.h"
#include "keenline/synth/sampling.h"
#include "keenline/synth/scan.h"
#include "keenline/synth/shapes.h"

namespace keenline {
namespace {

using synth::Sample;
using synth::Shape;
using synth::Vec3;

const synth::ShapeRow& checked_shape(std::string_view name) {
  if (const synth::ShapeRow* row = synth::find_shape(name)) return *row;
  std::string known;
  for (const synth::ShapeRow& row : synth::shape_rows())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", row.shape.name);
  throw InvalidArgument(fmt::format("unknown shape {}; known are {}", quoted(name), known));
}

double checked_angle(const SynthShape& shape, std::optional<double> angle_deg) {
  if (!shape.angle) {
    if (angle_deg) throw InvalidArgument(fmt::format("the shape {} takes no angle", shape.name));
    return 0;
  }
  const auto [smallest, largest, standard] = *shape.angle;
  const double angle = angle_deg.value_or(standard);
  if (!(angle >= smallest && angle <= largest)) {
    throw InvalidArgument(fmt::format("the angle of a {} must be {} to {} degrees, not {}", shape.name,
                                      smallest, largest, angle));
  }
  return angle;
}

void check_options(const SynthOptions& options) {
  if (options.points < 1 || options.points > max_points)
    throw InvalidArgument(fmt::format("points must be 1 to {}, not {}", max_points, options.points));
  const auto check = [](std::string_view name, double value) {
    if (!(value >= 0 && std::isfinite(value)))
      throw InvalidArgument(fmt::format("{} must be a number from 0 up, not {}", name, value));
  };
  check("noise", options.noise.amount);
  check("feature band", options.feature_band);
}

/// Samples, and for a scan where its stations stood.
synth::Scan take_samples(const Shape& shape, const SynthOptions& options, double spacing,
                         Progress& progress) {
  switch (options.sampling) {
    case Sampling::Random: return {sample_randomly(shape, options.points, options.seed, progress), {}};
    case Sampling::Grid: return {sample_grid(shape, spacing, progress), {}};
    case Sampling::Mesh: return {sample_mesh(shape, spacing, progress), {}};
    case Sampling::Scan: break;
  }
  return scan(shape, options.points, options.seed, progress);
}

struct Truth {
  double distance;
  bool feature;
  Kind kind;
};

Truth truth_of(const Sample& sample, const Shape& shape, double band) {
  const Vec3& p = sample.position;
  const double edge = sample.on == Sample::On::Edge ? 0 : distance_to(shape.edges, p);
  const double peak = distance_to(shape.peaks, p);
  const double border = sample.on == Sample::On::Border ? 0 : distance_to(shape.borders, p);
  const double distance = std::min(edge, peak);
  const auto kind = [&] {
    if (edge <= band && distance_to(shape.corners, p) <= band) return Kind::Corner;
    if (peak <= band) return Kind::Peak;
    if (edge <= band) return Kind::Edge;
    if (border <= band) return Kind::Border;
    return sample.curved ? Kind::Curved : Kind::Flat;
  };
  return {distance, distance <= band, kind()};
}

/// Moves every sample by its own random numbers and writes down the truth about where it was.
PointCloud labelled_cloud(const Shape& shape, const synth::Scan& scan, const SynthOptions& options,
                          double spacing, Progress& progress) {
  const std::size_t count = scan.samples.size();
  const bool in_spacings = options.noise.unit == Noise::Unit::Spacing;
  const double sigma = options.noise.amount * (in_spacings ? spacing : shape.bounds().diagonal());
  const double band = options.feature_band * spacing;

  PointCloud cloud;
  cloud.positions.resize(count);
  Column feature("truth_feature", ScalarType::UInt8, count);
  Column kind("truth_kind", ScalarType::UInt8, count);
  Column distance("truth_distance", ScalarType::Float64, count);
  const auto features = feature.values<std::uint8_t>();
  const auto kinds = kind.values<std::uint8_t>();
  const auto distances = distance.values<double>();
  progress.begin("labelling", count);
  synth::for_each_index(count, progress, [&](std::size_t i) {
    const Sample& sample = scan.samples[i];
    const Truth truth = truth_of(sample, shape, band);
    features[i] = truth.feature ? 1 : 0;
    kinds[i] = static_cast<std::uint8_t>(truth.kind);
    distances[i] = truth.distance;

    Vec3 moved = sample.position;
    if (sigma > 0) {
      synth::RandomStream random(options.seed, synth::Purpose::Noise, i);
      if (scan.stations.empty()) moved = moved + sigma * random.normal_vector();
      else moved = moved + (sigma * random.normal()) * unit(moved - scan.stations[sample.station]);
    }
    cloud.positions[i] = moved.point();
  });
  for (Column* column : {&feature, &kind, &distance}) cloud.attributes.push_back(std::move(*column));
  return cloud;
}

std::vector<TruthCurve> truth_curves(const Shape& shape, double spacing) {
  std::vector<TruthCurve> curves = polylines_of(shape.edges, shape.corners, spacing);
  std::vector<TruthCurve> designed = polylines_of(shape.designed, corners_of(shape.designed), spacing);
  std::move(designed.begin(), designed.end(), std::back_inserter(curves));
  std::vector<TruthCurve> borders = polylines_of(shape.borders, corners_of(shape.borders), spacing);
  for (TruthCurve& border : borders) border.border = true;
  std::move(borders.begin(), borders.end(), std::back_inserter(curves));
  return curves;
}

}  // namespace

std::span<const SynthShape> synth_shapes() {
  static const std::vector<SynthShape> shapes = [] {
    std::vector<SynthShape> all;
    for (const synth::ShapeRow& row : synth::shape_rows()) all.push_back(row.shape);
    return all;
  }();
  return shapes;
}

SynthCloud synthesize(const SynthOptions& options, Progress& progress) {
  const synth::ShapeRow& row = checked_shape(options.shape);
  check_options(options);
  const Shape shape = row.build(checked_angle(row.shape, options.angle_deg));

  SynthCloud result;
  result.spacing = std::sqrt(shape.area() / static_cast<double>(options.points));
  const synth::Scan samples = take_samples(shape, options, result.spacing, progress);
  result.cloud = labelled_cloud(shape, samples, options, result.spacing, progress);
  result.curves = truth_curves(shape, result.spacing);
  for (const Vec3& corner : shape.corners) result.corners.push_back(corner.point());
  for (const Vec3& corner : synth::corners_of(shape.designed)) result.corners.push_back(corner.point());
  for (const Vec3& corner : synth::corners_of(shape.borders)) result.border_corners.push_back(corner.point());
  for (const Vec3& peak : shape.peaks) result.peaks.push_back(peak.point());
  return result;
}

}  // namespace keenline
