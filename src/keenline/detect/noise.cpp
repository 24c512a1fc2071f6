#include "keenline/detect/noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "keenline/cloud.h"
#include "keenline/detect/faces.h"
#include "keenline/detect/gauss_map.h"
#include "keenline/kernels/line_angles.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/order_statistics.h"

namespace keenline {
namespace {

constexpr int neighbors_to_use = 16;
constexpr double no_lines = std::numeric_limits<double>::infinity();

/// The angle, in degrees, within which the densest tenth of the lines at a point lies.
double scatter_deg(GaussMap& map, FaceWorkspace& workspace, std::vector<Face>& faces) {
  const int lines = map.lines().count;
  if (lines < 3) return no_lines;
  const int min_cluster = std::max(3, (lines + 9) / 10);
  map.cluster(min_cluster);
  find_faces(map, min_cluster, 90, workspace, faces);
  double birth = no_lines;
  for (const Face& face : faces) birth = std::min(birth, face.birth);
  return birth / kernels::angle_units_per_degree;
}

}  // namespace

double estimate_noise(const PointCloud& cloud, const NeighborSearch& search, Progress& progress) {
  constexpr std::size_t largest_sample = 2048;
  const std::size_t step = (cloud.size() + largest_sample - 1) / largest_sample;
  const std::size_t count = step == 0 ? 0 : (cloud.size() + step - 1) / step;
  struct Workspace {
    GaussMap map;
    FaceWorkspace faces;
    std::vector<Face> found;
  };
  tbb::enumerable_thread_specific<Workspace> workspaces([&] {
    return Workspace{GaussMap(0.001, progress), {}, {}};
  });
  std::vector<double> scatters(count, no_lines);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Workspace& workspace = workspaces.local();
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        progress.check();
                        const auto point = static_cast<std::uint32_t>(i * step);
                        const std::vector<std::uint32_t> neighbors = search.nearest(point, neighbors_to_use);
                        if (neighbors.size() < 3) continue;
                        workspace.map.collect(cloud.positions, cloud.positions[point], neighbors);
                        scatters[i] = scatter_deg(workspace.map, workspace.faces, workspace.found);
                      }
                    });
  scatters.erase(std::remove(scatters.begin(), scatters.end(), no_lines), scatters.end());
  if (scatters.empty()) return 0;
  const double quartile = nth_smallest(scatters, (scatters.size() - 1) / 4);
  // Measured: quartile = 14.4 noise / (1 + 0.54 noise).
  return quartile / std::max(14.4 - 0.54 * quartile, 1.0);
}

}  // namespace keenline
