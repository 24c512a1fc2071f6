#pragma once

#include <cstdint>
#include <vector>

#include "keenline/progress.h"
#include "keenline/synth/shape.h"

namespace keenline::synth {

/// A point of a shape before noise, and what is known of it without measuring.
struct Sample {
  enum class On : std::uint8_t { Face, Edge, Border };
  Vec3 position;
  std::uint32_t station = 0;  ///< scans only: number of the station that saw it
  On on = On::Face;           ///< placed exactly on an edge or border, by construction
  bool curved = false;        ///< the nature of the face it was taken from
};

/// Exactly `count` points, uniform by area.
[[nodiscard]] std::vector<Sample> sample_randomly(const Shape& shape, std::size_t count, std::uint64_t seed,
                                                  Progress& progress);

/// A lattice on every face, at least half a `spacing` from edges, borders and peaks.
[[nodiscard]] std::vector<Sample> sample_grid(const Shape& shape, double spacing, Progress& progress);

/// sample_grid(), and points at most `spacing` apart along edges and borders, with their ends and the peaks,
/// each once.
[[nodiscard]] std::vector<Sample> sample_mesh(const Shape& shape, double spacing, Progress& progress);

}  // namespace keenline::synth
