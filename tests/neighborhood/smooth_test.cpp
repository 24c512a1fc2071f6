#include "keenline/neighborhood/smooth.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "keenline/detect/noise.h"
#include "keenline/errors.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/spacing.h"
#include "keenline/synth/synth.h"

#include "support/expect_error.h"
#include "support/motion.h"

namespace keenline {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SynthCloud shape(const std::string& name, double noise_h = 0, std::uint64_t points = 6000) {
  SynthOptions options;
  options.shape = name;
  options.points = points;
  options.noise.amount = noise_h;
  return synthesize(options);
}

std::vector<Point> smooth(const PointCloud& cloud, const SmoothOptions& options = {}) {
  return smooth_positions(cloud, find_neighborhoods(cloud, options.neighbors), options);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Of `f(i)` over all i of which `chosen(i)`.
double root_mean_square(std::size_t count, const std::function<bool(std::size_t)>& chosen,
                        const std::function<double(std::size_t)>& f) {
  std::vector<double> squares;
  for (std::size_t i = 0; i < count; ++i)
    if (chosen(i)) squares.push_back(f(i) * f(i));
  EXPECT_GT(squares.size(), 100U);
  return std::sqrt(mean(squares));
}

bool same_bits(const std::vector<Point>& a, const std::vector<Point>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0;
}

// --- against a slow, obvious twin
// --------------------------------------------------------------------------------

using Vector = Eigen::Vector3d;

/// What smooth.h says, with Eigen's solver and the system's exponential.
std::vector<Point> reference(const PointCloud& cloud, const Neighborhoods& neighborhoods,
                             const SmoothOptions& options) {
  const std::size_t n = cloud.size();
  std::vector<Vector> p(n);
  for (std::size_t i = 0; i < n; ++i) p[i] = Vector(cloud.positions[i].data());
  const auto axis = [](const Eigen::Matrix3d& m, int which) -> Vector {
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvectors().col(which);
  };
  std::vector<Vector> normals(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<Vector> near{p[i]};
    for (const std::uint32_t j :
         neighborhoods.of(i).first(static_cast<std::size_t>(options.normal_neighbors)))
      near.push_back(p[j]);
    Vector middle = Vector::Zero();
    for (const Vector& q : near) middle += q / static_cast<double>(near.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vector& q : near) covariance += (q - middle) * (q - middle).transpose();
    normals[i] = axis(covariance, 0);
  }
  const double sine = std::sin(options.angle_deg * std::numbers::pi / 180);
  const auto weight = [&](std::size_t i, std::uint32_t j) {
    const auto near = neighborhoods.of(i).first(static_cast<std::size_t>(options.neighbors));
    const double width = (p[near.back()] - p[i]).norm() / 1.5;
    const double cosine = normals[i].dot(normals[j]);
    return std::exp(-std::pow((p[j] - p[i]).norm() / width, 2)) *
           std::exp(-(1 - cosine * cosine) / (sine * sine));
  };
  for (int round = 0; round < options.normal_rounds; ++round) {
    std::vector<Vector> next(n);
    for (std::size_t i = 0; i < n; ++i) {
      Eigen::Matrix3d tensor = normals[i] * normals[i].transpose();
      for (const std::uint32_t j : neighborhoods.of(i).first(static_cast<std::size_t>(options.neighbors)))
        tensor += weight(i, j) * normals[j] * normals[j].transpose();
      next[i] = axis(tensor, 2);
    }
    normals = next;
  }
  std::vector<Vector> q = p;
  for (int round = 0; round < options.position_rounds; ++round) {
    std::vector<Vector> next(n);
    for (std::size_t i = 0; i < n; ++i) {
      Vector step = Vector::Zero();
      double weights = 0;
      for (const std::uint32_t j : neighborhoods.of(i).first(static_cast<std::size_t>(options.neighbors))) {
        step += weight(i, j) * normals[j].dot(q[j] - q[i]) * normals[j];
        weights += weight(i, j);
      }
      next[i] = q[i] + 0.7 * step / weights;
    }
    q = next;
  }
  std::vector<Point> result;
  for (const Vector& v : q) result.push_back({v[0], v[1], v[2]});
  return result;
}

TEST(Smooth, EqualsAnObviousImplementation) {
  SmoothOptions odd;
  odd.neighbors = 12;
  odd.normal_neighbors = 20;
  odd.angle_deg = 35;
  odd.normal_rounds = 3;
  odd.position_rounds = 2;
  for (const char* const name : {"cube", "torus"}) {
    const SynthCloud synth = shape(name, 0.3, 1000);
    for (const SmoothOptions& options : {SmoothOptions{}, odd}) {
      const Neighborhoods neighborhoods = find_neighborhoods(synth.cloud, 24);
      const std::vector<Point> found = smooth_positions(synth.cloud, neighborhoods, options);
      const std::vector<Point> expected = reference(synth.cloud, neighborhoods, options);
      for (std::size_t i = 0; i < found.size(); ++i)
        ASSERT_LT(distance(found[i], expected[i]), 1e-8 * synth.spacing) << name << " point " << i;
    }
  }
}

// --- shapes with a known answer
// ----------------------------------------------------------------------------------

TEST(Smooth, FlattensANoisyPlane) {
  const SynthCloud synth = shape("plane", 0.3);
  const std::vector<Point> smoothed = smooth(synth.cloud);
  const auto inside = [&](std::size_t i) {  // borders see one side only
    const Point& p = synth.cloud.positions[i];
    return std::max(std::abs(p[0] - 0.5), std::abs(p[1] - 0.5)) < 0.4;
  };
  const double level = shape("plane").cloud.positions[0][2];
  const double before = root_mean_square(smoothed.size(), inside,
                                         [&](std::size_t i) { return synth.cloud.positions[i][2] - level; });
  const double after =
      root_mean_square(smoothed.size(), inside, [&](std::size_t i) { return smoothed[i][2] - level; });
  EXPECT_NEAR(before, 0.3 * synth.spacing, 0.02 * synth.spacing);
  EXPECT_LT(after, before / 3);
}

/// From p to the nearest of the straight edges.
double distance_to_edges(const Point& p, const std::vector<TruthCurve>& edges) {
  double nearest = infinity;
  const Vector point(p.data());
  for (const TruthCurve& edge : edges) {
    for (std::size_t i = 1; i < edge.vertices.size(); ++i) {
      const Vector a(edge.vertices[i - 1].data());
      const Vector ab = Vector(edge.vertices[i].data()) - a;
      const double t = std::clamp((point - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      nearest = std::min(nearest, (a + t * ab - point).norm());
    }
  }
  return nearest;
}

/// Of a cube, for points that are near one of its faces and far from its edges.
double distance_to_faces(const Point& p, const std::vector<Point>& corners) {
  double nearest = infinity;
  for (const Point& corner : corners)
    for (std::size_t axis = 0; axis < 3; ++axis)
      nearest = std::min(nearest, std::abs(p[axis] - corner[axis]));
  return nearest;
}

TEST(Smooth, FlattensTheFacesOfANoisyCubeAndKeepsItsEdges) {
  const SynthCloud synth = shape("cube", 0.3);
  const auto truth = synth.cloud.attribute("truth_distance")->values<double>();
  SmoothOptions blind;  // to edges
  blind.angle_deg = 90;
  const std::vector<Point> smoothed = smooth(synth.cloud);
  const std::vector<Point> blurred = smooth(synth.cloud, blind);

  const auto on_face = [&](std::size_t i) { return truth[i] > 4 * synth.spacing; };
  const double before = root_mean_square(truth.size(), on_face, [&](std::size_t i) {
    return distance_to_faces(synth.cloud.positions[i], synth.corners);
  });
  const double after = root_mean_square(
      truth.size(), on_face, [&](std::size_t i) { return distance_to_faces(smoothed[i], synth.corners); });
  EXPECT_LT(after, before / 3);

  std::vector<double> kept;
  std::vector<double> lost;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] > 0.15 * synth.spacing) continue;
    kept.push_back(distance_to_edges(smoothed[i], synth.curves) / synth.spacing);
    lost.push_back(distance_to_edges(blurred[i], synth.curves) / synth.spacing);
  }
  EXPECT_GT(kept.size(), 100U);
  EXPECT_LT(mean(kept), 0.4);
  EXPECT_GT(mean(lost), mean(kept) + 0.1) << "without regard to normals edges are rounded";
}

TEST(Smooth, HardlyMovesWhatIsClean) {
  const SynthCloud plane = shape("plane");
  const std::vector<Point> same = smooth(plane.cloud);
  for (std::size_t i = 0; i < same.size(); ++i)
    ASSERT_LT(distance(same[i], plane.cloud.positions[i]), 1e-10 * plane.spacing);

  // The first normals near an edge lean; what that does to positions ends before 8 spacings.
  const SynthCloud cube = shape("cube");
  const std::vector<Point> smoothed = smooth(cube.cloud);
  const auto truth = cube.cloud.attribute("truth_distance")->values<double>();
  std::vector<double> near_edges;
  std::vector<double> elsewhere;
  for (std::size_t i = 0; i < smoothed.size(); ++i) {
    const double move = distance(smoothed[i], cube.cloud.positions[i]) / cube.spacing;
    (truth[i] < 8 * cube.spacing ? near_edges : elsewhere).push_back(move);
  }
  EXPECT_LT(mean(near_edges), 0.12);
  EXPECT_GT(elsewhere.size(), 500U);
  EXPECT_LT(mean(elsewhere), 0.02);
}

TEST(Smooth, SwellsARoundSurfaceAsItsHeaderSays) {
  // Every round moves a point onto planes that touch the sphere beside it.
  const SynthCloud sphere = shape("sphere");
  const std::vector<Point> smoothed = smooth(sphere.cloud);
  std::vector<double> outward;
  for (const Point& p : smoothed) outward.push_back(std::hypot(p[0], p[1], p[2]) - 1);
  EXPECT_NEAR(mean(outward) / (sphere.spacing * sphere.spacing), 5, 1);
}

TEST(Smooth, LowersTheNoiseThatIsMeasured) {
  PointCloud cloud = shape("torus", 0.4).cloud;
  const double before = estimate_noise(cloud, NeighborSearch(cloud.positions));
  cloud.positions = smooth(cloud);
  EXPECT_LT(estimate_noise(cloud, NeighborSearch(cloud.positions)), before / 2);
}

// --- invariance
// --------------------------------------------------------------------------------------------------

TEST(Smooth, DoesNotDependOnScalePlaceOrDirection) {
  const SynthCloud synth = shape("cube", 0.3, 3000);
  const std::vector<Point> expected = smooth(synth.cloud);
  struct Motion {
    double scale;
    Point shift;
    double tolerance_h;
  };
  // At 1e7 doubles are 2e-9 apart: 1e-7 spacings.
  for (const Motion& motion :
       {Motion{1, {0, 0, 0}, 1e-9}, Motion{1e-40, {0, 0, 0}, 1e-9}, Motion{1, {1e7, -3e6, 1e7}, 1e-5}}) {
    const PointCloud cloud = test::moved(synth.cloud, motion.scale, motion.shift);
    PointCloud back;
    back.positions = expected;
    const PointCloud wanted = test::moved(back, motion.scale, motion.shift);
    const std::vector<Point> found = smooth(cloud);
    const double tolerance = motion.tolerance_h * synth.spacing * motion.scale;
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_LT(distance(found[i], wanted.positions[i]), tolerance) << "scale " << motion.scale << ' ' << i;
  }
}

TEST(Smooth, ScalesExactlyByPowersOfTwo) {
  const SynthCloud synth = shape("torus", 0.3, 1000);
  const Neighborhoods neighborhoods = find_neighborhoods(synth.cloud, 24);
  const std::vector<Point> expected = smooth_positions(synth.cloud, neighborhoods);
  for (const int exponent : {-900, -100, 100, 1020}) {
    PointCloud scaled = synth.cloud;
    for (Point& p : scaled.positions)
      for (double& c : p) c = std::ldexp(c, exponent);
    std::vector<Point> found = smooth_positions(scaled, neighborhoods);
    for (Point& p : found)
      for (double& c : p) c = std::ldexp(c, -exponent);
    EXPECT_TRUE(same_bits(found, expected)) << exponent;
  }
}

TEST(Smooth, IsTheSameForAnyNumberOfThreads) {
  const PointCloud cloud = shape("cube", 0.3, 4000).cloud;
  const std::vector<Point> expected = smooth(cloud);
  for (const std::size_t threads : {1U, 2U, 16U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_TRUE(same_bits(smooth(cloud), expected));
  }
}

TEST(Smooth, UsesTheNearestOfMoreNeighbors) {
  const PointCloud cloud = shape("cube", 0.3, 1000).cloud;
  const Neighborhoods more = find_neighborhoods(cloud, 60);
  EXPECT_TRUE(same_bits(smooth_positions(cloud, more), smooth(cloud)));
  SmoothOptions wide;
  wide.neighbors = 60;
  EXPECT_FALSE(same_bits(smooth_positions(cloud, more, wide), smooth(cloud)));
}

// --- hostile clouds
// ----------------------------------------------------------------------------------------------

TEST(Smooth, LeavesPointsAloneThatHaveNoSurface) {
  PointCloud cloud;
  EXPECT_TRUE(smooth(cloud).empty());
  for (int i = 0; i < 3; ++i) cloud.positions.push_back({double(i * i), double(i), -0.0});
  EXPECT_TRUE(same_bits(smooth(cloud), cloud.positions)) << "two neighbours";
  cloud.positions.assign(500, {1, 2, 3});
  EXPECT_TRUE(same_bits(smooth(cloud), cloud.positions)) << "all at one place";
  cloud.positions.assign(500, {nan, 2, infinity});
  EXPECT_TRUE(same_bits(smooth(cloud), cloud.positions)) << "not finite";
  cloud.positions.clear();
  std::mt19937 generator(4);
  for (int i = 0; i < 500; ++i) {
    const double t = static_cast<double>(generator() % 100000);
    cloud.positions.push_back({t, 3 * t, -2 * t});
  }
  EXPECT_TRUE(same_bits(smooth(cloud), cloud.positions)) << "on one line";
}

TEST(Smooth, PassesOverPointsThatAreNotFinite) {
  PointCloud cloud = shape("cube", 0.3, 2000).cloud;
  const std::vector<Point> expected = smooth(cloud);
  for (const double odd : {nan, infinity, -infinity}) cloud.positions.push_back({0.5, odd, 0.5});
  std::vector<Point> found = smooth(cloud);
  EXPECT_TRUE(same_bits({found.end() - 3, found.end()}, {cloud.positions.end() - 3, cloud.positions.end()}));
  found.resize(expected.size());
  EXPECT_TRUE(same_bits(found, expected));
}

TEST(Smooth, StaysFiniteInHostileClouds) {
  std::mt19937 generator(9);
  const auto number = [&] { return static_cast<double>(generator()) / 4294967296.0; };
  PointCloud cloud = shape("plane", 0.3, 500).cloud;
  for (std::size_t i = 0; i < 100; ++i) cloud.positions.push_back(cloud.positions[i]);  // doubles
  for (int i = 0; i < 60; ++i) cloud.positions.push_back({0.5, 0.5, 5});                // a heap
  for (int i = 0; i < 60; ++i) cloud.positions.push_back({number(), 0, 7});             // a wire
  for (int i = 0; i < 60; ++i) cloud.positions.push_back({number() * 1e-300, number() * 1e-300, 9});
  for (int i = 0; i < 60; ++i) cloud.positions.push_back({number() * 1e200, number() * 1e200, 1e200});
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) cloud.positions.push_back({1.7e308 * x, 1.7e308 * y, 1.7e308});
  }
  for (const double angle : {1.0, 20.0, 90.0}) {
    SmoothOptions options;
    options.angle_deg = angle;
    std::size_t moved = 0;
    const std::vector<Point> found = smooth(cloud, options);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      ASSERT_TRUE(is_finite(found[i])) << i;
      moved += found[i] != cloud.positions[i] ? 1 : 0;
    }
    EXPECT_GT(moved, 500U);
  }
}

