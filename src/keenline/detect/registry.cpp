#include "keenline/detect/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/detect/demarsin.h"
#include "keenline/detect/gauss.h"
#include "keenline/detect/gumhold.h"
#include "keenline/detect/pauly.h"
#include "keenline/detect/tensor_voting.h"
#include "keenline/detect/voters.h"
#include "keenline/errors.h"
#include "keenline/io/text.h"
#include "keenline/neighborhood/neighbor_search.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

constexpr std::array gauss_options{
    OptionInfo{"neighbors",
               "Nearest neighbours whose triangles make the Gauss map; auto = 16, up to 28 as noise grows",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", std::nullopt,
               "auto"},
    OptionInfo{"scales",
               "Sizes of neighbourhood to look at, by turns larger and smaller than --neighbors; most decide",
               OptionInfo::Type::Integer, 1, 5, false, "sizes", 1, ""},
    OptionInfo{"sigma",
               "Sensitivity: lines closer than this on average are one direction; auto = one from the cloud, "
               "local = one for every point",
               OptionInfo::Type::Real, 0, 90, true, "degrees", std::nullopt, "auto", "local"},
    OptionInfo{"min-cluster",
               "Lines that a cluster needs to count; auto = a tenth of a point's lines, at least 3",
               OptionInfo::Type::Integer, 1, 32385, false, "lines", std::nullopt, "auto"},
    OptionInfo{"max-clusters",
               "Up to so many directions are a feature, more are curvature; auto = 6, with --plain 4",
               OptionInfo::Type::Integer, 2, 255, false, "clusters", std::nullopt, "auto"},
    OptionInfo{"min-sine", "Triangles whose sine at the point is smaller have no usable normal",
               OptionInfo::Type::Real, 0, 1, false, "", 0.001, ""},
    OptionInfo{"triangles",
               "Triangles of a point that are used, the best shaped; auto = all, down to 40 as noise grows",
               OptionInfo::Type::Integer, 3, 32385, false, "triangles", std::nullopt, "auto"},
    OptionInfo{"persistence",
               "Times higher than its birth that a direction must merge; auto = 3, with --no-thin 2",
               OptionInfo::Type::Real, 1, 90, false, "", std::nullopt, "auto"},
    OptionInfo{"min-support", "Sharp points that a sharp point needs among its 16 nearest neighbours",
               OptionInfo::Type::Integer, 0, 16, false, "points", 1, ""},
    OptionInfo{"thin",
               "Of the band of points that see an edge, two spacings to each side, those nearest to it",
               OptionInfo::Type::Flag, 0, 1, false, "", 1, ""},
    OptionInfo{"plain", "The paper's section 4 with the given parameters and nothing else",
               OptionInfo::Type::Flag, 0, 1, false, "", 0, ""},
    OptionInfo{"spectrum", "Keep the labels of all other sensitivities, for keenline relabel",
               OptionInfo::Type::Flag, 0, 1, false, "", 0, ""},
};

constexpr int paper_neighbors = 16;

int gauss_neighbors(const OptionValues& values) {
  return static_cast<int>(values.at("neighbors").value_or(paper_neighbors));
}

int gauss_reach(const OptionValues& values) {
  const std::vector<int> sizes =
      neighborhood_sizes(gauss_neighbors(values), static_cast<int>(*values.at("scales")));
  return *std::max_element(sizes.begin(), sizes.end());
}

bool gauss_is_plain(const OptionValues& values) { return *values.at("plain") != 0; }

void gauss_adapt(OptionValues& values, double noise, std::size_t points) {
  if (gauss_is_plain(values)) {
    if (!values.at("neighbors")) values.at("neighbors") = paper_neighbors;
    return;
  }
  // What a face is known by are the neighbours on it: the error of its direction falls with their number. But
  // every further neighbour may lie on another face; three quarters more is what the benchmark clouds bear.
  auto& neighbors = values.at("neighbors");
  if (!neighbors) {
    const double more = std::round(12 * std::sqrt(std::min(1.0, noise / 0.1)));
    // No more than there are: a small cloud is not to be undecided because it is noisy.
    neighbors =
        std::min(paper_neighbors + more, std::max<double>(paper_neighbors, static_cast<double>(points) - 1));
  }
  // The flatter a triangle, the more noise tilts it: well-shaped ones say more than all. As few as that are
  // enough to see three faces by.
  auto& triangles = values.at("triangles");
  if (!triangles && noise > 0) {
    const double all = *neighbors * (*neighbors - 1) / 2;
    const double enough = std::min(40.0, all);
    triangles = std::round(all - (all - enough) * std::sqrt(std::min(1.0, noise / 0.03)));
  }
}

