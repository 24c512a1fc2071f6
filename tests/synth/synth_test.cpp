#include "keenline/synth/synth.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "keenline/errors.h"
#include "keenline/labels.h"
#include "keenline/synth/scan.h"

#include "support/expect_error.h"
#include "synth/test_shapes.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Sampling all_samplings[] = {Sampling::Random, Sampling::Grid, Sampling::Mesh, Sampling::Scan};

SynthOptions options_for(std::string shape, std::uint64_t points = 5000,
                         Sampling sampling = Sampling::Random) {
  SynthOptions options;
  options.shape = std::move(shape);
  options.points = points;
  options.sampling = sampling;
  return options;
}

std::span<const double> distances(const SynthCloud& synth) {
  return synth.cloud.attribute("truth_distance")->values<double>();
}
std::span<const std::uint8_t> features(const SynthCloud& synth) {
  return synth.cloud.attribute("truth_feature")->values<std::uint8_t>();
}
Kind kind(const SynthCloud& synth, std::size_t i) {
  return static_cast<Kind>(synth.cloud.attribute("truth_kind")->values<std::uint8_t>()[i]);
}

/// FNV-1a over all bytes of positions and attributes.
std::uint64_t fingerprint(const PointCloud& cloud) {
  std::uint64_t hash = 0xCBF29CE484222325U;
  const auto add = [&](std::span<const std::byte> bytes) {
    for (const std::byte byte : bytes) hash = (hash ^ static_cast<std::uint64_t>(byte)) * 0x100000001B3U;
  };
  add(std::as_bytes(std::span(cloud.positions)));
  for (const Column& column : cloud.attributes) add(column.bytes());
  return hash;
}

double cube_distance(const Point& p) {
  // Off the nearest edge by the gaps to the two nearest face planes.
  std::array<double, 3> gaps{0.5 - std::abs(p[0]), 0.5 - std::abs(p[1]), 0.5 - std::abs(p[2])};
  std::sort(gaps.begin(), gaps.end());
  return std::hypot(gaps[0], gaps[1]);
}

TEST(Synth, truth_distance_has_closed_forms) {
  for (const Sampling sampling : all_samplings) {
    const SynthCloud cube = synthesize(options_for("cube", 3000, sampling));
    for (std::size_t i = 0; i < cube.cloud.size(); ++i)
      ASSERT_NEAR(distances(cube)[i], cube_distance(cube.cloud.positions[i]), 1e-14);

    const SynthCloud cylinder = synthesize(options_for("cylinder", 3000, sampling));
    for (std::size_t i = 0; i < cylinder.cloud.size(); ++i) {
      const auto [x, y, z] = cylinder.cloud.positions[i];
      ASSERT_NEAR(distances(cylinder)[i], std::hypot(std::hypot(x, y) - 1, 1 - std::abs(z)), 1e-14);
    }

    const SynthCloud cone = synthesize(options_for("cone", 3000, sampling));
    for (std::size_t i = 0; i < cone.cloud.size(); ++i) {
      const auto [x, y, z] = cone.cloud.positions[i];
      const double r = std::hypot(x, y);
      const double to_apex = std::hypot(r, z - std::sqrt(0.75));
      ASSERT_NEAR(distances(cone)[i], std::min(std::hypot(r - 0.5, z), to_apex), 1e-14);
    }
  }
}

TEST(Synth, shapes_without_features_are_infinitely_far_from_them) {
  for (const char* shape : {"plane", "sphere", "torus"}) {
    const SynthCloud synth = synthesize(options_for(shape, 500));
    for (std::size_t i = 0; i < synth.cloud.size(); ++i) {
      ASSERT_EQ(distances(synth)[i], infinity);
      ASSERT_EQ(features(synth)[i], 0);
      ASSERT_FALSE(is_feature(kind(synth, i)));
    }
  }
}

TEST(Synth, features_are_what_lies_within_the_band) {
  for (const SynthShape& shape : synth_shapes()) {
    for (const Sampling sampling : all_samplings) {
      SynthOptions options = options_for(std::string(shape.name), 2000, sampling);
      options.feature_band = 0.8;
      const SynthCloud synth = synthesize(options);
      for (std::size_t i = 0; i < synth.cloud.size(); ++i) {
        const bool near = distances(synth)[i] <= 0.8 * synth.spacing;
        ASSERT_EQ(features(synth)[i], near ? 1 : 0) << shape.name;
        ASSERT_EQ(is_feature(kind(synth, i)), near) << shape.name;
      }
    }
  }
}