// --- the caller
// --------------------------------------------------------------------------------------------------

TEST(Smooth, RefusesOptionsOutOfRange) {
  const PointCloud cloud = shape("plane", 0, 100).cloud;
  const auto expect_refusal = [&](const auto& change, std::string_view name) {
    SmoothOptions options;
    change(options);
    test::expect_error<InvalidArgument>(
        [&] { (void)smooth_positions(cloud, find_neighborhoods(cloud, 24), options); }, name, "expected");
  };
  for (const int count : {-1, 2, 256}) {
    expect_refusal([&](SmoothOptions& o) { o.neighbors = count; }, "neighbors");
    expect_refusal([&](SmoothOptions& o) { o.normal_neighbors = count; }, "normal_neighbors");
  }
  for (const double angle : {0.5, 90.5, nan, infinity})
    expect_refusal([&](SmoothOptions& o) { o.angle_deg = angle; }, "angle_deg");
  for (const int rounds : {-1, 1001}) {
    expect_refusal([&](SmoothOptions& o) { o.normal_rounds = rounds; }, "normal_rounds");
    expect_refusal([&](SmoothOptions& o) { o.position_rounds = rounds; }, "position_rounds");
  }
  EXPECT_THROW((void)smooth_positions(cloud, Neighborhoods{}), InvalidArgument);
}

