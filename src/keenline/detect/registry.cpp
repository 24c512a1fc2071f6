#include "keenline/detect/registry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "keenline/detect/gauss.h"
#include "keenline/errors.h"
#include "keenline/io/text.h"
#include "keenline/neighborhood/neighborhoods.h"

namespace keenline {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

constexpr std::array gauss_options{
    OptionInfo{"neighbors", "Nearest neighbours whose triangles make the Gauss map",
               OptionInfo::Type::Integer, min_neighbors, max_neighbors, false, "points", 16, ""},
    OptionInfo{"sigma", "Sensitivity: lines closer than this on average are one direction",
               OptionInfo::Type::Real, 0, 90, true, "degrees", 20, "auto"},
    OptionInfo{"min-cluster",
               "Lines that a cluster needs to count; auto = a tenth of a point's lines, at least 3",
               OptionInfo::Type::Integer, 1, 32385, false, "lines", std::nullopt, "auto"},
    OptionInfo{"max-clusters", "Up to so many clusters are a feature, more are curvature",
               OptionInfo::Type::Integer, 2, 255, false, "clusters", 4, ""},
    OptionInfo{"min-sine", "Triangles whose sine at the point is smaller have no usable normal",
               OptionInfo::Type::Real, 0, 1, false, "", 0.001, ""},
    OptionInfo{"flatness",
               "Points whose lines deviate less on average from their common direction are flat; 0 = off",
               OptionInfo::Type::Real, 0, 90, false, "degrees", 13.5, ""},
    OptionInfo{"plain", "The paper's section 4 with the given parameters and nothing else",
               OptionInfo::Type::Flag, 0, 1, false, "", 0, ""},
};

int gauss_reach(const OptionValues& values) { return static_cast<int>(*values.at("neighbors")); }

FeatureLabels gauss_detect(const PointCloud& cloud, const Neighborhoods& neighborhoods, OptionValues& values,
                           Progress& progress) {
  GaussOptions options = gauss_options_from(values);
  if (!options.sigma_deg && !options.plain)
    values["sigma"] = options.sigma_deg = choose_sigma(cloud, neighborhoods, options, progress);
  return detect_gauss(cloud, neighborhoods, options, progress);
}

constexpr std::array table{
    Method{"gauss", "Gauss map clustering: directions of the triangles around a point",
           "Weber, Hahmann, Hagen 2010: Methods for Feature Detection in Point Clouds", MethodInput::Points,
           gauss_options, gauss_reach, gauss_detect},
};

[[noreturn]] void refuse(const OptionInfo& option, std::string_view found) {
  throw InvalidArgument(fmt::format("--{}: found {}, expected {}", option.name, found, range_of(option)));
}

void require_in_range(const OptionInfo& option, double value, std::string_view found) {
  const bool above = option.minimum_excluded ? value > option.minimum : value >= option.minimum;
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
  return text;
}

std::optional<double> parse_option(const OptionInfo& option, std::string_view text) {
  if (!option.automatic.empty() && text == option.automatic) return std::nullopt;
  double value = 0;
  if (parse_number(text, value) != Parsed::Ok) refuse(option, quoted(text));
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
  options.neighbors = static_cast<int>(*values.at("neighbors"));
  options.sigma_deg = values.at("sigma");
  if (const auto& min_cluster = values.at("min-cluster"))
    options.min_cluster = static_cast<int>(*min_cluster);
  options.max_clusters = static_cast<int>(*values.at("max-clusters"));
  options.min_sine = *values.at("min-sine");
  options.flatness_deg = *values.at("flatness");
  options.plain = *values.at("plain") != 0;
  return options;
}

}  // namespace keenline
