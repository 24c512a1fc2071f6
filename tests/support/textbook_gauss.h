#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "keenline/cloud.h"
#include "keenline/detect/gauss.h"
#include "keenline/labels.h"

namespace keenline::test {

struct TextbookLabel {
  Kind kind = Kind::Undecided;
  int clusters = 0;
};

/// Section 4 of Weber, Hahmann, Hagen 2010 word for word, for one point: doubles, arc cosines, clusters as
/// lists of lines, and at every step a look at all pairs of clusters. Shares no code with the library's fast
/// path. Of the options it knows sigma, max_clusters, min_sine and triangles.
TextbookLabel textbook_gauss(const PointCloud& cloud, std::size_t point,
                             std::span<const std::uint32_t> neighbors, const GaussOptions& options);

}  // namespace keenline::test