FeatureLabels gauss_detect(const PointCloud& cloud, const NeighborSearch& search, OptionValues& values,
                           Progress& progress) {
  FeatureLabels labels = detect_gauss(cloud, search, gauss_options_from(values), progress);
  values["sigma"] = labels.sigma_deg;
  return labels;
}

constexpr OptionInfo border_gap_option{
    "border-gap",
    "Sector without neighbours that makes a border; 360 = no borders; auto = 120, for gumhold 100",
    OptionInfo::Type::Real,
    0,
    360,
    false,
    "degrees",
    std::nullopt,
    "auto"};

constexpr std::array pauly_options{
    OptionInfo{"smallest-scale", "Smallest neighbourhood to look at; auto = 8, with --plain 15",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", std::nullopt,
               "auto"},
    OptionInfo{"largest-scale", "Largest neighbourhood to look at; auto = 32, with --plain 120",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", std::nullopt,
               "auto"},
    OptionInfo{"scale-step", "From one size of neighbourhood to the next; auto = 4, with --plain 5",
               OptionInfo::Type::Integer, 1, max_neighbors, false, "points", std::nullopt, "auto"},
    OptionInfo{"variation",
               "Surface variation above which a scale speaks for a feature: half of 0.085 finds edges of 90 "
               "degrees, of 0.019 those of an icosahedron; auto = from the cloud, with --plain 0.04",
               OptionInfo::Type::Real, 0, 0.333, true, "", std::nullopt, "auto"},
    OptionInfo{"seed-share", "Share of its scales that makes a point a feature", OptionInfo::Type::Real, 0, 1,
               false, "", 0.95, ""},
    OptionInfo{"grow-share",
               "Share of its scales that makes the neighbour of a feature one; auto = 0.9, with --plain 0.6",
               OptionInfo::Type::Real, 0, 1, false, "", std::nullopt, "auto"},
    OptionInfo{"turn", "Larger scales are left out from where the normal turns by more",
               OptionInfo::Type::Real, 0, 90, false, "degrees", 30, ""},
    border_gap_option,
    OptionInfo{"plain", "The paper's parameters where none are given", OptionInfo::Type::Flag, 0, 1, false,
               "", 0, ""},
};

bool pauly_is_plain(const OptionValues& values) { return *values.at("plain") != 0; }

int pauly_reach(const OptionValues& values) {
  return static_cast<int>(values.at("largest-scale").value_or(pauly_is_plain(values) ? 120 : 32));
}

void pauly_adapt(OptionValues& values, double /*noise*/, std::size_t /*points*/) {
  const bool plain = pauly_is_plain(values);
  const auto fill = [&](std::string_view name, double with_plain, double otherwise) {
    auto& value = values.find(name)->second;
    if (!value) value = plain ? with_plain : otherwise;
  };
  fill("smallest-scale", 15, 8);
  fill("largest-scale", 120, 32);
  fill("scale-step", 5, 4);
  fill("grow-share", 0.6, 0.9);
  fill("border-gap", 120, 120);
  if (plain && !values.at("variation")) values.at("variation") = 0.04;
}

FeatureLabels pauly_detect(const PointCloud& cloud, const NeighborSearch& search, OptionValues& values,
                           Progress& progress) {
  PaulyOptions options;
  options.smallest_scale = static_cast<int>(*values.at("smallest-scale"));
  options.largest_scale = static_cast<int>(*values.at("largest-scale"));
  options.scale_step = static_cast<int>(*values.at("scale-step"));
  options.variation = values.at("variation");
  options.seed_share = *values.at("seed-share");
  options.grow_share = *values.at("grow-share");
  options.turn_deg = *values.at("turn");
  options.border_gap_deg = *values.at("border-gap");
  FeatureLabels labels = detect_pauly(cloud, search, options, progress);
  values["variation"] = labels.threshold;
  return labels;
}