TEST(Synth, kinds_on_a_cube) {
  SynthOptions options = options_for("cube", 6000);
  options.feature_band = 2;
  const SynthCloud synth = synthesize(options);
  const double band = 2 * synth.spacing;
  for (std::size_t i = 0; i < synth.cloud.size(); ++i) {
    const auto [x, y, z] = synth.cloud.positions[i];
    const double to_corner = std::hypot(0.5 - std::abs(x), 0.5 - std::abs(y), 0.5 - std::abs(z));
    const Kind expected = to_corner <= band                  ? Kind::Corner
                          : cube_distance({x, y, z}) <= band ? Kind::Edge
                                                             : Kind::Flat;
    ASSERT_EQ(kind(synth, i), expected);
  }
}

TEST(Synth, borders_are_no_features) {
  SynthOptions options = options_for("crease", 4000);
  options.feature_band = 1;
  const SynthCloud synth = synthesize(options);
  int borders = 0;
  for (std::size_t i = 0; i < synth.cloud.size(); ++i) {
    const auto [x, y, z] = synth.cloud.positions[i];
    const double to_edge = std::hypot(x, z);
    const double to_border = std::min(0.5 - std::abs(y), 1 - to_edge);
    const Kind expected = to_edge <= synth.spacing     ? Kind::Edge
                          : to_border <= synth.spacing ? Kind::Border
                                                       : Kind::Flat;
    ASSERT_EQ(kind(synth, i), expected);
    borders += kind(synth, i) == Kind::Border ? 1 : 0;
  }
  EXPECT_GT(borders, 100);
}

TEST(Synth, a_band_of_zero_leaves_what_lies_exactly_on_features) {
  SynthOptions options = options_for("cylinder", 1000, Sampling::Mesh);
  options.feature_band = 0;
  const SynthCloud cylinder = synthesize(options);
  const auto on_circle = static_cast<int>(std::ceil(2 * 3.14159265358979 / cylinder.spacing));
  int edges = 0;
  for (std::size_t i = 0; i < cylinder.cloud.size(); ++i) edges += kind(cylinder, i) == Kind::Edge ? 1 : 0;
  EXPECT_EQ(edges, 2 * on_circle);

  options.shape = "cone";
  const SynthCloud cone = synthesize(options);
  EXPECT_EQ(kind(cone, cone.cloud.size() - 1), Kind::Peak);
  EXPECT_EQ(cone.cloud.positions.back(), cone.peaks.at(0));

  options.shape = "cube";
  const SynthCloud cube = synthesize(options);
  int corners = 0;
  for (std::size_t i = 0; i < cube.cloud.size(); ++i) corners += kind(cube, i) == Kind::Corner ? 1 : 0;
  EXPECT_EQ(corners, 8);
}

TEST(Synth, noise_is_normal_with_the_wanted_deviation_and_leaves_truth_alone) {
  for (const auto unit : {Noise::Unit::Spacing, Noise::Unit::BoundingBoxDiagonal}) {
    SynthOptions options = options_for("cube", 30000);
    const SynthCloud clean = synthesize(options);
    options.noise = {0.02, unit};
    const SynthCloud noisy = synthesize(options);
    const double sigma = 0.02 * (unit == Noise::Unit::Spacing ? clean.spacing : std::sqrt(3.0));
    double squares[3] = {0, 0, 0};
    double sum = 0;
    for (std::size_t i = 0; i < clean.cloud.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const double shift = noisy.cloud.positions[i][axis] - clean.cloud.positions[i][axis];
        squares[axis] += shift * shift;
        sum += shift;
      }
      ASSERT_EQ(distances(noisy)[i], distances(clean)[i]);
    }
    for (const double square : squares) EXPECT_NEAR(std::sqrt(square / 30000) / sigma, 1, 0.0205);
    EXPECT_NEAR(sum / 90000 / sigma, 0, 0.0167);
  }
}

