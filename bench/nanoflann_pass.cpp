#include "nanoflann_pass.h"

#include <nanoflann.hpp>

#include "keenline/cloud.h"

namespace keenline::bench {
namespace {

struct Floats {
  explicit Floats(const PointCloud& cloud) {
    xyz.reserve(3 * cloud.size());
    for (const Point& p : cloud.positions)
      for (std::size_t axis = 0; axis < 3; ++axis)
        xyz.push_back(static_cast<float>(p[axis] - cloud.positions[0][axis]));
  }
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return xyz.size() / 3; }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const { return xyz[3 * i + axis]; }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
  std::vector<float> xyz;
};

}  // namespace

std::vector<std::uint32_t> nanoflann_pass(const PointCloud& cloud, int count) {
  using Distance = nanoflann::L2_Simple_Adaptor<float, Floats>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Distance, Floats, 3, std::uint32_t>;
  const Floats floats(cloud);
  const Tree tree(3, floats, nanoflann::KDTreeSingleIndexAdaptorParams(10));
  const std::size_t points = floats.kdtree_get_point_count();
  const std::size_t width = static_cast<std::size_t>(count) + 1;
  std::vector<std::uint32_t> table(points * width);
  std::vector<float> distances(width);
  for (std::size_t i = 0; i < points; ++i)
    tree.knnSearch(&floats.xyz[3 * i], width, &table[i * width], distances.data());
  return table;
}

}  // namespace keenline::bench