constexpr std::array gumhold_options{
    OptionInfo{"neighbors", "Nearest neighbours in the graph that the pattern is taken from",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", 16, ""},
    OptionInfo{"crease-limit",
               "Penalty below which a connection of neighbours may be part of a crease: 2 is a plane, 0.2 an "
               "edge of 90 degrees; auto = 1.4, down to 1 as noise grows, with --plain 1.7",
               OptionInfo::Type::Real, 0, 2, false, "", std::nullopt, "auto"},
    border_gap_option,
    OptionInfo{"shortest-cycle",
               "Edges that cycles need, and half as many that branches need; auto = half the square root of "
               "the number of points",
               OptionInfo::Type::Integer, 1, 1e9, false, "edges", std::nullopt, "auto"},
    OptionInfo{"plain", "The paper's penalties", OptionInfo::Type::Flag, 0, 1, false, "", 0, ""},
};

bool gumhold_is_plain(const OptionValues& values) { return *values.at("plain") != 0; }

int gumhold_reach(const OptionValues& values) { return static_cast<int>(*values.at("neighbors")); }

void gumhold_adapt(OptionValues& values, double noise, std::size_t /*points*/) {
  // Noise bends: a tenth of a spacing makes up for the curvature of an edge of 150 degrees.
  auto& limit = values.at("crease-limit");
  if (!limit) limit = gumhold_is_plain(values) ? 1.7 : 1.4 - 2 * std::min(noise, 0.2);
  auto& border_gap = values.at("border-gap");
  if (!border_gap) border_gap = 100;
}

FeatureLabels gumhold_detect(const PointCloud& cloud, const NeighborSearch& search, OptionValues& values,
                             Progress& progress) {
  GumholdOptions options;
  options.neighbors = gumhold_reach(values);
  options.crease_limit = *values.at("crease-limit");
  options.border_gap_deg = *values.at("border-gap");
  if (const auto& cycle = values.at("shortest-cycle")) options.shortest_cycle = static_cast<int>(*cycle);
  options.plain = gumhold_is_plain(values);
  return detect_gumhold(cloud, search, options, progress);
}

void adapt_nothing(OptionValues& /*values*/, double /*noise*/, std::size_t /*points*/) {}

bool is_never_plain(const OptionValues& /*values*/) { return false; }

constexpr std::array demarsin_options{
    OptionInfo{"normal-neighbors", "Nearest neighbours that a normal is taken from",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", 10, ""},
    OptionInfo{"region-neighbors", "Nearest neighbours that a region grows to", OptionInfo::Type::Integer,
               min_neighbors, max_neighbors, false, "points", 8, ""},
    OptionInfo{"segment-angle",
               "Largest angle between normals of neighbours in one region; auto = thrice the usual, 5 to 10",
               OptionInfo::Type::Real, 1, 45, false, "degrees", std::nullopt, "auto"},
    OptionInfo{"min-patch", "Points inside a region that make it a face of the shape",
               OptionInfo::Type::Integer, 1, 1e9, false, "points", 10, ""},
};

int demarsin_reach(const OptionValues& values) {
  const double reach = std::max(*values.at("normal-neighbors"), *values.at("region-neighbors"));
  return std::max(demarsin_view, static_cast<int>(reach));
}

FeatureLabels demarsin_detect(const PointCloud& cloud, const NeighborSearch& search, OptionValues& values,
                              Progress& progress) {
  FeatureLabels labels = detect_demarsin(cloud, search, demarsin_options_from(values), progress);
  values["segment-angle"] = labels.threshold;
  return labels;
}

constexpr std::array tensor_voting_options{
    OptionInfo{"voting-scale", "Distance over which votes fade to 1/e", OptionInfo::Type::Real, 1,
               largest_voting_scale, false, "spacings", 1.5, ""},
    OptionInfo{"curvature-weight", "How much sooner votes fade that have to bend", OptionInfo::Type::Real, 0,
               100, false, "", 1, ""},
    OptionInfo{"min-curve",
               "Curve saliency above which a point is sharp; auto = 0.07 to 0.2, where it matters least",
               OptionInfo::Type::Real, 0, 1, false, "", std::nullopt, "auto"},
    OptionInfo{"min-junction", "Junction saliency above which a sharp point is a corner",
               OptionInfo::Type::Real, 0, 1, false, "", 0.12, ""},
};

int tensor_voting_reach(const OptionValues& values) { return voters_within(*values.at("voting-scale")); }

FeatureLabels tensor_voting_detect(const PointCloud& cloud, const NeighborSearch& search,
                                   OptionValues& values, Progress& progress) {
  FeatureLabels labels = detect_tensor_voting(cloud, search, tensor_voting_options_from(values), progress);
  values["min-curve"] = labels.threshold;
  return labels;
}

constexpr std::array table{
    Method{"gauss", "Gauss map clustering: directions of the triangles around a point",
           "Weber, Hahmann, Hagen 2010: Methods for Feature Detection in Point Clouds", MethodInput::Points,
           gauss_options, gauss_reach, gauss_adapt, gauss_is_plain, gauss_detect},
    Method{"gumhold", "Minimum spanning pattern of a neighbour graph whose edges are penalised off creases",
           "Gumhold, Wang, MacLeod 2001: Feature Extraction from Point Clouds", MethodInput::Points,
           gumhold_options, gumhold_reach, gumhold_adapt, gumhold_is_plain, gumhold_detect},
    Method{"pauly", "Surface variation at many scales, with hysteresis",
           "Pauly, Keiser, Gross 2003: Multi-scale Feature Extraction on Point-Sampled Surfaces",
           MethodInput::Points, pauly_options, pauly_reach, pauly_adapt, pauly_is_plain, pauly_detect},
    Method{"demarsin", "What is left between the regions in which normals turn slowly",
           "Demarsin, Vanderstraeten, Volodine, Roose 2007: Detection of closed sharp edges in point clouds",
           MethodInput::Points, demarsin_options, demarsin_reach, adapt_nothing, is_never_plain,
           demarsin_detect},
    Method{"tensor_voting", "Tensor voting: every point tells its neighbours where the surface goes on",
           "Guy, Medioni 1997: Inference of Surfaces, 3D Curves, and Junctions from Sparse, Noisy, 3D Data",
           MethodInput::Points, tensor_voting_options, tensor_voting_reach, adapt_nothing, is_never_plain,
           tensor_voting_detect},
};

[[noreturn]] void refuse(const OptionInfo& option, std::string_view found) {
  throw InvalidArgument(fmt::format("--{}: found {}, expected {}", option.name, found, range_of(option)));
}

void require_in_range(const OptionInfo& option, double value, std::string_view found) {
  const bool minimum_allowed = !option.minimum_excluded || !option.word_for_minimum.empty();
  const bool above = minimum_allowed ? value >= option.minimum : value > option.minimum;
  if (!above || !(value <= option.maximum)) refuse(option, found);
  if (option.type != OptionInfo::Type::Real && value != std::floor(value)) refuse(option, found);
}

}  // namespace

std::span<const Method> methods() { return table; }

const Method& find_method(std::string_view name) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Method& method) { return method.name == name; });
  if (found != table.end()) return *found;
  std::vector<std::string_view> names;
  names.reserve(table.size());
  for (const Method& method : table) names.push_back(method.name);
  throw InvalidArgument(
      fmt::format("--method: found {}, expected one of {}", quoted(name), fmt::join(names, ", ")));
}

