#include "keenline/detect/faces.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "keenline/detect/gauss_map.h"
#include "keenline/kernels/symmetric3.h"
#include "keenline/vectors.h"

namespace keenline {
namespace {

using kernels::angle_units_per_degree;

constexpr std::uint32_t none = 0xFFFF'FFFFU;
/// Faces that scatter less than a degree are as good as exact.
constexpr double smallest_birth = 1 * angle_units_per_degree;
/// Neighbours so far off the plane of a face that does not scatter are on it.
constexpr double least_tolerance_deg = 12;
/// Cosines of the sectors of Face::ends and Face::is_half. On a lattice sectors are 90° inside a face and
/// 135° or more on its edge; those of random points inside a face are rarely above 100°.
constexpr double end_cosine = -0.42261826174069944;   // 115°, see Round
constexpr double half_cosine = -0.93969262078590838;  // 160°

/// sin, for 0 … 45 degrees, to 1e-6: by + and * only, for the same bits on every CPU.
double sine_of(double degrees) {
  const double x = degrees * 0.017453292519943295;
  const double y = x * x;
  return x * (1 - y / 6 * (1 - y / 20 * (1 - y / 42)));
}

/// In the plane of a face, from the point.
using Direction = std::array<double, 2>;

/// Which of sixteen equal sectors a direction lies in, counter-clockwise from the positive x axis. Without
/// branches, of which no CPU could guess one.
unsigned sixteenth_of_turn(const Direction& direction) {
  constexpr double tangent = 0.41421356237309503;  // of 22.5 degrees
  const double x = std::abs(direction[0]);
  const double y = std::abs(direction[1]);
  const auto from_axis = static_cast<unsigned>(y > tangent * x) + static_cast<unsigned>(y > x) +
                         (static_cast<unsigned>(y > x) & static_cast<unsigned>(x <= tangent * y));
  const auto is_below = static_cast<unsigned>(direction[1] < 0);
  const unsigned is_odd = is_below ^ static_cast<unsigned>(direction[0] < 0);  // quarter
  return 8 * is_below + 4 * is_odd + (from_axis ^ (3 * is_odd));
}

double cross_product(const Direction& a, const Direction& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Cosine of the sector from a counter-clockwise to b; -1 from 180 degrees on.
double sector_cosine(const Direction& a, const Direction& b) {
  if (cross_product(a, b) < 0) return -1;
  const double lengths = std::sqrt((a[0] * a[0] + a[1] * a[1]) * (b[0] * b[0] + b[1] * b[1]));
  return (a[0] * b[0] + a[1] * b[1]) / lengths;
}

/// The neighbours on a plane through the point, as one sees them from there.
class Round {
 public:
  /// Those that are less than so many degrees off the plane.
  Round(const GaussMap& map, const Point& normal, double tolerance_deg) {
    const double tolerance = sine_of(tolerance_deg);
    const std::size_t smallest = std::abs(normal[0]) < 0.6 ? 0 : 1;
    Point axis{0, 0, 0};
    axis[smallest] = 1;
    const Point u = unit(cross(normal, axis));
    const Point v = cross(normal, u);
    for (std::size_t i = 0; i < map.offsets().size(); ++i) {
      // Without branches, as above: those that are too far off are written over.
      const Point& offset = map.offsets()[i];
      const auto is_near =
          static_cast<unsigned>(std::abs(dot(offset, normal)) < tolerance * map.lengths()[i]);
      directions_[count_] = {dot(offset, u), dot(offset, v)};
      const unsigned sixteenth = sixteenth_of_turn(directions_[count_]);
      sixteenths_[count_] = static_cast<std::uint8_t>(sixteenth);
      taken_ |= is_near * 0x10001U << sixteenth;
      count_ += is_near;
    }
  }

  /// False only if no sector of more than 112.5 degrees is empty: one would hold four whole sixteenths.
  [[nodiscard]] bool may_have_wide_sector() const {
    const std::uint32_t empty = ~taken_;
    return (empty & empty >> 1 & empty >> 2 & empty >> 3) != 0;
  }

  /// Cosine of the widest empty sector; -1 from 180 degrees on, 0 or what a narrower one has where it is no
  /// wider than 112.5.
  [[nodiscard]] double widest_sector_cosine() const {
    if (count_ < 2) return -1;
    double cosine = 0;
    for (unsigned before = 0; before < 16; ++before) {
      if ((taken_ >> before & 1U) == 0) continue;
      const auto empty = static_cast<unsigned>(std::countr_zero(taken_ >> (before + 1)));
      if (empty >= 8) return -1;
      if (empty >= 4)
        cosine = std::min(cosine, sector_cosine(last_of(before), first_of((before + 1 + empty) % 16)));
    }
    return cosine;
  }

 private:
  /// The last in counter-clockwise order of those in a sixteenth.
  [[nodiscard]] const Direction& last_of(unsigned sixteenth) const {
    return extreme_of(sixteenth, [](const Direction& a, const Direction& b) { return cross_product(a, b); });
  }
  [[nodiscard]] const Direction& first_of(unsigned sixteenth) const {
    return extreme_of(sixteenth, [](const Direction& a, const Direction& b) { return cross_product(b, a); });
  }
  template <typename Turn>
  [[nodiscard]] const Direction& extreme_of(unsigned sixteenth, Turn turn) const {
    const Direction* extreme = nullptr;
    for (std::size_t i = 0; i < count_; ++i)
      if (sixteenths_[i] == sixteenth && (extreme == nullptr || turn(*extreme, directions_[i]) > 0))
        extreme = &directions_[i];
    return *extreme;
  }

  std::array<Direction, 255> directions_;
  std::array<std::uint8_t, 255> sixteenths_;
  std::size_t count_ = 0;
  std::uint32_t taken_ = 0;  // sixteenths that are not empty, twice around
};

/// Of the sector that the neighbours on the face leave empty, see Round.
double widest_sector_cosine(const GaussMap& map, const Face& face) {
  // On the face lies what is no further off its plane than the face scatters, and at least 12 degrees: a
  // curved face falls away from its plane, and the smallest dihedral angles of interest are larger.
  const double tolerance_deg = std::clamp(face.birth / angle_units_per_degree + 5, least_tolerance_deg, 40.0);
  return Round(map, face.normal, tolerance_deg).widest_sector_cosine();
}

/// Where the lines gather that the face was born of. They come first in the list that their cluster begins.
Point direction_of_birth(const kernels::Lines& lines, const FaceWorkspace& workspace,
                         const FaceWorkspace::Birth& birth) {
  kernels::Symmetric3 tensor;
  std::uint32_t line = birth.first;
  for (std::uint32_t i = 0; i < birth.lines; ++i, line = workspace.clusters[line].next)
    kernels::add_outer_product(tensor, static_cast<double>(lines.x[line]), static_cast<double>(lines.y[line]),
                               static_cast<double>(lines.z[line]));
  return kernels::largest_eigenvector(tensor);
}

void look_for_ends(const GaussMap& map, Face& face) {
  const double cosine = widest_sector_cosine(map, face);
  face.ends = cosine < end_cosine;
  face.is_half = cosine < half_cosine;
}

/// Fills workspace.born; those that are not persistent die at 0.
void follow_merges(const GaussMap& map, int min_cluster, double persistence, FaceWorkspace& workspace) {
  auto& clusters = workspace.clusters;
  auto& born = workspace.born;
  const auto lines = static_cast<std::uint32_t>(map.lines().count);
  born.clear();
  clusters.resize(std::max(clusters.size(), static_cast<std::size_t>(lines)));
  const auto bear = [&](std::uint32_t cluster, std::uint32_t size, double height) {
    clusters[cluster].oldest = clusters[cluster].newest = static_cast<std::uint32_t>(born.size());
    born.push_back({cluster, size, none, height, std::numeric_limits<double>::infinity()});
  };
  for (std::uint32_t i = 0; i < lines; ++i) {
    clusters[i] = {none, i, none, none};
    if (min_cluster <= 1) bear(i, 1, 0);
  }

  for (const kernels::Merge& merge : map.merges()) {
    auto& first = clusters[merge.first];
    const auto& second = clusters[merge.second];
    if (first.oldest != none && second.oldest != none) {
      const bool first_is_older = born[first.oldest].height <= born[second.oldest].height;
      const auto& older = first_is_older ? first : second;
      const auto& younger = first_is_older ? second : first;
      const double younger_birth = std::max(born[younger.oldest].height, smallest_birth);
      const bool persistent = merge.height >= persistence * younger_birth;
      for (std::uint32_t f = younger.oldest; f != none; f = born[f].next)
        born[f].death = persistent ? std::min(born[f].death, merge.height) : 0;
      if (persistent) born[older.newest].next = younger.oldest;
      const std::uint32_t newest = persistent ? younger.newest : older.newest;
      first.oldest = older.oldest;
      first.newest = newest;
    } else if (second.oldest != none) {
      first.oldest = second.oldest;
      first.newest = second.newest;
    }
    clusters[first.last].next = merge.second;
    first.last = second.last;
    const std::uint32_t size = merge.first_size + merge.second_size;
    if (first.oldest == none && size >= static_cast<std::uint32_t>(min_cluster))
      bear(merge.first, size, merge.height);
  }
}

}  // namespace

void find_faces(const GaussMap& map, int min_cluster, double persistence, FaceWorkspace& workspace,
                std::vector<Face>& faces) {
  follow_merges(map, min_cluster, persistence, workspace);
  auto& born = workspace.born;
  born.erase(std::remove_if(born.begin(), born.end(), [](const auto& birth) { return birth.death == 0; }),
             born.end());
  // The usual one needs no memory for that.
  if (born.size() > 1)
    std::stable_sort(born.begin(), born.end(),
                     [](const auto& a, const auto& b) { return a.death > b.death; });
  faces.clear();
  for (const FaceWorkspace::Birth& birth : born) {
    const Point normal =
        born.size() == 1 ? map.common_direction() : direction_of_birth(map.lines(), workspace, birth);
    faces.push_back({normal, birth.height, birth.death});
    look_for_ends(map, faces.back());
  }
}

double unresolved_angle(double persistence) { return persistence * smallest_birth; }

bool lone_face_is_half(const GaussMap& map) {
  // Any of the lines is nearly the normal, at most 7 degrees off. What is 5 degrees off its plane is no more
  // than 12 off the face's, and seen on the one plane a sector is a few degrees wider than on the other, not
  // the 47 that half_cosine asks for.
  const kernels::Lines lines = map.lines();
  const Point line{static_cast<double>(lines.x[0]), static_cast<double>(lines.y[0]),
                   static_cast<double>(lines.z[0])};
  if (!Round(map, line, least_tolerance_deg - 7).may_have_wide_sector()) return false;
  Face face{map.common_direction(), 0};
  look_for_ends(map, face);
  return face.is_half;
}

}  // namespace keenline
