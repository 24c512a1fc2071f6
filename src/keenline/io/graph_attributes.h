#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "keenline/feature_graph.h"

namespace keenline {

/// What is known of a line, one number each: for formats with a table of attributes.
struct LineAttributes {
  std::string_view kind;
  bool closed = false;
  double length = 0;
  std::optional<std::uint32_t> start_corner{};
  std::optional<std::uint32_t> end_corner{};
  std::uint64_t support = 0;
  std::optional<double> dihedral_deg{};  ///< mean over the vertices
  std::optional<double> residual{};      ///< largest of the vertices
};

[[nodiscard]] LineAttributes attributes_of(const Polyline& line);

}  // namespace keenline
