#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "keenline/labels.h"
#include "keenline/progress.h"

namespace keenline {

struct PointCloud;

/// The points that a report shows, rising: of the finite ones all that are sharp or on a border, and of the
/// others as many as fit below `limit`, evenly along a Morton curve, so that neither stripes nor holes come
/// from the order of the file. More than `limit` where more are sharp. Threads: any number, same points.
/// \pre kinds.size() == cloud.size() \throw Cancelled
[[nodiscard]] std::vector<std::uint32_t> select_points(const PointCloud& cloud, std::span<const Kind> kinds,
                                                       std::size_t limit,
                                                       const Progress& progress = no_progress());

}  // namespace keenline