TEST(Synth, noise_of_a_scan_goes_along_the_ray) {
  SynthOptions options = options_for("sphere", 3000, Sampling::Scan);
  options.noise.amount = 0.1;
  const SynthCloud noisy = synthesize(options);
  const synth::Scan clean = synth::scan(test::build("sphere"), 3000, options.seed, no_progress());
  ASSERT_EQ(noisy.cloud.size(), clean.samples.size());
  double squares = 0;
  for (std::size_t i = 0; i < clean.samples.size(); ++i) {
    const synth::Vec3& p = clean.samples[i].position;
    const Point& moved = noisy.cloud.positions[i];
    const synth::Vec3 shift = synth::Vec3{moved[0], moved[1], moved[2]} - p;
    const synth::Vec3 ray = unit(p - clean.stations[clean.samples[i].station]);
    ASSERT_LT(length(cross(shift, ray)), 1e-15);
    squares += dot(shift, shift);
  }
  const double deviation = std::sqrt(squares / static_cast<double>(clean.samples.size()));
  EXPECT_NEAR(deviation / (0.1 * noisy.spacing), 1, 0.065);
}

TEST(Synth, the_number_of_threads_changes_nothing) {
  for (const Sampling sampling : all_samplings) {
    SynthOptions options = options_for("fandisk", 20000, sampling);
    options.noise.amount = 0.05;
    std::uint64_t prints[2] = {};
    for (const std::size_t threads : {std::size_t{1}, std::size_t{4}}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      prints[threads == 1 ? 0 : 1] = fingerprint(synthesize(options).cloud);
    }
    EXPECT_EQ(prints[0], prints[1]);
  }
}

TEST(Synth, bits_are_the_same_from_every_compiler_and_cpu) {
  // Recorded once. They change only when shapes, samplings or random numbers are changed on purpose.
  constexpr std::uint64_t recorded[] = {7417754072855191987U, 6062826269256735970U, 8678556817103106497U,
                                        2561330133005730597U};
  for (std::size_t i = 0; i < std::size(all_samplings); ++i) {
    std::uint64_t prints = 0;
    for (const char* shape : {"fandisk", "trim-star", "vase", "cone"}) {
      SynthOptions options = options_for(shape, 2000, all_samplings[i]);
      options.noise.amount = 0.1;
      prints = prints * 31 + fingerprint(synthesize(options).cloud);
    }
    EXPECT_EQ(prints, recorded[i]);
  }
}

TEST(Synth, a_seed_decides_all) {
  SynthOptions options = options_for("vase", 1000);
  options.noise.amount = 0.1;
  const std::uint64_t print = fingerprint(synthesize(options).cloud);
  EXPECT_EQ(fingerprint(synthesize(options).cloud), print);
  options.seed = 2;
  EXPECT_NE(fingerprint(synthesize(options).cloud), print);
}

TEST(Synth, truth_curves_run_from_corner_to_corner) {
  const SynthCloud fandisk = synthesize(options_for("fandisk", 1000));
  for (const TruthCurve& curve : fandisk.curves) {
    ASSERT_GE(curve.vertices.size(), 2U);
    EXPECT_FALSE(curve.border);
    const auto is_corner = [&](const Point& p) {
      return std::any_of(fandisk.corners.begin(), fandisk.corners.end(), [&](const Point& c) {
        return std::hypot(c[0] - p[0], c[1] - p[1], c[2] - p[2]) < 1e-12;
      });
    };
    if (!curve.closed) {
      EXPECT_TRUE(is_corner(curve.vertices.front()));
      EXPECT_TRUE(is_corner(curve.vertices.back()));
    }
    for (std::size_t i = 1; i + 1 < curve.vertices.size(); ++i) EXPECT_FALSE(is_corner(curve.vertices[i]));
  }
  // Base: 3 chains on each of two rims and 3 upright edges; boss: 2 on each rim and 2 upright; the bore's 2
  // circles.
  EXPECT_EQ(fandisk.curves.size(), 3U * 3 + 2 * 3 + 2);
}

