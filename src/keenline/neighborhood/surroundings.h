#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/neighborhood/box_tree.h"

namespace keenline {

/// What is around a box, for finding the nearest other locations of one point in it after another.
/// Locations within reach of the box are gathered once, with coordinates in single precision about the middle
/// of the box. Distances of those choose candidates: by less than `resolution` they can be wrong, so none is
/// missed. Double precision on the cloud's own coordinates decides their order.
/// How far the last query saw is the first guess for the next; it costs time when wrong, and nothing else.
class Surroundings {
 public:
  struct Found {
    double distance = 0;      ///< squared
    std::uint32_t point = 0;  ///< the smallest index there: decides ties
    std::uint32_t location = 0;
    bool operator<(const Found& other) const {
      return distance < other.distance || (distance == other.distance && point < other.point);
    }
  };

  /// For the `count` nearest, or all others where there are fewer. The tree must outlive this.
  Surroundings(const BoxTree& tree, std::size_t count);

  /// The next queries lie in this box; the locations around `here` on the curve are not far from it.
  void enter(const Box& box, std::uint32_t here);

  /// The nearest other locations of a query in the box, in order of (distance, point), and maybe more after
  /// them. `location` is the query's own. Valid until the next call.
  [[nodiscard]] std::span<const Found> nearest(const Point& query, std::uint32_t location);

 private:
  /// Of single-precision distances between coordinates up to 2, in local units. Coordinates are wrong by up
  /// to 2^-24, differences by 2^-22, distances by 4.4 * 2^-22, squared limits by as much as 2^-22.
  static constexpr double resolution = 0x1p-19;
  /// So many candidates are put in order without branches.
  static constexpr std::size_t few = 48;

  [[nodiscard]] double distance_along_curve(const Point& query, std::uint32_t here);
  void gather(double reach);
  void gather(const BoxTree::Node& leaf, std::uint32_t end, double squared_reach);
  void resize(std::size_t size);
  void measure(const Point& query);
  std::size_t choose(double limit);
  double limit_from_chosen(std::size_t chosen);
  void decide(std::size_t chosen, const Point& query, std::uint32_t location);
  std::span<const std::uint32_t> nearly_ordered(std::size_t chosen);

  const BoxTree& tree_;
  std::size_t count_;
  Box box_;
  double radius_ = -1;  // how far the last query saw
  double reach_ = -1;   // of what is gathered
  Point middle_{};
  double unit_ = 1;  // the local one in the cloud's own, a power of two

  // What is gathered: slots 0 … size_ - 1; the vectors only grow.
  std::size_t size_ = 0;
  std::vector<Point> positions_;
  std::vector<std::uint32_t> locations_;
  std::array<std::vector<float>, 3> local_;
  std::vector<float> distances_;  // squared, of the query to each slot

  std::vector<std::uint32_t> chosen_;  // slots
  std::array<std::uint32_t, few> ordered_{};
  std::vector<double> scratch_;
  std::vector<Found> found_;
};

}  // namespace keenline
