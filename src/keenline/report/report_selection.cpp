#include "keenline/report/report_selection.h"

#include <algorithm>

#include "keenline/cloud.h"
#include "keenline/neighborhood/box_tree.h"

namespace keenline {
namespace {

bool must_be_kept(Kind kind) { return is_feature(kind) || kind == Kind::Border; }

}  // namespace

std::vector<std::uint32_t> select_points(const PointCloud& cloud, std::span<const Kind> kinds,
                                         std::size_t limit, const Progress& progress) {
  std::vector<std::uint32_t> selected;
  const std::size_t finite = count_finite(cloud);
  selected.reserve(std::min(finite, limit));
  if (finite <= limit) {
    for (std::uint32_t i = 0; i < cloud.size(); ++i)
      if (is_finite(cloud.positions[i])) selected.push_back(i);
    return selected;
  }
  std::vector<std::uint32_t> others;
  others.reserve(finite);
  const BoxTree tree(cloud.positions, progress);
  for (const std::uint32_t point : tree.points())
    (must_be_kept(kinds[point]) ? selected : others).push_back(point);
  const std::uint64_t room = selected.size() < limit ? limit - selected.size() : 0;
  for (std::uint64_t i = 0; i < room; ++i) selected.push_back(others[i * others.size() / room]);
  std::sort(selected.begin(), selected.end());
  return selected;
}

}  // namespace keenline