TEST(Synth, borders_run_from_bend_to_bend) {
  const SynthCloud crease = synthesize(options_for("crease", 100));
  ASSERT_EQ(crease.curves.size(), 7U);
  EXPECT_TRUE(crease.corners.empty());
  EXPECT_EQ(crease.border_corners.size(), 6U);
  EXPECT_FALSE(crease.curves[0].border);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(crease.curves[i].border, i > 0);
    EXPECT_FALSE(crease.curves[i].closed);
    EXPECT_EQ(crease.curves[i].vertices.size(), 2U);
  }
}

TEST(Synth, spacing_and_columns_are_as_documented) {
  const SynthCloud cube = synthesize(options_for("cube", 2400));
  EXPECT_DOUBLE_EQ(cube.spacing, 0.05);
  EXPECT_EQ(cube.cloud.size(), 2400U);
  EXPECT_EQ(cube.cloud.attribute("truth_feature")->type(), ScalarType::UInt8);
  EXPECT_EQ(cube.cloud.attribute("truth_kind")->type(), ScalarType::UInt8);
  EXPECT_EQ(cube.cloud.attribute("truth_distance")->type(), ScalarType::Float64);
}

TEST(Synth, every_shape_can_be_sampled_from_one_point_up) {
  for (const SynthShape& shape : synth_shapes()) {
    for (const Sampling sampling : all_samplings) {
      for (const std::uint64_t points : {1U, 5U}) {
        const SynthCloud synth = synthesize(options_for(std::string(shape.name), points, sampling));
        EXPECT_TRUE(sampling != Sampling::Random || synth.cloud.size() == points);
        EXPECT_EQ(count_finite(synth.cloud), synth.cloud.size());
      }
    }
  }
}

TEST(Synth, angles_at_the_ends_of_their_range_work) {
  for (const SynthShape& shape : synth_shapes()) {
    if (!shape.angle) continue;
    for (const double angle : {shape.angle->smallest, shape.angle->largest}) {
      for (const Sampling sampling : all_samplings) {
        SynthOptions options = options_for(std::string(shape.name), 1000, sampling);
        options.angle_deg = angle;
        EXPECT_EQ(count_finite(synthesize(options).cloud), synthesize(options).cloud.size());
      }
    }
  }
}

template <typename... Parts>
void expect_refused(const SynthOptions& options, const Parts&... parts) {
  test::expect_error<InvalidArgument>([&] { (void)synthesize(options); }, parts...);
}

TEST(Synth, refuses_options_out_of_range) {
  expect_refused(options_for("cub"), "unknown shape 'cub'", "cube", "fandisk");
  expect_refused(options_for("cube", 0), "points must be 1 to 4294967294, not 0");
  expect_refused(options_for("cube", max_points + 1), "4294967295");
  for (const double bad : {-0.1, infinity, std::numeric_limits<double>::quiet_NaN()}) {
    SynthOptions options = options_for("cube");
    options.noise.amount = bad;
    expect_refused(options, "noise");
    options.noise.amount = 0;
    options.feature_band = bad;
    expect_refused(options, "feature band");
  }
  for (const double bad : {0.0, 0.99, 360.0, std::numeric_limits<double>::quiet_NaN()}) {
    SynthOptions options = options_for("crease");
    options.angle_deg = bad;
    expect_refused(options, "the angle of a crease must be 1 to 359 degrees");
  }
  SynthOptions options = options_for("cone");
  options.angle_deg = 180;
  expect_refused(options, "1 to 179 degrees, not 180");
  options.shape = "sphere";
  expect_refused(options, "sphere takes no angle");
}

/// Cancels when the given number of units is done.
class CancelAfter : public Progress {
 public:
  explicit CancelAfter(std::uint64_t units) : units_(units) {}
  void advance(std::uint64_t units) override { done_ += units; }
  [[nodiscard]] bool cancelled() const override { return done_ >= units_; }

 private:
  std::uint64_t units_;
  std::atomic<std::uint64_t> done_ = 0;
};

TEST(Synth, can_be_cancelled) {
  for (const Sampling sampling : all_samplings) {
    CancelAfter at_once(0);
    EXPECT_THROW((void)synthesize(options_for("cube", 10000, sampling), at_once), Cancelled);
    CancelAfter half_way(sampling == Sampling::Scan ? 50 : 5000);
    EXPECT_THROW((void)synthesize(options_for("cube", 10000, sampling), half_way), Cancelled);
  }
}

}  // namespace
}  // namespace keenline