TEST(Smooth, MovesNothingWithoutRounds) {
  const PointCloud cloud = shape("cube", 0.3, 500).cloud;
  SmoothOptions options;
  options.position_rounds = 0;
  EXPECT_TRUE(same_bits(smooth(cloud, options), cloud.positions));
}

/// Counts units; stops when `last` are done.
class Counter : public Progress {
 public:
  explicit Counter(std::uint64_t last = std::numeric_limits<std::uint64_t>::max()) : last_(last) {}
  void begin(std::string_view stage, std::uint64_t total) override {
    EXPECT_EQ(stage, "smooth");
    total_ = total;
  }
  void advance(std::uint64_t units) override { done_ += units; }
  [[nodiscard]] bool cancelled() const override { return done_ >= last_; }
  [[nodiscard]] std::uint64_t total() const { return total_; }
  [[nodiscard]] std::uint64_t done() const { return done_; }

 private:
  std::uint64_t last_;
  std::uint64_t total_ = 0;
  std::atomic<std::uint64_t> done_ = 0;
};

TEST(Smooth, TellsProgressAndCanBeCancelled) {
  const PointCloud cloud = shape("cube", 0.3, 2000).cloud;
  const Neighborhoods neighborhoods = find_neighborhoods(cloud, 24);
  Counter all;
  (void)smooth_positions(cloud, neighborhoods, {}, all);
  EXPECT_GT(all.total(), 0U);
  EXPECT_EQ(all.done(), all.total());
  for (const std::uint64_t last : {std::uint64_t{0}, all.total() / 16, all.total() / 16 * 15}) {
    Counter some(last);
    EXPECT_THROW((void)smooth_positions(cloud, neighborhoods, {}, some), Cancelled) << last;
    EXPECT_LT(some.done(), all.total());
  }
}

}  // namespace
}  // namespace keenline
