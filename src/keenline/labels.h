#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace keenline {

/// What a point is. The numbers are what files hold.
enum class Kind : std::uint8_t {
  Flat = 0,
  Curved = 1,
  Edge = 2,
  Corner = 3,
  Peak = 4,
  Border = 5,       ///< rim of an open surface: not a sharp feature
  Undecided = 255,  ///< not finite, or too few neighbours to tell
};

inline constexpr std::array all_kinds{Kind::Flat, Kind::Curved, Kind::Edge,     Kind::Corner,
                                      Kind::Peak, Kind::Border, Kind::Undecided};

/// "flat", "curved", …
[[nodiscard]] std::string_view name_of(Kind kind);

/// Edges, corners and peaks are sharp features.
[[nodiscard]] constexpr bool is_feature(Kind kind) {
  return kind == Kind::Edge || kind == Kind::Corner || kind == Kind::Peak;
}

/// What a detector says of every point, in the order of the cloud.
struct FeatureLabels {
  std::vector<Kind> kind;
  std::vector<float> score;            ///< larger = sharper; the unit is the method's own; 0 where undecided
  std::vector<std::uint8_t> clusters;  ///< number of significant clusters (gauss); empty for other methods

  [[nodiscard]] std::size_t size() const { return kind.size(); }
};

}  // namespace keenline
