#pragma once

#include <array>
#include <span>

#include "keenline/progress.h"
#include "keenline/report/image.h"

namespace keenline {

/// A small disc that stands for a point. Pixels of the image to be drawn; x to the right, y down, depth
/// towards the viewer.
struct Splat {
  float x = 0;
  float y = 0;
  float depth = 0;
  float radius = 1;
  /// Unit normal of the disc in x to the right, y up, z towards the viewer, z >= 0. All zero: unknown, the
  /// disc faces the viewer and is not shaded.
  std::array<float, 3> normal{};
  Color color;
  /// A ball instead of a disc: stands out from the surface that it lies on, and is as large from every side.
  bool is_marker = false;
};

struct SplatOptions {
  int width = 800;
  int height = 600;
  Color background = white;
  /// Samples per pixel each way; the pixel is their mean.
  int supersampling = 3;
  /// How dark a surface grows close behind the rim of a nearer one; 0 = off.
  double rim_darkness = 1;
};

/// Draws with a z-buffer: at every sample the nearest splat is seen, of equally near ones the earlier.
/// Surfaces are lit from the upper left; what lies behind a rim is darker (eye-dome lighting, after C.
/// Boucheny 2009). Splats with coordinates that are not finite are not drawn. One thread, same pixels.
/// Memory: 12 bytes per sample.
/// \throw InvalidArgument when the size is none; OutOfMemory; Cancelled.
[[nodiscard]] Image draw_splats(std::span<const Splat> splats, const SplatOptions& options,
                                Progress& progress = no_progress());

}  // namespace keenline