std::string range_of(const OptionInfo& option) {
  std::string text = option.type == OptionInfo::Type::Integer ? "an integer " : "";
  if (option.minimum_excluded) text += fmt::format("more than {}", option.minimum);
  else text += fmt::format("from {}", option.minimum);
  if (option.maximum != no_limit)
    text += fmt::format("{} {}", option.minimum_excluded ? ", up to" : " to", option.maximum);
  if (!option.unit.empty()) text += fmt::format(" {}", option.unit);
  if (!option.automatic.empty()) text += fmt::format(", or {}", option.automatic);
  if (!option.word_for_minimum.empty()) text += fmt::format(", or {}", option.word_for_minimum);
  return text;
}

std::string text_of(const OptionInfo& option, const std::optional<double>& value) {
  if (!value) return std::string(option.automatic);
  if (!option.word_for_minimum.empty() && *value == option.minimum)
    return std::string(option.word_for_minimum);
  return fmt::format("{}", *value);
}

std::variant<bool, std::int64_t, double, std::string> told_value(const OptionInfo& option,
                                                                 const std::optional<double>& value) {
  std::string text = text_of(option, value);
  if (!value || text == option.word_for_minimum) return text;
  switch (option.type) {
    case OptionInfo::Type::Flag: return *value != 0;
    case OptionInfo::Type::Integer: return static_cast<std::int64_t>(*value);
    case OptionInfo::Type::Real: break;
  }
  return *value;
}

