#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/// The label of every point at every sensitivity: what a relabelling needs instead of another detection.
/// A sensitivity is counted in whole units of 1/728 degree (angle_units_per_degree), 0 to 65520; the label of
/// a point changes at a few of them only. Point i has the steps offsets[i] … offsets[i + 1] - 1; step s holds
/// from sensitivity from[s] up to the next step. The first step of every point is from 0.
struct LabelSpectrum {
  std::vector<std::uint64_t> offsets{0};
  std::vector<std::uint16_t> from;
  std::vector<Kind> kind;
  std::vector<std::uint8_t> clusters;

  [[nodiscard]] std::size_t size() const { return offsets.size() - 1; }
};

/// What a detector says of every point, in the order of the cloud.
struct FeatureLabels {
  std::vector<Kind> kind;
  std::vector<float> score;            ///< larger = sharper; the unit is the method's own; 0 where undecided
  std::vector<std::uint8_t> clusters;  ///< number of significant clusters (gauss); empty for other methods
  double sigma_deg = 0;  ///< sensitivity that the labels hold for (gauss); 0: a choice per point
  double threshold = 0;  ///< score that tells sharp from smooth, where the method has one; else 0
  /// Where the method has a sensitivity and was asked to keep the labels of all.
  std::optional<LabelSpectrum> spectrum;

  [[nodiscard]] std::size_t size() const { return kind.size(); }
};

}  // namespace keenline