std::optional<double> parse_option(const OptionInfo& option, std::string_view text) {
  if (!option.automatic.empty() && text == option.automatic) return std::nullopt;
  if (!option.word_for_minimum.empty() && text == option.word_for_minimum) return option.minimum;
  double value = 0;
  if (parse_number(text, value) != Parsed::Ok) refuse(option, quoted(text));
  if (option.minimum_excluded && value == option.minimum) refuse(option, quoted(text));
  require_in_range(option, value, quoted(text));
  return value;
}

OptionValues resolve_options(const Method& method, const OptionValues& given) {
  OptionValues values;
  for (const OptionInfo& option : method.options) {
    const auto found = given.find(option.name);
    if (found == given.end()) {
      values.emplace(option.name, option.default_value);
      continue;
    }
    if (found->second) require_in_range(option, *found->second, fmt::format("{}", *found->second));
    else if (option.automatic.empty()) refuse(option, "no number");
    values.emplace(option.name, found->second);
  }
  for (const auto& [name, value] : given)
    if (!values.contains(name))
      throw InvalidArgument(fmt::format("--{}: method {} has no such option", escaped(name), method.name));
  return values;
}

GaussOptions gauss_options_from(const OptionValues& values) {
  GaussOptions options;
  options.neighbors = gauss_neighbors(values);
  options.scales = static_cast<int>(*values.at("scales"));
  if (const auto& sigma_deg = values.at("sigma")) {
    options.sigma_rule = *sigma_deg > 0 ? SigmaRule::Given : SigmaRule::Local;
    options.sigma_deg = *sigma_deg;
  }
  if (const auto& min_cluster = values.at("min-cluster"))
    options.min_cluster = static_cast<int>(*min_cluster);
  if (const auto& max_clusters = values.at("max-clusters"))
    options.max_clusters = static_cast<int>(*max_clusters);
  options.min_sine = *values.at("min-sine");
  if (const auto& triangles = values.at("triangles")) options.triangles = static_cast<int>(*triangles);
  options.persistence = values.at("persistence");
  options.min_support = static_cast<int>(*values.at("min-support"));
  options.thin = *values.at("thin") != 0;
  options.plain = *values.at("plain") != 0;
  options.keep_spectrum = *values.at("spectrum") != 0;
  return options;
}

DemarsinOptions demarsin_options_from(const OptionValues& values) {
  DemarsinOptions options;
  options.normal_neighbors = static_cast<int>(*values.at("normal-neighbors"));
  options.region_neighbors = static_cast<int>(*values.at("region-neighbors"));
  options.segment_angle_deg = values.at("segment-angle");
  options.min_patch = static_cast<int>(*values.at("min-patch"));
  return options;
}

TensorVotingOptions tensor_voting_options_from(const OptionValues& values) {
  TensorVotingOptions options;
  options.voting_scale = *values.at("voting-scale");
  options.curvature_weight = *values.at("curvature-weight");
  options.min_curve = values.at("min-curve");
  options.min_junction = *values.at("min-junction");
  return options;
}

}  // namespace keenline
